#include "pair_rbc_jkr.h"

#include "atom.h"
#include "cells/rbc_near_surfaces.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "math_const.h"
#include "memory.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using rbc::TipContact;

// of the cutoff: how far along its own surface a vertex sees nothing. A surface that turns by half a circle is as far from
// itself as the cutoff after pi / 2 of it; the rest is for surfaces that are compressed.

static constexpr double OWN_PATCH = 2.5;

/* ---------------------------------------------------------------------- */

PairRBCJKR::PairRBCJKR(LAMMPS *lmp) :
    Pair(lmp), surfaces(std::make_unique<NearSurfaces>(lmp, "Pair rbc/jkr"))
{
  writedata = 0;
  reinitflag = 1;
  manybody_flag = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  comm_reverse_off = 3;
  nextra = 1;
  pvector = &adhered_area;
}

PairRBCJKR::~PairRBCJKR()
{
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
  memory->destroy(kind);
  memory->destroy(modulus);
  memory->destroy(work);
  memory->destroy(radius);
}

void PairRBCJKR::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  memory->create(kind, n, n, "pair:kind");
  memory->create(modulus, n, n, "pair:modulus");
  memory->create(work, n, n, "pair:work");
  memory->create(radius, n, n, "pair:radius");
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      setflag[i][j] = kind[i][j] = 0;
      cutsq[i][j] = modulus[i][j] = work[i][j] = radius[i][j] = 0;
    }
  tips.assign(std::size_t(n) * n, {});
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::report_to(const std::shared_ptr<CollectiveStop> &driver)
{
  surfaces->report_to(driver);
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::settings(int narg, char **arg)
{
  if (narg < 1) utils::missing_cmd_args(FLERR, "pair_style rbc/jkr", error);
  cutoff = utils::numeric(FLERR, arg[0], false, lmp);
  if (!(cutoff > 0) || !std::isfinite(cutoff))
    error->all(FLERR, "Pair_style rbc/jkr cutoff {} must be > 0", arg[0]);
  own_cells = false;
  for (int at = 1; at < narg; at += 2) {
    if (strcmp(arg[at], "self") != 0)
      error->all(FLERR, at, "Unknown pair_style rbc/jkr keyword {}; allowed: self", arg[at]);
    if (at + 1 == narg) utils::missing_cmd_args(FLERR, "pair_style rbc/jkr self", error);
    own_cells = utils::logical(FLERR, arg[at + 1], false, lmp);
  }
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::coeff(int narg, char **arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "pair_coeff for rbc/jkr", error);
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const std::string word = arg[2];
  const auto numbers = [&](int count, const std::string &names) {
    if (narg != 3 + count)
      error->all(FLERR, "Pair_coeff rbc/jkr {} takes {} values ({}), not {}", word, count, names,
                 narg - 3);
  };
  const auto positive = [&](int at, const std::string &name) {
    const double value = utils::numeric(FLERR, arg[at], false, lmp);
    if (!(value > 0) || !std::isfinite(value))
      error->all(FLERR, at, "Pair_coeff rbc/jkr {} {} value {} must be > 0", word, name, arg[at]);
    return value;
  };

  Kind which = NONE;
  double K = 0, sigma = 0, R = 0;
  if (word == "adhesive") {
    numbers(3, "K sigma R");
    which = ADHESIVE;
    K = positive(3, "K");
    sigma = positive(4, "sigma");
    R = positive(5, "R");
  } else if (word == "repulsive") {
    numbers(2, "K R");
    which = REPULSIVE;
    K = positive(3, "K");
    R = positive(4, "R");
  } else if (word == "none")
    numbers(0, "none");
  else
    error->all(FLERR, 2, "Unknown pair_coeff rbc/jkr word {}; allowed: adhesive, repulsive, none",
               word);

  int count = 0;
  for (int i = ilo; i <= ihi; ++i)
    for (int j = std::max(jlo, i); j <= jhi; ++j) {
      kind[i][j] = which;
      modulus[i][j] = K;
      work[i][j] = sigma;
      radius[i][j] = R;
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
  surfaces->see_own_cells(own_cells ? OWN_PATCH * cutoff : 0);
  surfaces->init();
  check_cells();
  std::fill(tips.begin(), tips.end(),
            TipContact());    // pair_style hybrid may have taken pairs away
  range = 0;
  neighbor_calls = neighbor_step = -1;
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
      if (setflag[i][j] && kind[i][j] != NONE) touches[i] = touches[j] = 1;

  tagint lone = MAXTAGINT, mixed = MAXTAGINT, largest = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!surfaces->is_vertex(i)) {
      if (touches[atom->type[i]]) lone = std::min(lone, atom->tag[i]);
    } else
      largest = std::max(largest, atom->molecule[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, &lone, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (lone != MAXTAGINT)
    error->all(FLERR,
               "Pair rbc/jkr: atom {} belongs to no cell of a fix rbc/membrane; types of other "
               "atoms need pair_coeff none",
               lone);

  std::vector<int> extremes(2 * (largest + 1), n);    // lowest type and (negated) highest
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!surfaces->is_vertex(i)) continue;
    int *const of = &extremes[2 * atom->molecule[i]];
    of[0] = std::min(of[0], atom->type[i]);
    of[1] = std::min(of[1], -atom->type[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, extremes.data(), static_cast<int>(extremes.size()), MPI_INT, MPI_MIN,
                world);
  for (tagint m = largest; m >= 0; --m)
    if (extremes[2 * m] < n && extremes[2 * m] != -extremes[2 * m + 1]) mixed = m;
  if (mixed != MAXTAGINT)
    error->all(FLERR, "Pair rbc/jkr: the atoms of the cell with molecule ID {} must be of one type",
               mixed);
}

/* ---------------------------------------------------------------------- */

TipContact PairRBCJKR::make_tip(int i, int j) const
{
  switch (kind[i][j]) {
    case ADHESIVE:
      return TipContact::adhesive(modulus[i][j], work[i][j], radius[i][j]);
    case REPULSIVE:
      return TipContact::repulsive(modulus[i][j], radius[i][j]);
    default:
      return {};
  }
}

const TipContact &PairRBCJKR::tip(int itype, int jtype) const
{
  return tips[std::size_t(itype) * (atom->ntypes + 1) + jtype];
}

double PairRBCJKR::range_of(int i, int j) const
{
  return tip(i, j).tip_radius() - tip(i, j).separation();
}

/* ----------------------------------------------------------------------
   two vertices may each move by half the skin until the next reneighboring, and by as much again within a step
------------------------------------------------------------------------- */

double PairRBCJKR::slack() const
{
  return 2 * neighbor->skin;
}

/* ----------------------------------------------------------------------
   the cutoff between atoms, to which LAMMPS adds the skin, leaves ghosts enough for all corners of triangles in reach
------------------------------------------------------------------------- */

double PairRBCJKR::init_one(int i, int j)
{
  if (!setflag[i][j])
    error->all(FLERR, "Pair rbc/jkr does not mix: types {} {} need a pair_coeff", i, j);
  const int n = atom->ntypes + 1;
  tips[std::size_t(i) * n + j] = tips[std::size_t(j) * n + i] = make_tip(i, j);
  const TipContact &contact = tip(i, j);
  if (!contact.touches()) return 0;
  if (range_of(i, j) > cutoff)
    error->all(FLERR,
               "Pair rbc/jkr cutoff {} must be at least {:.6g}, where surfaces of types {} {} lose "
               "contact",
               cutoff, range_of(i, j), i, j);
  if (contact.equilibrium() >= contact.tip_radius())
    error->all(FLERR,
               "Pair rbc/jkr: adhered surfaces of types {} {} would overlap by {:.6g}; sigma/K "
               "must be < {:.6g}",
               i, j, contact.equilibrium() - contact.tip_radius(),
               std::sqrt(3.0) / MathConst::MY_2PI * contact.tip_radius());
  if (range_of(i, j) > range) {
    range = range_of(i, j);
    neighbor_calls = -1;    // fix adapt may have raised it
  }
  return cutoff + surfaces->longest_edge() + slack() - neighbor->skin;
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::setup()
{
  if (comm->me != 0) return;
  if (own_cells)
    utils::logmesg(lmp,
                   "Pair rbc/jkr: cells touch themselves, too, further than {:.6g} along their "
                   "surface\n",
                   OWN_PATCH * cutoff);
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      if (!setflag[i][j] || !tip(i, j).touches()) continue;
      const TipContact &contact = tip(i, j);
      const double gap = contact.tip_radius() - contact.equilibrium();
      utils::logmesg(lmp,
                     "Pair rbc/jkr, types {} {}: gap {:.6g} at rest, range {:.6g}, work per area "
                     "{:.6g}, stress of adhesion up to {:.6g}, of repulsion {:.6g} where surfaces "
                     "meet\n",
                     i, j, gap, range_of(i, j), work[i][j], contact.pull_off() / contact.tip_area(),
                     contact.per_area(contact.tip_radius()).traction);
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
  finding.start();
  if (neighbors_changed()) surfaces->build(range, slack());
  const auto &contacts = surfaces->contacts(range);
  finding.stop();

  interacting.start();
  add_forces(contacts);
  interacting.stop();
}

/* ----------------------------------------------------------------------
   a vertex stands for its share of area; its force returns to the corners of the triangle it meets. A pair of surfaces
   counts from both sides, so each side has half of the energy. Through its inside a cell repels itself only.
------------------------------------------------------------------------- */

void PairRBCJKR::add_forces(const std::vector<rbc::NearTriangles::Contact> &contacts)
{
  const bool returned = force->newton;
  if (!returned) reactions.assign(3 * std::size_t(atom->nlocal + atom->nghost), 0.0);
  adhered_area = 0;
  for (const auto &contact : contacts) {
    const int i = contact.point;
    const TipContact &surface = tip(atom->type[i], atom->type[contact.corner[0]]);
    const bool through_inside =
        contact.gap < 0 && atom->molecule[i] == atom->molecule[contact.corner[0]];
    const double gap = through_inside ? -contact.gap : contact.gap;
    const double overlap = surface.tip_radius() - gap;
    const double detachment = through_inside ? surface.equilibrium() : surface.separation();
    if (!surface.touches() || overlap <= detachment) continue;

    auto [traction, energy] = surface.per_area(overlap);
    if (through_inside) energy += work[atom->type[i]][atom->type[i]];
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
  std::copy_n(&reactions[3 * std::size_t(first)], 3 * std::size_t(n), buf);
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
  const TipContact &contact = tip(itype, jtype);
  const double overlap = contact.tip_radius() - r;
  fforce = 0;
  if (!contact.touches() || overlap <= contact.separation()) return 0;
  fforce = contact.force(overlap) / r;
  return contact.energy(overlap);
}

/* ---------------------------------------------------------------------- */

void *PairRBCJKR::extract(const char *name, int &dim)
{
  dim = 2;
  if (strcmp(name, "K") == 0) return modulus;
  if (strcmp(name, "sigma") == 0) return work;
  if (strcmp(name, "R") == 0) return radius;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

void PairRBCJKR::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      const double numbers[5] = {double(setflag[i][j]), double(kind[i][j]), modulus[i][j],
                                 work[i][j], radius[i][j]};
      fwrite(numbers, sizeof(double), 5, fp);
    }
}

void PairRBCJKR::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      double numbers[5];
      if (comm->me == 0) utils::sfread(FLERR, numbers, sizeof(double), 5, fp, nullptr, error);
      MPI_Bcast(numbers, 5, MPI_DOUBLE, 0, world);
      setflag[i][j] = static_cast<int>(numbers[0]);
      kind[i][j] = static_cast<int>(numbers[1]);
      modulus[i][j] = numbers[2];
      work[i][j] = numbers[3];
      radius[i][j] = numbers[4];
    }
}

/* ----------------------------------------------------------------------
   the sign tells whether cells touch themselves, so that files from before that can be read
------------------------------------------------------------------------- */

void PairRBCJKR::write_restart_settings(FILE *fp)
{
  const double number = own_cells ? -cutoff : cutoff;
  fwrite(&number, sizeof(double), 1, fp);
}

void PairRBCJKR::read_restart_settings(FILE *fp)
{
  double number;
  if (comm->me == 0) utils::sfread(FLERR, &number, sizeof(double), 1, fp, nullptr, error);
  MPI_Bcast(&number, 1, MPI_DOUBLE, 0, world);
  cutoff = std::abs(number);
  own_cells = number < 0;
}

/* ---------------------------------------------------------------------- */

double PairRBCJKR::memory_usage()
{
  return Pair::memory_usage() + surfaces->bytes() + reactions.capacity() * sizeof(double);
}
