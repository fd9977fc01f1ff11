#include "coupling/rbc_flow_inside.h"

#include "domain.h"
#include "error.h"
#include "region.h"

#include <utility>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

Region *LAMMPS_NS::fixed_region(LAMMPS *lmp, const std::string &id, const std::string &use)
{
  Region *region = lmp->domain->get_region_by_id(id);
  if (!region) lmp->error->all(FLERR, "Region ID {} for {} does not exist", id, use);
  if (region->dynamic_check()) lmp->error->all(FLERR, "Region {} for {} must not move", id, use);
  region->init();
  return region;
}

/* ---------------------------------------------------------------------- */

FlowInside::FlowInside(LAMMPS *lmp, std::string style, std::string region) :
    Pointers(lmp), style_(std::move(style)), region_id_(std::move(region))
{
}

/* ---------------------------------------------------------------------- */

fluid::Interior *FlowInside::find(const fluid::Flow &flow)
{
  if (interior_ || region_id_.empty()) return interior_.get();
  const auto region = enclosure();
  interior_ = std::make_unique<fluid::Interior>(flow.grid(), flow.decomposition(),
                                                [&](const fluid::Real3 &x) {
                                                  return region->contains({x[0], x[1], x[2]});
                                                });
  if (interior_->volume() == 0)
    error->all(FLERR, "Region {} for {} inside holds nothing of the simulation box", region_id_,
               style_);
  return interior_.get();
}

std::unique_ptr<RegionEnclosure> FlowInside::enclosure() const
{
  if (region_id_.empty()) return nullptr;
  return std::make_unique<RegionEnclosure>(fixed_region(lmp, region_id_, style_ + " inside"),
                                           domain);
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
