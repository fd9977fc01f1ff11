#include "rbc_create.h"

#include "atom.h"
#include "cells/rbc_cell_places.h"
#include "cells/rbc_cell_template.h"
#include "cells/rbc_region_enclosure.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "packing/cell_packing.h"
#include "random_park.h"
#include "region.h"
#include "support/rbc_arguments.h"
#include "support/rbc_gather.h"
#include "support/rbc_new_atoms.h"

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
  if (given_by == "single")
    cells.push_back(place(centre, rotation, "single"));
  else if (!given_by.empty())
    cells = place_all();
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

  bool placement = false, seeded = false;
  Arguments args(lmp, "rbc/create", narg, arg, 1);
  const auto place = [&](const std::string &word = "") {
    if (placement)
      args.fail("Rbc/create takes only one of single, file, hemocell, number and hematocrit");
    placement = true;
    given_by = word;
  };
  const auto place_by = [&](const std::string &word) {
    place(word);
    file = args.text();
  };
  args.read({{"single",
              [&] {
                place("single");
                for (int d = 0; d < 3; ++d) centre[d] = args.number();
              }},
             {"rotate", [&] { read_rotation(args); }},
             {"file", [&] { place_by("file"); }},
             {"hemocell", [&] { place_by("hemocell"); }},
             {"number",
              [&] {
                place();
                wanted = args.whole(1, MAXSMALLINT);
              }},
             {"hematocrit",
              [&] {
                place();
                hematocrit = args.between(0, 1);
              }},
             {"mix", [&] { read_mix(args); }},
             {"region", [&] { read_region(args); }},
             {"seed",
              [&] {
                seed = args.whole(1, MAXSMALLINT);
                seeded = true;
              }},
             {"type", [&] { kinds[0].type = args.atom_type(); }},
             {"overlap", [&] { gap = args.positive(); }},
             {"attempts", [&] { attempts = args.whole(1, MAXSMALLINT); }},
             {"velocity", [&] { speed = args.not_negative(); }}});
  if (!placement)
    error->all(FLERR, "Rbc/create needs one of single, file, hemocell, number and hematocrit");
  check_words(seeded);
  if (gap < 0) gap = kinds[0].shape->mean_edge / 10;
  check_images();
  if (!given_by.empty()) return;
  set_extent();
  set_counts();
}

/* ----------------------------------------------------------------------
   which keywords go together
------------------------------------------------------------------------- */

void RBCCreate::check_words(bool seeded) const
{
  const bool given = !given_by.empty();
  if (!given && !seeded) error->all(FLERR, "Rbc/create number and hematocrit need a seed");
  if (given && region) error->all(FLERR, "Rbc/create {} takes no region", given_by);
  if (given && kinds.size() > 1) error->all(FLERR, "Rbc/create {} takes no mix", given_by);
  if (given_by == "single" && speed > 0) error->all(FLERR, "Rbc/create single takes no velocity");
  if (given && speed > 0 && !seeded)
    error->all(FLERR, "Rbc/create {} with velocity needs a seed", given_by);
}

/* ---------------------------------------------------------------------- */

void RBCCreate::read_rotation(Arguments &args)
{
  if (given_by != "single")
    args.fail("Rbc/create rotate belongs to single: other cells are turned at random");
  const double angle = args.number();
  Vec3 axis;
  for (int d = 0; d < 3; ++d) axis[d] = args.number();
  if (axis.norm() == 0) args.fail("Rbc/create rotate axis must not be 0 0 0");
  rotation = rotation_about(angle, axis);
}

void RBCCreate::read_region(Arguments &args)
{
  const std::string id = args.text();
  region = domain->get_region_by_id(id);
  if (!region) args.fail("Region ID {} for rbc/create does not exist", id);
  region->init();
  region->prematch();
}

void RBCCreate::read_mix(Arguments &args)
{
  const std::string id = args.text();
  const double fraction = args.between(0, 1, "mix fraction");
  kinds[0].fraction -= fraction;
  if (kinds[0].fraction < 1e-9)
    args.fail("Rbc/create mix fractions must add up to less than 1, not {:.6g}",
              1 - kinds[0].fraction);
  const int type = args.atom_type("type");
  const auto same =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind &kind) { return kind.id == id; });
  std::shared_ptr<const rbc::SurfaceTemplate> shape;
  if (same != kinds.end())
    shape = same->shape;
  else
    shape = make_cell_template(lmp, id, "rbc/create mix");
  kinds.push_back({id, shape, fraction, type, 0});
}

/* ----------------------------------------------------------------------
   of each kind, with fractions as near as whole numbers allow. What cannot fit is not tried: it
   would take long to fail.
------------------------------------------------------------------------- */

void RBCCreate::set_counts()
{
  if (hematocrit > 0) {
    const double count = std::round(hematocrit * volume / mean_cell_volume());
    if (count < 1)
      error->all(FLERR, "Rbc/create hematocrit {} is less than one cell in the volume of {:.6g}",
                 hematocrit, volume);
    if (count > MAXSMALLINT)
      error->all(FLERR, "Rbc/create hematocrit {} is {:.6g} cells: too many", hematocrit, count);
    wanted = static_cast<int>(count);
  }
  double fraction = 0, filled = 0;
  int before = 0;
  for (Kind &kind : kinds) {
    fraction += kind.fraction;
    const int here = static_cast<int>(std::lround(fraction * wanted));
    kind.count = here - before;
    before = here;
    filled += kind.count * kind.shape->volume;
  }
  if (filled >= volume)
    error->all(FLERR,
               "Rbc/create: the volume of {} cells, {:.6g}, must be below that of the {} they are "
               "packed into, {:.6g}",
               wanted, filled, region ? "region" : "box", volume);
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
  volume = length.minCoeff() > 0 ? region_volume() : 0;
  if (region && volume == 0)
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

RBCCreate::Cell RBCCreate::place(const Vec3 &at, const Eigen::Matrix3d &turned,
                                 const std::string &what) const
{
  Cell cell{&kinds[0], at, turned};
  const double *lower = domain->boxlo, *upper = domain->boxhi;
  for (int v = 0; v < kinds[0].shape->vertex_count(); ++v) {
    const Vec3 vertex = cell.vertex(v);
    for (int d = 0; d < 3; ++d) {
      if (!domain->periodicity[d] && (vertex[d] <= lower[d] || vertex[d] >= upper[d]))
        error->all(FLERR,
                   "Rbc/create {}: a vertex at {} {:.6g} lies outside the simulation box, "
                   "{:.6g} to {:.6g}",
                   what, "xyz"[d], vertex[d], lower[d], upper[d]);
      const double boxes = std::floor((vertex[d] - lower[d]) / domain->prd[d]);
      if (boxes < -IMGMAX || boxes >= IMGMAX)
        error->all(FLERR,
                   "Rbc/create {}: a vertex at {} {:.6g} lies {:.6g} boxes away; image flags "
                   "of the periodic box go from {} to {}",
                   what, "xyz"[d], vertex[d], boxes, -IMGMAX, IMGMAX - 1);
    }
  }
  return cell;
}

std::vector<RBCCreate::Cell> RBCCreate::place_all()
{
  std::vector<Cell> cells;
  const PlaceForm form = given_by == "hemocell" ? PlaceForm::hemocell : PlaceForm::axis;
  for (const CellPlace &at : read_cell_places(lmp, file, form, "Rbc/create " + given_by))
    cells.push_back(
        place(at.origin, at.rotation, fmt::format("{}: line {} of {}", given_by, at.line, file)));
  kinds[0].count = static_cast<int>(cells.size());
  return cells;
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
  std::vector<const Kind *> kind_of;    // of each cell
  std::vector<int> template_of;
  for (const Kind &kind : kinds) {
    const auto same = std::find(templates.begin(), templates.end(), kind.shape.get());
    kind_of.insert(kind_of.end(), kind.count, &kind);
    template_of.insert(template_of.end(), kind.count, static_cast<int>(same - templates.begin()));
    if (same == templates.end()) templates.push_back(kind.shape.get());
  }
  const auto share = [this](const std::vector<double> &mine) { return gather_all(mine, world); };
  rbc::CellPacking packing(box, templates, template_of, gap, seed, {comm->me, comm->nprocs, share});
  packing.avoid(existing_atoms());
  const RegionEnclosure enclosure(region, domain, -gap / 2, RegionEnclosure::PeriodicSides::open);
  if (region) packing.confine(enclosure, lo, length);

  if (!packing.pack(attempts)) fail_to_pack(packing.size());
  if (comm->me == 0)
    utils::logmesg(lmp, "Packed cells in {} attempts; least distance of surfaces {:.6g}\n",
                   packing.steps_taken(), packing.least_gap());

  std::vector<Cell> cells;
  for (std::size_t c = 0; c < kind_of.size(); ++c)
    cells.push_back({kind_of[c], packing.cells()[c].centre, packing.cells()[c].rotation});
  return cells;
}

/* ----------------------------------------------------------------------
   cells fit without overlap if they are that small a part of their size; 0: at none that was tried
------------------------------------------------------------------------- */

void RBCCreate::fail_to_pack(double size) const
{
  const double filled = wanted * mean_cell_volume(), box = Vec3(domain->prd).prod();
  const std::string part = region ? fmt::format("region {}", region->id) : "the box";
  const std::string reached = size > 0
                                  ? fmt::format("the densest reached is {:.4g} of {}",
                                                filled / volume * std::pow(size, 3), part)
                                  : "there was no room for all of them at any size that was tried";
  const std::string there =
      atom->natoms > 0
          ? fmt::format(
                " beside the {} atoms that are there already (a restart file has cells, too)",
                atom->natoms)
          : "";
  error->all(
      FLERR,
      "Rbc/create could not pack {} cells, {:.4g} of {}{}, without overlap in {} attempts{}; "
      "{}; use fewer cells, another seed, a smaller overlap distance{} or more attempts",
      wanted, filled / volume, part,
      region ? fmt::format(" and {:.4g} of the box", filled / box) : "", attempts, there, reached,
      region ? ", a region that ends at INF in periodic directions" : "");
}

/* ----------------------------------------------------------------------
   consecutive atom IDs and one molecule ID for each cell; every rank creates the atoms it owns
------------------------------------------------------------------------- */

void RBCCreate::create_atoms(const std::vector<Cell> &cells)
{
  tagint molecule = 0;
  for (int i = 0; i < atom->nlocal; ++i) molecule = std::max(molecule, atom->molecule[i]);
  MPI_Allreduce(MPI_IN_PLACE, &molecule, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (molecule > MAXTAGINT - static_cast<tagint>(cells.size()))
    error->all(FLERR, "Rbc/create: no molecule IDs are left for {} cells beyond {}, the largest",
               cells.size(), molecule);
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
