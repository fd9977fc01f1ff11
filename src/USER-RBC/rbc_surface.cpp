#include "rbc_surface.h"

#include "atom.h"
#include "cells/rbc_region_enclosure.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "region.h"
#include "support/rbc_arguments.h"
#include "support/rbc_new_atoms.h"
#include "vessel/surface_sampling.h"

#include <algorithm>

using namespace LAMMPS_NS;
using rbc::Vec3;

/* ---------------------------------------------------------------------- */

void RBCSurface::command(int narg, char **arg)
{
  if (domain->box_exist == 0)
    error->all(FLERR, "Rbc/surface must be used after the simulation box is defined");
  if (domain->triclinic) error->all(FLERR, "Rbc/surface requires an orthogonal simulation box");
  parse(narg, arg);

  const double begin = platform::walltime();
  const rbc::PackingBox box{
      Vec3(domain->boxlo),
      Vec3(domain->prd),
      {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0}};
  Vec3 lo, hi;
  extent(lo, hi);
  check_spacing(lo, hi);
  const RegionEnclosure enclosure(region, domain, offset);
  const rbc::SurfaceSampling surface(enclosure, box, lo, hi, spacing);
  if (surface.points().empty())
    error->all(FLERR, Error::ARGZERO, "Rbc/surface region {} has no surface in the simulation box",
               region->id);
  create_atoms(surface.points());
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Created {} atoms on a surface of area {:.6g}\n"
                   "  nearest neighbors are {:.4g} apart in the mean, {:.4g} at least\n"
                   "  no place of the surface is more than {:.4g} from an atom\n"
                   "  rbc/surface CPU = {:.3f} seconds\n",
                   surface.points().size(), surface.area(), surface.mean_distance(),
                   surface.least_distance(), surface.largest_hole(), platform::walltime() - begin);
}

/* ---------------------------------------------------------------------- */

void RBCSurface::parse(int narg, char **arg)
{
  if (narg < 1) utils::missing_cmd_args(FLERR, "rbc/surface", error);
  region = domain->get_region_by_id(arg[0]);
  if (!region)
    error->all(FLERR, Error::ARGZERO, "Region ID {} for rbc/surface does not exist", arg[0]);
  region->init();
  region->prematch();

  Arguments args(lmp, "rbc/surface", narg, arg, 1);
  args.read({{"type", [&] { type = args.atom_type(); }},
             {"spacing", [&] { spacing = args.positive(); }},
             {"offset", [&] { offset = args.number(); }},
             {"mass", [&] { mass = args.positive(); }}});
  if (type == 0) error->all(FLERR, "Rbc/surface needs type");
  if (spacing == 0) error->all(FLERR, "Rbc/surface needs spacing");
}

/* ----------------------------------------------------------------------
   the part of the box around the region, with room for the first outside nodes of a grid
------------------------------------------------------------------------- */

void RBCSurface::extent(Vec3 &lo, Vec3 &hi) const
{
  lo = Vec3(domain->boxlo);
  hi = Vec3(domain->boxhi);
  if (!region->bboxflag) return;
  const Vec3 low(region->extent_xlo, region->extent_ylo, region->extent_zlo),
      high(region->extent_xhi, region->extent_yhi, region->extent_zhi);
  const double margin = std::max(0.0, offset) + spacing;
  for (int d = 0; d < 3; ++d) {
    if (high[d] - low[d] + 2 * margin >= domain->prd[d]) continue;
    lo[d] = std::max(lo[d], low[d] - margin);
    hi[d] = std::min(hi[d], high[d] + margin);
  }
  if ((hi - lo).minCoeff() <= 0)
    error->all(FLERR, Error::ARGZERO, "Rbc/surface region {} has no surface in the simulation box",
               region->id);
}

/* ----------------------------------------------------------------------
   a spacing in other units would take days
------------------------------------------------------------------------- */

void RBCSurface::check_spacing(const Vec3 &lo, const Vec3 &hi) const
{
  constexpr double most = 1e11;
  const double places = rbc::SurfaceSampling::grid_size(lo, hi, spacing);
  if (places > most)
    error->all(FLERR, Error::ARGZERO,
               "Rbc/surface spacing {:g} asks for a look at {:.3g} places about region {}; at most "
               "{:g} are possible: check its unit, or use a larger spacing",
               spacing, places, region->id, most);
}

/* ---------------------------------------------------------------------- */

void RBCSurface::create_atoms(const std::vector<Vec3> &points)
{
  NewAtoms atoms(lmp, "Rbc/surface", static_cast<bigint>(points.size()));
  for (const Vec3 &x : points) atoms.add(type, x);    // molecule and image stay 0
  atoms.finish();
  if (atom->mass && mass > 0)
    atom->set_mass(FLERR, type, mass);
  else
    atoms.set_missing_mass(type);
}
