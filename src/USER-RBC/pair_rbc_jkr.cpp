#include "pair_rbc_jkr.h"

#include "atom.h"
#include "cells/rbc_boundary_contact.h"
#include "cells/rbc_contact_coefficients.h"
#include "cells/rbc_near_surfaces.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

// How far along its own surface a vertex sees nothing, in cutoffs. A surface that turns by half a
// circle is as far from itself as the cutoff after pi / 2 of it. The rest is for surfaces that are
// compressed.

static constexpr double OWN_PATCH = 2.5;

/* ---------------------------------------------------------------------- */

PairRBCJKR::PairRBCJKR(LAMMPS *lmp) :
    Pair(lmp), coefficients(std::make_unique<ContactCoefficients>(lmp)),
    surfaces(std::make_unique<NearSurfaces>(lmp, "Pair rbc/jkr")),
    boundaries(std::make_unique<BoundaryContact>(lmp, "Pair rbc/jkr")),
    crossing(std::make_unique<CellCrossings>(
        lmp, "Pair rbc/jkr", *surfaces, [this](int i, int j) { return contact_range(i, j) > 0; }))
{
  writedata = 0;
  reinitflag = 1;
  manybody_flag = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  comm_reverse = comm_reverse_off = 3;    // comm_style tiled uses the first without newton, too
  nextra = 1;
  pvector = &adhered_area;
}

PairRBCJKR::~PairRBCJKR()
{
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairRBCJKR::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  std::fill_n(setflag[0], n * n, 0);
  std::fill_n(cutsq[0], n * n, 0.0);
  coefficients->allocate();
  type_pairs.assign(std::size_t(n) * n, {});
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::settings(int narg, char **arg)
{
  given = read_contact_settings(lmp, narg, arg);
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::coeff(int narg, char **arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "pair_coeff for rbc/jkr", error);
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const auto law = coefficients->read(narg, arg, 2);
  int count = 0;
  for (int i = ilo; i <= ihi; ++i)
    for (int j = std::max(jlo, i); j <= jhi; ++j) {
      coefficients->set(i, j, law);
      setflag[i][j] = 1;
      ++count;
    }
  if (count == 0) error->all(FLERR, "Incorrect args for pair coefficients");
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::init_style()
{
  if (offset_flag || tail_flag)
    error->all(FLERR, "Pair rbc/jkr does not know pair_modify shift or tail: its energy is zero "
                      "where contact is lost");
  init_lengths();
  surfaces->see_own_cells(given.self ? OWN_PATCH * cutoff : 0);
  surfaces->init();
  widest_gap = widest_gap_wanted(modify);
  check_cells();
  // pair_style hybrid may have taken pairs away
  std::fill(type_pairs.begin(), type_pairs.end(), TypePair());
  init_boundaries();
  range = 0;
  neighbor_calls = neighbor_step = seen_step = -1;
}

void PairRBCJKR::cells_changed()
{
  surfaces->cells_changed();
}

/* ----------------------------------------------------------------------
   a surface has the type of its vertices
------------------------------------------------------------------------- */

void PairRBCJKR::check_cells()
{
  const int n = atom->ntypes + 1;
  std::vector<char> touches(n);
  for (int i = 1; i < n; ++i)
    for (int j = i; j < n; ++j)
      if (setflag[i][j] && coefficients->touch(i, j)) touches[i] = touches[j] = 1;

  tagint lone = MAXTAGINT;
  for (int i = 0; i < atom->nlocal; ++i)
    if (touches[atom->type[i]] && !surfaces->is_vertex(i)) lone = std::min(lone, atom->tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &lone, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  if (lone != MAXTAGINT)
    error->all(FLERR,
               "Pair rbc/jkr: atom {} belongs to no cell of a fix rbc/membrane; types of other "
               "atoms need pair_coeff none",
               lone);

  const tagint mixed = surfaces->cell_of_mixed_type();
  if (mixed > 0)
    error->all(FLERR, "Pair rbc/jkr: the atoms of the cell with molecule ID {} must be of one type",
               mixed);
}

/* ---------------------------------------------------------------------- */

PairRBCJKR::TypePair PairRBCJKR::make_type_pair(int i, int j) const
{
  TypePair pair;
  pair.law = coefficients->law(i, j, unit);
  if (!pair.law) return pair;
  std::visit(
      [&pair](const auto &law) {
        pair.tip_radius = law.tip_radius();
        pair.detachment = law.detachment_overlap();
        pair.equilibrium = law.equilibrium_overlap();
        pair.work = law.work_per_area();
      },
      *pair.law);
  return pair;
}

const PairRBCJKR::TypePair &PairRBCJKR::types(int itype, int jtype) const
{
  return type_pairs[std::size_t(itype) * (atom->ntypes + 1) + jtype];
}

double PairRBCJKR::contact_range(int itype, int jtype) const
{
  const TypePair &pair = types(itype, jtype);
  return pair.law ? pair.range() : 0;
}

/* ----------------------------------------------------------------------
   two vertices may each move by half the skin until the next reneighboring, and by as much again
   within a step
------------------------------------------------------------------------- */

double PairRBCJKR::slack() const
{
  return 2 * neighbor->skin;
}

/* ----------------------------------------------------------------------
   LAMMPS adds the skin to the cutoff between atoms that is returned. Ghosts then reach all corners
   of the triangles in reach of an owned vertex.
------------------------------------------------------------------------- */

double PairRBCJKR::init_one(int i, int j)
{
  if (!setflag[i][j])
    error->all(FLERR, "Pair rbc/jkr does not mix: types {} {} need a pair_coeff", i, j);
  const int n = atom->ntypes + 1;
  const TypePair pair = make_type_pair(i, j);
  type_pairs[std::size_t(i) * n + j] = type_pairs[std::size_t(j) * n + i] = pair;
  if (i == j) boundaries->set_law(i, pair.law);
  if (!pair.law) return widest_gap > 0 && !has_law() ? ghost_reach() : 0;
  if (pair.range() > cutoff)
    error->all(FLERR,
               "Pair rbc/jkr cutoff {} must be at least {:.6g}, where surfaces of types {} {} lose "
               "contact",
               given.cutoff, pair.range() / unit, i, j);
  if (pair.equilibrium >= pair.tip_radius)
    error->all(FLERR, "Pair rbc/jkr: adhered surfaces of types {} {} would overlap by {:.6g}; {}",
               i, j, pair.equilibrium - pair.tip_radius,
               std::visit([](const auto &law) { return law.limit(); }, *pair.law));
  if (pair.range() > range) {
    range = pair.range();
    neighbor_calls = -1;    // fix adapt may have raised it
  }
  return ghost_reach();
}

bool PairRBCJKR::has_law() const
{
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j)
      if (setflag[i][j] && coefficients->touch(i, j)) return true;
  return false;
}

double PairRBCJKR::ghost_reach() const
{
  return std::max(cutoff, widest_gap) + surfaces->longest_edge() + slack() - neighbor->skin;
}

/* ---------------------------------------------------------------------- */

const std::vector<rbc::VertexContact> &PairRBCJKR::near_contacts() const
{
  return surfaces->last_contacts();
}

bool PairRBCJKR::sees_this_step() const
{
  return seen_step == update->ntimestep;
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::setup()
{
  if (comm->me != 0) return;
  log_boundaries();
  if (given.self)
    utils::logmesg(lmp,
                   "Pair rbc/jkr: cells touch themselves, too, further than {:.6g} along their "
                   "surface\n",
                   OWN_PATCH * cutoff);
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      const TypePair &pair = types(i, j);
      if (!setflag[i][j] || !pair.law) continue;
      const auto largest_adhesion = [](const auto &law) { return law.largest_adhesion(); };
      const auto repulsion = [&](const auto &law) {
        return law.per_area(pair.tip_radius).traction;
      };
      utils::logmesg(lmp,
                     "Pair rbc/jkr, types {} {}: gap {:.6g} at rest, range {:.6g}, work per area "
                     "{:.6g}, stress of adhesion up to {:.6g}, of repulsion {:.6g} where surfaces "
                     "meet\n",
                     i, j, pair.tip_radius - pair.equilibrium, pair.range(), pair.work,
                     std::visit(largest_adhesion, *pair.law), std::visit(repulsion, *pair.law));
    }
}

/* ---------------------------------------------------------------------- */

bool PairRBCJKR::neighbors_changed()
{
  if (neighbor_calls == neighbor->ncalls && neighbor_step == neighbor->lastcall) return false;
  neighbor_calls = neighbor->ncalls;
  neighbor_step = neighbor->lastcall;
  return true;
}

void PairRBCJKR::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  adhered_area = 0;
  if (seen_gap() == 0) return;    // no types touch
  finding.start();
  if (neighbors_changed()) {
    surfaces->build(seen_gap(), slack());
    if (given.has_boundaries()) boundaries->build(*surfaces, seen_gap(), slack());
  }
  const auto &contacts = surfaces->contacts(seen_gap());
  seen_step = update->ntimestep;
  finding.stop();

  interacting.start();
  add_forces(contacts);
  if (given.has_boundaries()) add_forces_of_boundaries();
  interacting.stop();
}

/* ----------------------------------------------------------------------
   a vertex stands for its share of area; its force returns to the corners of the triangle it meets.
   A pair of surfaces counts from both sides, so each side has half of the energy. A cell may meet
   itself from within, through its inside; then it repels itself only.
------------------------------------------------------------------------- */

void PairRBCJKR::add_forces(const std::vector<rbc::VertexContact> &contacts)
{
  const bool returned = force->newton;
  if (!returned) reactions.assign(3 * std::size_t(atom->nlocal + atom->nghost), 0.0);
  for (const auto &contact : contacts) {
    const int i = contact.point;
    const TypePair &pair = types(atom->type[i], atom->type[contact.corner[0]]);
    const bool through_inside =
        contact.gap < 0 && atom->molecule[i] == atom->molecule[contact.corner[0]];
    const double gap = through_inside ? -contact.gap : contact.gap;
    const double overlap = pair.tip_radius - gap;
    const double detachment = through_inside ? pair.equilibrium : pair.detachment;
    if (!pair.law || overlap <= detachment) continue;

    auto [traction, energy] =
        std::visit([overlap](const auto &law) { return law.per_area(overlap); }, *pair.law);
    if (through_inside) energy += pair.work;
    const double area = surfaces->area(i) / 2;
    const double side = through_inside ? -1 : 1;
    const double normal[3] = {side * contact.normal.x, side * contact.normal.y,
                              side * contact.normal.z};
    const double size = area * traction;
    for (int d = 0; d < 3; ++d) atom->f[i][d] += size * normal[d];
    for (int c = 0; c < 3; ++c) {
      double *const at =
          returned ? atom->f[contact.corner[c]] : &reactions[3 * std::size_t(contact.corner[c])];
      for (int d = 0; d < 3; ++d) at[d] -= contact.weight[c] * size * normal[d];
    }
    if (!through_inside) adhered_area += area;
    if (evflag) tally(i, area * energy, size * gap, normal);
  }
  if (returned) return;
  comm->reverse_comm(this);
  for (int i = 0; i < atom->nlocal; ++i)
    for (int d = 0; d < 3; ++d) atom->f[i][d] += reactions[3 * std::size_t(i) + d];
}

/* ----------------------------------------------------------------------
   energy and virial of a contact count to the vertex whose area it is
------------------------------------------------------------------------- */

void PairRBCJKR::tally(int i, double energy, double size, const double *normal)
{
  if (eflag_global) eng_vdwl += energy;
  if (eflag_atom) eatom[i] += energy;
  if (!vflag_either) return;
  const double v[6] = {size * normal[0] * normal[0], size * normal[1] * normal[1],
                       size * normal[2] * normal[2], size * normal[0] * normal[1],
                       size * normal[0] * normal[2], size * normal[1] * normal[2]};
  for (int n = 0; n < 6; ++n) {
    if (vflag_global) virial[n] += v[n];
    if (vflag_atom) vatom[i][n] += v[n];
  }
}

/* ---------------------------------------------------------------------- */

int PairRBCJKR::pack_reverse_comm(int n, int first, double *buf)
{
  std::copy_n(reactions.data() + 3 * std::size_t(first), 3 * std::size_t(n), buf);
  return 3 * n;
}

void PairRBCJKR::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int m = 0; m < n; ++m)
    for (int d = 0; d < 3; ++d) reactions[3 * std::size_t(list[m]) + d] += buf[3 * m + d];
}

/* ----------------------------------------------------------------------
   one tip at that distance from a flat: equation 7 itself, for pair_write
------------------------------------------------------------------------- */

double PairRBCJKR::single(int /*i*/, int /*j*/, int itype, int jtype, double rsq,
                          double /*factor_coul*/, double /*factor_lj*/, double &fforce)
{
  const double r = std::sqrt(rsq);
  const TypePair &pair = types(itype, jtype);
  const double overlap = pair.tip_radius - r;
  fforce = 0;
  if (!pair.law || overlap <= pair.detachment) return 0;
  fforce = std::visit([=](const auto &law) { return law.force(overlap); }, *pair.law) / r;
  return std::visit([=](const auto &law) { return law.energy(overlap); }, *pair.law);
}

/* ---------------------------------------------------------------------- */

void *PairRBCJKR::extract(const char *name, int &dim)
{
  dim = 2;
  return coefficients->parameter(name);
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      const double flag = setflag[i][j];
      fwrite(&flag, sizeof(double), 1, fp);
      coefficients->write_restart(fp, i, j);
    }
}

void PairRBCJKR::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      setflag[i][j] = static_cast<int>(read_number(fp));
      coefficients->read_restart(fp, i, j);
    }
}

double PairRBCJKR::read_number(FILE *fp)
{
  double number;
  if (comm->me == 0) utils::sfread(FLERR, &number, sizeof(double), 1, fp, nullptr, error);
  MPI_Bcast(&number, 1, MPI_DOUBLE, 0, world);
  return number;
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::write_restart_settings(FILE *fp)
{
  write_contact_settings(fp, given);
}

void PairRBCJKR::read_restart_settings(FILE *fp)
{
  given = read_contact_settings(lmp, fp);
}

/* ---------------------------------------------------------------------- */

double PairRBCJKR::memory_usage()
{
  return Pair::memory_usage() + surfaces->bytes() + boundaries->bytes() + crossing->bytes() +
         reactions.capacity() * sizeof(double);
}
