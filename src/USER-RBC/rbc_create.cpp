#include "rbc_create.h"

#include "atom.h"
#include "cells/rbc_cell_template.h"
#include "cells/rbc_region_enclosure.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_const.h"
#include "packing/cell_packing.h"
#include "random_park.h"
#include "region.h"
#include "support/rbc_gather.h"
#include "support/rbc_new_atoms.h"

#include <Eigen/Geometry>

using namespace LAMMPS_NS;
using rbc::Vec3;

/* ---------------------------------------------------------------------- */

void RBCCreate::command(int narg, char **arg)
{
  if (domain->box_exist == 0)
    error->all(FLERR, "Rbc/create must be used after the simulation box is defined");
  if (!atom->molecule_flag)
    error->all(FLERR, "Rbc/create requires atoms with molecule IDs: use atom_style molecular");
  if (domain->triclinic) error->all(FLERR, "Rbc/create requires an orthogonal simulation box");
  parse(narg, arg);

  const double begin = platform::walltime();
  std::vector<Cell> cells;
  if (single)
    cells.push_back(place_single());
  else
    cells = pack();
  create_atoms(cells);
  if (comm->me != 0) return;
  for (const Kind &kind : kinds)
    utils::logmesg(lmp, "Created {} cells of {} vertices\n", kind.count,
                   kind.shape->vertex_count());
  utils::logmesg(lmp, "  rbc/create CPU = {:.3f} seconds\n", platform::walltime() - begin);
}

/* ---------------------------------------------------------------------- */

void RBCCreate::parse(int narg, char **arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "rbc/create", error);
  kinds.push_back({arg[0], make_cell_template(lmp, arg[0], "rbc/create"), 1, 1, 1});

  int iarg = 1;
  const auto need = [&](int n, const std::string &keyword) {
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "rbc/create " + keyword, error);
  };
  const auto number = [&](int at) { return utils::numeric(FLERR, arg[at], false, lmp); };
  const auto atom_type = [&](int at) {
    const int type = utils::inumeric(FLERR, arg[at], false, lmp);
    if (type < 1 || type > atom->ntypes)
      error->all(FLERR, at, "Rbc/create type {} must be between 1 and {}", type, atom->ntypes);
    return type;
  };
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
      kinds[0].type = atom_type(iarg + 1);
      iarg += 2;
    } else if (keyword == "mix") {
      need(3, keyword);
      const double fraction = number(iarg + 2);
      if (!(fraction > 0 && fraction < 1))
        error->all(FLERR, iarg + 2, "Rbc/create mix fraction {} must be between 0 and 1",
                   arg[iarg + 2]);
      kinds.push_back({arg[iarg + 1], make_cell_template(lmp, arg[iarg + 1], "rbc/create mix"),
                       fraction, atom_type(iarg + 3), 0});
      kinds[0].fraction -= fraction;
      if (kinds[0].fraction < 1e-9)
        error->all(FLERR, iarg + 2,
                   "Rbc/create mix fractions must add up to less than 1, not {:.6g}",
                   1 - kinds[0].fraction);
      iarg += 4;
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
    } else if (keyword == "velocity") {
      need(1, keyword);
      speed = number(iarg + 1);
      if (!(speed >= 0))
        error->all(FLERR, iarg + 1, "Rbc/create velocity {} must be >= 0", arg[iarg + 1]);
      iarg += 2;
    } else
      error->all(FLERR, iarg,
                 "Unknown rbc/create keyword {}; allowed: single, rotate, number, hematocrit, mix, "
                 "region, seed, type, overlap, attempts, velocity",
                 keyword);
  }
  if (!placement) error->all(FLERR, "Rbc/create needs one of single, number and hematocrit");
  if (!single && !seeded) error->all(FLERR, "Rbc/create number and hematocrit need a seed");
  if (single && region) error->all(FLERR, "Rbc/create single takes no region");
  if (single && kinds.size() > 1) error->all(FLERR, "Rbc/create single takes no mix");
  if (single && speed > 0) error->all(FLERR, "Rbc/create single takes no velocity");
  if (gap < 0) gap = kinds[0].shape->mean_edge / 10;
  check_images();
  if (single) return;
  set_extent();
  set_counts();
}

/* ----------------------------------------------------------------------
   of each kind, with fractions as near as whole numbers allow
------------------------------------------------------------------------- */

void RBCCreate::set_counts()
{
  if (hematocrit > 0) {
    const double count = std::round(hematocrit * region_volume() / mean_cell_volume());
    if (count < 1)
      error->all(FLERR, "Rbc/create hematocrit {} is less than one cell in the volume of {:.6g}",
                 hematocrit, region_volume());
    if (count > MAXSMALLINT)
      error->all(FLERR, "Rbc/create hematocrit {} is {:.6g} cells: too many", hematocrit, count);
    wanted = static_cast<int>(count);
  }
  double fraction = 0;
  int before = 0;
  for (Kind &kind : kinds) {
    fraction += kind.fraction;
    const int here = static_cast<int>(std::lround(fraction * wanted));
    kind.count = here - before;
    before = here;
  }
}

double RBCCreate::mean_cell_volume() const
{
  double volume = 0;
  for (const Kind &kind : kinds) volume += kind.fraction * kind.shape->volume;
  return volume;
}

/* ----------------------------------------------------------------------
   a cell must not reach its own periodic images
------------------------------------------------------------------------- */

void RBCCreate::check_images() const
{
  for (const Kind &kind : kinds) {
    double radius = 0;
    for (const Vec3 &vertex : kind.shape->vertices) radius = std::max(radius, vertex.norm());
    for (int d = 0; d < 3; ++d)
      if (domain->periodicity[d] && domain->prd[d] < 2 * radius + gap)
        error->all(
            FLERR,
            "Rbc/create: the periodic box is {:.6g} long in {}; cells of {} need at least {:.6g}",
            domain->prd[d], "xyz"[d], kind.id, 2 * radius + gap);
  }
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

/* ---------------------------------------------------------------------- */

RBCCreate::Cell RBCCreate::place_single() const
{
  Cell cell{&kinds[0], centre, rotation};
  const double *lower = domain->boxlo, *upper = domain->boxhi;
  for (int v = 0; v < kinds[0].shape->vertex_count(); ++v) {
    const Vec3 vertex = cell.vertex(v);
    for (int d = 0; d < 3; ++d)
      if (!domain->periodicity[d] && (vertex[d] <= lower[d] || vertex[d] >= upper[d]))
        error->all(FLERR,
                   "Rbc/create single: a vertex at {} {:.6g} lies outside the simulation box, "
                   "{:.6g} to {:.6g}",
                   "xyz"[d], vertex[d], lower[d], upper[d]);
  }
  return cell;
}

std::vector<Vec3> RBCCreate::existing_atoms() const
{
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; ++i) mine.insert(mine.end(), atom->x[i], atom->x[i] + 3);
  const std::vector<double> all = gather_all(mine, world);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < all.size(); i += 3) places.emplace_back(&all[i]);
  // the same order, whichever rank has them
  std::sort(places.begin(), places.end(), [](const Vec3 &a, const Vec3 &b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return places;
}

std::vector<RBCCreate::Cell> RBCCreate::pack()
{
  const rbc::PackingBox box{
      Vec3(domain->boxlo),
      Vec3(domain->prd),
      {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0}};
  std::vector<const rbc::SurfaceTemplate *> templates;
  std::vector<int> kind_of;
  for (const Kind &kind : kinds) {
    kind_of.insert(kind_of.end(), kind.count, static_cast<int>(templates.size()));
    templates.push_back(kind.shape.get());
  }
  const auto share = [this](const std::vector<double> &mine) { return gather_all(mine, world); };
  rbc::CellPacking packing(box, templates, kind_of, gap, seed, {comm->me, comm->nprocs, share});
  packing.avoid(existing_atoms());
  const RegionEnclosure enclosure(region, domain, -gap / 2);
  if (region) packing.confine(enclosure, lo, length);

  if (!packing.pack(attempts)) {
    const double fraction = wanted * mean_cell_volume() / region_volume();
    error->all(
        FLERR,
        "Rbc/create could not pack {} cells without overlap in {} attempts; the densest "
        "reached is a volume fraction of {:.4g} of {:.4g} wanted; use fewer cells, a smaller "
        "overlap distance or more attempts",
        wanted, attempts, fraction * std::pow(packing.size(), 3), fraction);
  }
  if (comm->me == 0)
    utils::logmesg(lmp, "Packed cells in {} attempts; least distance of surfaces {:.6g}\n",
                   packing.steps_taken(), packing.least_gap());

  std::vector<Cell> cells;
  for (std::size_t c = 0; c < kind_of.size(); ++c)
    cells.push_back({&kinds[kind_of[c]], packing.cells()[c].centre, packing.cells()[c].rotation});
  return cells;
}

/* ----------------------------------------------------------------------
   consecutive atom IDs and one molecule ID for each cell; every rank creates the atoms it owns
------------------------------------------------------------------------- */

void RBCCreate::create_atoms(const std::vector<Cell> &cells)
{
  tagint molecule = 0;
  for (int i = 0; i < atom->nlocal; ++i) molecule = std::max(molecule, atom->molecule[i]);
  MPI_Allreduce(MPI_IN_PLACE, &molecule, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  bigint vertices = 0;
  for (const Cell &cell : cells) vertices += cell.kind->shape->vertex_count();

  RanPark random(lmp, std::max(seed, 1));
  NewAtoms atoms(lmp, "Rbc/create", vertices);
  for (const Cell &cell : cells) {
    ++molecule;
    double velocity[3];
    for (double &component : velocity) component = speed * (2 * random.uniform() - 1);
    for (int v = 0; v < cell.kind->shape->vertex_count(); ++v) {
      const NewAtoms::Made made = atoms.add(cell.kind->type, cell.vertex(v));
      if (made.index < 0) continue;
      atom->molecule[made.index] = molecule;
      atom->image[made.index] = made.image;
      std::copy(velocity, velocity + 3, atom->v[made.index]);
    }
  }
  atoms.finish();
  for (const Kind &kind : kinds) atoms.set_missing_mass(kind.type);
}
