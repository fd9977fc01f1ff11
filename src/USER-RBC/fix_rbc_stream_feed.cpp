#include "cells/rbc_cell_membranes.h"
#include "coupling/rbc_driven_flow.h"
#include "coupling/rbc_flow_inside.h"
#include "domain.h"
#include "error.h"
#include "fix_rbc_port.h"
#include "fix_rbc_stream.h"
#include "region.h"

#include <cmath>

using namespace LAMMPS_NS;
using rbc::Vec3;

// Where new cells of fix rbc/stream appear.

// points along each side of the region's extent by which its volume is measured

static constexpr int SAMPLES = 32;

/* ---------------------------------------------------------------------- */

void FixRBCStream::find_feed()
{
  const std::string use = "f" + style.substr(1);
  for (const Outlet &outlet : outlets) fixed_region(lmp, outlet.region, use + " outlet");
  Region *const where = fixed_region(lmp, region, use);
  feed_lo = Vec3(domain->boxlo);
  Vec3 hi(domain->boxhi);
  if (where->bboxflag) {
    feed_lo = feed_lo.cwiseMax(Vec3(where->extent_xlo, where->extent_ylo, where->extent_zlo));
    hi = hi.cwiseMin(Vec3(where->extent_xhi, where->extent_yhi, where->extent_zhi));
  }
  feed_length = hi - feed_lo;
  feed.emplace(RegionEnclosure(where, domain, -gap / 2));
  const std::size_t in_region = feed_points().size();
  if (in_region == 0)
    error->all(FLERR, "Region {} for {} holds nothing of the simulation box", region, use);

  FixRBCPort *const inlet = find_port(port);
  const std::string vessel = inlet->driven_flow()->inside_region();
  if (!vessel.empty())
    feed->add(RegionEnclosure(fixed_region(lmp, vessel, use + " port"), domain, -gap));
  const std::vector<Vec3> points = feed_points();
  if (points.empty())
    error->all(FLERR, "Region {} for {} lies outside of the vessel, region {} of fix rbc/fluid {}",
               region, use, vessel, inlet->fluid_id());
  const double share = static_cast<double>(points.size()) / std::pow(SAMPLES, 3);
  room = hematocrit * share * feed_length.prod() / membranes->shape().volume;
  placement->confine(*feed, feed_lo, feed_length);
  const Vec3 periodic(domain->xperiodic, domain->yperiodic, domain->zperiodic);
  placement->repeat(periodic.cwiseProduct(Vec3(domain->prd)));
  if (along < 0) return;
  check_stretch(points, vessel);
  const std::vector<double> state = stretch ? stretch->state() : remembered;
  stretch.emplace(feed_length[along], lead());
  stretch->restore(state);
}

/* ----------------------------------------------------------------------
   those of a lattice that lie where cells appear
------------------------------------------------------------------------- */

std::vector<Vec3> FixRBCStream::feed_points() const
{
  std::vector<Vec3> points;
  if (feed_length.minCoeff() <= 0) return points;
  for (int n = 0; n < SAMPLES * SAMPLES * SAMPLES; ++n) {
    const Vec3 place(n % SAMPLES, n / SAMPLES % SAMPLES, n / (SAMPLES * SAMPLES));
    const Vec3 share = (place.array() + 0.5).matrix() / SAMPLES;
    points.emplace_back(feed_lo + feed_length.cwiseProduct(share));
    if (!feed->contains(points.back())) points.pop_back();
  }
  return points;
}

/* ----------------------------------------------------------------------
   how far before a periodic stretch copies appear: about a diameter of a cell
------------------------------------------------------------------------- */

double FixRBCStream::lead() const
{
  return 2 * placement->reach();
}

/* ----------------------------------------------------------------------
   Copies reach half a diameter further than their centres. They need a vessel there, too.
------------------------------------------------------------------------- */

void FixRBCStream::check_stretch(const std::vector<Vec3> &points, const std::string &vessel) const
{
  if (feed_length[along] < 2 * lead())
    error->all(FLERR,
               "{} periodic: region {} is {:.4g} long; it must be {:.4g} or more, four radii of a "
               "cell",
               style, region, feed_length[along], 2 * lead());
  if (vessel.empty()) return;
  const double before = lead() + placement->reach();
  const RegionEnclosure around(domain->get_region_by_id(vessel), domain);
  for (Vec3 point : points) {
    if (place_along(point) > feed_length[along] / SAMPLES) continue;
    point[along] -= upwards ? before : -before;
    if (!around.contains(point))
      error->all(FLERR,
                 "{} periodic: the vessel must go on straight for {:.4g} before region {}, where "
                 "copies of cells come from",
                 style, before, region);
  }
}
