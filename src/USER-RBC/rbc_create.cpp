#include "rbc_create.h"

#include "atom.h"
#include "atom_vec.h"
#include "cell_packing.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_const.h"
#include "random_park.h"
#include "rbc_cell_template.h"
#include "region.h"

#include <Eigen/Geometry>

using namespace LAMMPS_NS;
using rbc::Vec3;

namespace {

/// Uniformly distributed over all rotations (Shoemake, Graphics Gems III, 1992).
Eigen::Matrix3d random_rotation(RanPark &random)
{
  const double u = random.uniform(), a = MathConst::MY_2PI * random.uniform(),
               b = MathConst::MY_2PI * random.uniform();
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a),
                            std::sqrt(1 - u) * std::cos(a), std::sqrt(u) * std::sin(b))
      .toRotationMatrix();
}

}    // namespace

/* ---------------------------------------------------------------------- */

void RBCCreate::command(int narg, char **arg)
{
  if (domain->box_exist == 0)
    error->all(FLERR, "Rbc/create must be used after the simulation box is defined");
  if (!atom->molecule_flag)
    error->all(FLERR, "Rbc/create requires atoms with molecule IDs: use atom_style molecular");
  if (domain->triclinic) error->all(FLERR, "Rbc/create requires an orthogonal simulation box");
  parse(narg, arg);

  std::vector<Vertices> cells;
  if (single) {
    cells.emplace_back();
    for (const Vec3 &vertex : shape->vertices) cells[0].push_back(centre + rotation * vertex);
    const double *lower = domain->boxlo, *upper = domain->boxhi;
    for (const Vec3 &vertex : cells[0])
      for (int d = 0; d < 3; ++d)
        if (!domain->periodicity[d] && (vertex[d] <= lower[d] || vertex[d] >= upper[d]))
          error->all(FLERR,
                     "Rbc/create single: a vertex at {} {:.6g} lies outside the simulation box, "
                     "{:.6g} to {:.6g}",
                     "xyz"[d], vertex[d], lower[d], upper[d]);
  } else
    cells = place_randomly();
  create_atoms(cells);
  if (comm->me == 0)
    utils::logmesg(lmp, "Created {} cells of {} vertices\n", cells.size(), shape->size());
}

/* ---------------------------------------------------------------------- */

void RBCCreate::parse(int narg, char **arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "rbc/create", error);
  template_id = arg[0];
  shape = make_cell_template(lmp, template_id, "rbc/create");

  int iarg = 1;
  const auto need = [&](int n, const std::string &keyword) {
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "rbc/create " + keyword, error);
  };
  const auto number = [&](int at) { return utils::numeric(FLERR, arg[at], false, lmp); };
  bool placement = false, seeded = false;
  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (keyword == "single" || keyword == "number" || keyword == "hematocrit") {
      if (placement)
        error->all(FLERR, iarg, "Rbc/create takes only one of single, number and hematocrit");
      placement = true;
    }
    if (keyword == "single") {
      need(3, keyword);
      single = true;
      centre = {number(iarg + 1), number(iarg + 2), number(iarg + 3)};
      iarg += 4;
    } else if (keyword == "rotate") {
      need(4, keyword);
      if (!single)
        error->all(FLERR, iarg,
                   "Rbc/create rotate belongs to single: other cells are turned at random");
      const Vec3 axis(number(iarg + 2), number(iarg + 3), number(iarg + 4));
      if (axis.norm() == 0) error->all(FLERR, iarg + 2, "Rbc/create rotate axis must not be 0 0 0");
      rotation = Eigen::AngleAxisd(number(iarg + 1) * MathConst::DEG2RAD, axis.normalized())
                     .toRotationMatrix();
      iarg += 5;
    } else if (keyword == "number") {
      need(1, keyword);
      wanted = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (wanted < 1) error->all(FLERR, iarg + 1, "Rbc/create number {} must be > 0", wanted);
      iarg += 2;
    } else if (keyword == "hematocrit") {
      need(1, keyword);
      hematocrit = number(iarg + 1);
      if (hematocrit <= 0 || hematocrit >= 1)
        error->all(FLERR, iarg + 1, "Rbc/create hematocrit {} must be between 0 and 1",
                   arg[iarg + 1]);
      iarg += 2;
    } else if (keyword == "region") {
      need(1, keyword);
      region = domain->get_region_by_id(arg[iarg + 1]);
      if (!region)
        error->all(FLERR, iarg + 1, "Region ID {} for rbc/create does not exist", arg[iarg + 1]);
      region->init();
      region->prematch();
      iarg += 2;
    } else if (keyword == "seed") {
      need(1, keyword);
      seed = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (seed <= 0) error->all(FLERR, iarg + 1, "Rbc/create seed {} must be > 0", seed);
      seeded = true;
      iarg += 2;
    } else if (keyword == "type") {
      need(1, keyword);
      type = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (type < 1 || type > atom->ntypes)
        error->all(FLERR, iarg + 1, "Rbc/create type {} must be between 1 and {}", type,
                   atom->ntypes);
      iarg += 2;
    } else if (keyword == "overlap") {
      need(1, keyword);
      gap = number(iarg + 1);
      if (!(gap > 0))
        error->all(FLERR, iarg + 1, "Rbc/create overlap distance {} must be > 0", arg[iarg + 1]);
      iarg += 2;
    } else if (keyword == "attempts") {
      need(1, keyword);
      attempts = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (attempts < 1) error->all(FLERR, iarg + 1, "Rbc/create attempts {} must be > 0", attempts);
      iarg += 2;
    } else
      error->all(FLERR, iarg,
                 "Unknown rbc/create keyword {}; allowed: single, rotate, number, hematocrit, "
                 "region, seed, type, "
                 "overlap, attempts",
                 keyword);
  }
  if (!placement) error->all(FLERR, "Rbc/create needs one of single, number and hematocrit");
  if (!single && !seeded) error->all(FLERR, "Rbc/create number and hematocrit need a seed");
  if (single && region) error->all(FLERR, "Rbc/create single takes no region");
  if (gap < 0) gap = shape->mean_edge;
  check_images();
  if (type == 0) type = 1;
  set_extent();
  if (hematocrit > 0) {
    wanted = static_cast<int>(std::lround(hematocrit * region_volume() / shape->volume));
    if (wanted < 1)
      error->all(FLERR, "Rbc/create hematocrit {} is less than one cell in the volume of {:.6g}",
                 hematocrit, region_volume());
  }
}

/* ----------------------------------------------------------------------
   a cell must not reach its own periodic images
------------------------------------------------------------------------- */

void RBCCreate::check_images() const
{
  double radius = 0;
  for (const Vec3 &vertex : shape->vertices) radius = std::max(radius, vertex.norm());
  for (int d = 0; d < 3; ++d)
    if (domain->periodicity[d] && domain->prd[d] < 2 * radius + gap)
      error->all(
          FLERR,
          "Rbc/create: the periodic box is {:.6g} long in {}; cells of {} need at least {:.6g}",
          domain->prd[d], "xyz"[d], template_id, 2 * radius + gap);
}

/* ----------------------------------------------------------------------
   the part of the box around the region
------------------------------------------------------------------------- */

void RBCCreate::set_extent()
{
  lo = Vec3(domain->boxlo);
  Vec3 hi(domain->boxhi);
  if (region && region->bboxflag) {
    lo = lo.cwiseMax(Vec3(region->extent_xlo, region->extent_ylo, region->extent_zlo));
    hi = hi.cwiseMin(Vec3(region->extent_xhi, region->extent_yhi, region->extent_zhi));
  }
  length = hi - lo;
  if (region && (length.minCoeff() <= 0 || region_volume() == 0))
    error->all(FLERR, "Rbc/create region {} holds nothing of the simulation box", region->id);
}

/* ----------------------------------------------------------------------
   by sampling where there is a region
------------------------------------------------------------------------- */

double RBCCreate::region_volume() const
{
  if (!region) return length.prod();
  constexpr int n = 64;
  int inside = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 x = lo + length.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5) / n);
        inside += region->match(x[0], x[1], x[2]);
      }
  return length.prod() * inside / (double(n) * n * n);
}

/* ----------------------------------------------------------------------
   random sequential placement, the same on all ranks
------------------------------------------------------------------------- */

std::vector<RBCCreate::Vertices> RBCCreate::place_randomly()
{
  rbc::CellPacking packing(Vec3(domain->boxlo), Vec3(domain->prd),
                           {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0},
                           gap);

  std::vector<int> counts(comm->nprocs), begins(comm->nprocs);
  const int mine = 3 * atom->nlocal;
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int r = 1; r < comm->nprocs; ++r) begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<double> present(begins.back() + counts.back());
  MPI_Allgatherv(mine ? atom->x[0] : nullptr, mine, MPI_DOUBLE, present.data(), counts.data(),
                 begins.data(), MPI_DOUBLE, world);
  Vertices others;
  for (std::size_t i = 0; i < present.size(); i += 3) others.emplace_back(&present[i]);
  packing.add(others);

  const auto in_region = [&](const Vertices &vertices) {
    if (!region) return true;
    for (const Vec3 &vertex : vertices) {
      double x[3] = {vertex[0], vertex[1], vertex[2]};
      domain->remap(x);
      if (!region->match(x[0], x[1], x[2])) return false;
    }
    return true;
  };

  RanPark random(lmp, seed);
  std::vector<Vertices> cells;
  for (int tries = 0; static_cast<int>(cells.size()) < wanted; ++tries) {
    if (tries == attempts)
      error->all(FLERR,
                 "Rbc/create could place only {} of {} cells without overlap after {} attempts for "
                 "the next one; the "
                 "densest reached is a volume fraction of {:.4g} of {:.4g} wanted; use fewer "
                 "cells, a smaller overlap "
                 "distance or more attempts",
                 cells.size(), wanted, attempts, cells.size() * shape->volume / region_volume(),
                 wanted * shape->volume / region_volume());
    Vec3 where;
    for (int d = 0; d < 3; ++d) where[d] = lo[d] + random.uniform() * length[d];
    const Eigen::Matrix3d turn = random_rotation(random);
    Vertices candidate;
    for (const Vec3 &vertex : shape->vertices) candidate.push_back(where + turn * vertex);
    if (!in_region(candidate) || !packing.fits(candidate)) continue;
    packing.add(candidate);
    cells.push_back(std::move(candidate));
    tries = -1;
  }
  return cells;
}

/* ----------------------------------------------------------------------
   consecutive atom IDs and one molecule ID for each cell; every rank creates the atoms it owns
------------------------------------------------------------------------- */

void RBCCreate::create_atoms(const std::vector<Vertices> &cells)
{
  tagint last[2] = {0, 0};
  for (int i = 0; i < atom->nlocal; ++i) {
    last[0] = std::max(last[0], atom->tag[i]);
    last[1] = std::max(last[1], atom->molecule[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, last, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  if (last[0] + static_cast<bigint>(cells.size()) * shape->size() > MAXTAGINT)
    error->all(FLERR, "Rbc/create: too many atoms for atom IDs");

  const int nlocal_previous = atom->nlocal;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int v = 0; v < shape->size(); ++v) {
      double x[3] = {cells[c][v][0], cells[c][v][1], cells[c][v][2]};
      imageint image = ((imageint)IMGMAX << IMG2BITS) | ((imageint)IMGMAX << IMGBITS) | IMGMAX;
      domain->remap(x, image);
      int place[3];
      if (comm->coord2proc(x, place[0], place[1], place[2]) != comm->me) continue;
      atom->avec->create_atom(type, x);
      const int i = atom->nlocal - 1;
      atom->tag[i] = last[0] + static_cast<tagint>(c) * shape->size() + v + 1;
      atom->molecule[i] = last[1] + static_cast<tagint>(c) + 1;
      atom->image[i] = image;
    }
  atom->data_fix_compute_variable(nlocal_previous, atom->nlocal);

  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }

  // LAMMPS wants a mass; fix rbc/ib uses it with scheme direct only

  if (atom->mass && !atom->mass_setflag[type]) {
    atom->set_mass(FLERR, type, 1.0);
    if (comm->me == 0)
      utils::logmesg(lmp, "Mass of atom type {} set to 1.0, for it has not been set\n", type);
  }
}
