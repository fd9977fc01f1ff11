#include "coupling/rbc_flow_inside.h"

#include "cells/rbc_region_enclosure.h"
#include "domain.h"
#include "error.h"
#include "region.h"

#include <utility>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FlowInside::FlowInside(LAMMPS *lmp, std::string style, std::string region) :
    Pointers(lmp), style_(std::move(style)), region_id_(std::move(region))
{
}

/* ---------------------------------------------------------------------- */

fluid::Interior *FlowInside::find(const fluid::Flow &flow)
{
  if (interior_ || region_id_.empty()) return interior_.get();
  Region *region = domain->get_region_by_id(region_id_);
  if (!region) error->all(FLERR, "Region ID {} for {} inside does not exist", region_id_, style_);
  if (region->dynamic_check())
    error->all(FLERR, "Region {} for {} inside must not move", region_id_, style_);
  region->init();
  const RegionEnclosure enclosure(region, domain);
  interior_ = std::make_unique<fluid::Interior>(flow.grid(), flow.decomposition(),
                                                [&](const fluid::Real3 &x) {
                                                  return enclosure.contains({x[0], x[1], x[2]});
                                                });
  if (interior_->volume() == 0)
    error->all(FLERR, "Region {} for {} inside holds nothing of the simulation box", region_id_,
               style_);
  return interior_.get();
}

/* ---------------------------------------------------------------------- */

double FlowInside::volume(const fluid::Flow &flow)
{
  const fluid::Interior *const interior = find(flow);
  return interior ? interior->volume() : domain->prd[0] * domain->prd[1] * domain->prd[2];
}

/* ---------------------------------------------------------------------- */

const fluid::Real3 &FlowInside::mean_velocity(fluid::Flow &flow, bigint version)
{
  if (version_ != version) velocity_ = find(flow)->mean_velocity(flow);
  version_ = version;
  return velocity_;
}
