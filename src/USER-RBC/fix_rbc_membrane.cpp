#include "fix_rbc_membrane.h"

#include "atom.h"
#include "cells/rbc_cell_template.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "math_const.h"
#include "membrane/membrane_viscosity.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using rbc::Vec3;

// steps over which the volume returns to that of the template

static constexpr double VOLUME_STEPS = 10.0;

/* ---------------------------------------------------------------------- */

FixRBCMembrane::FixRBCMembrane(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  scalar_flag = vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extscalar = extvector = 1;
  energy_global_flag = 1;
  virial_global_flag = 1;

  if (narg < 5) utils::missing_cmd_args(FLERR, "fix rbc/membrane", error);
  surface = make_cell_template(lmp, arg[3], "fix rbc/membrane");
  model = std::make_unique<rbc::MembraneModel>(*surface, parse(narg, arg));
  model->set_rest_volume(swelling.now() * surface->volume);
  restart_global = swelling.varies() ? 1 : 0;
  cells =
      std::make_unique<LocalCells>(lmp, *surface, groupbit, fmt::format("Fix rbc/membrane {}", id));
  own_stop = std::make_shared<CollectiveStop>(lmp);
  x.resize(surface->size());
  f.resize(surface->size());
  if (is_viscous()) {
    v.resize(surface->size());
    comm_forward = 3;
  }
}

FixRBCMembrane::~FixRBCMembrane()
{
  if (comm->cutghostuser == ghost_cutoff) comm->cutghostuser = 0;
}

/* ---------------------------------------------------------------------- */

rbc::MembraneParameters FixRBCMembrane::parse(int narg, char **arg)
{
  rbc::MembraneParameters parameters;
  int iarg = 4;
  const auto need = [&](int n, const std::string &keyword) {
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "fix rbc/membrane " + keyword, error);
  };
  const auto not_negative = [&](int at, const std::string &name) {
    const double value = utils::numeric(FLERR, arg[at], false, lmp);
    if (!(value >= 0))
      error->all(FLERR, at, "Fix rbc/membrane {} value {} must be >= 0", name, arg[at]);
    return value;
  };
  const auto positive = [&](int at, const std::string &name) {
    const double value = not_negative(at, name);
    if (value == 0)
      error->all(FLERR, at, "Fix rbc/membrane {} value {} must be > 0", name, arg[at]);
    return value;
  };

  const std::string law = arg[iarg];
  const std::size_t index = rbc::law_index<rbc::SheetLaw>(law);
  if (index == std::variant_size_v<rbc::SheetLaw>)
    error->all(FLERR, iarg, "Unknown fix rbc/membrane law {}; allowed: {}", law,
               rbc::law_names<rbc::SheetLaw>());
  const auto law_parameters = rbc::law_parameters<rbc::SheetLaw>(index);
  need(static_cast<int>(law_parameters.size()), law);
  std::vector<double> values;
  for (const rbc::LawParameter &parameter : law_parameters) {
    const std::string name = law + ' ' + parameter.name;
    ++iarg;
    values.push_back(parameter.bound == rbc::Bound::positive ? positive(iarg, name)
                                                             : not_negative(iarg, name));
  }
  ++iarg;
  parameters.law = rbc::make_law<rbc::SheetLaw>(index, values);

  while (iarg < narg) {
    const std::string keyword = arg[iarg];
    if (keyword == "bending") {
      need(1, keyword);
      parameters.bending = not_negative(iarg + 1, keyword);
      iarg += 2;
      bool curved = false, formed = false;
      for (; iarg < narg; ++iarg) {
        const std::string value = arg[iarg];
        const bool is_form = value == "helfrich" || value == "dihedral";
        if (!is_form && value != "reference" && !utils::is_double(value)) break;
        if (is_form ? formed : curved)
          error->all(
              FLERR, iarg,
              "Fix rbc/membrane bending value {} is one too many: allowed are one of reference "
              "or c0, and one of helfrich or dihedral",
              value);
        (is_form ? formed : curved) = true;
        if (is_form)
          parameters.bending_form =
              value == "dihedral" ? rbc::BendingForm::dihedral : rbc::BendingForm::helfrich;
        else if (value != "reference") {
          parameters.reference_curvature = false;
          parameters.spontaneous_curvature = utils::numeric(FLERR, arg[iarg], false, lmp);
        }
      }
    } else if (keyword == "crease") {
      need(2, keyword);
      parameters.crease.stiffness = not_negative(iarg + 1, "crease k");
      const double angle = positive(iarg + 2, "crease angle");
      if (angle >= 180)
        error->all(FLERR, iarg + 2,
                   "Fix rbc/membrane crease angle value {} must be below 180 degrees",
                   arg[iarg + 2]);
      parameters.crease.cosine = cos(angle * MathConst::DEG2RAD);
      iarg += 3;
    } else if (keyword == "stretch") {
      need(2, keyword);
      parameters.stretch.stiffness = not_negative(iarg + 1, "stretch k");
      const double stretch = positive(iarg + 2, "stretch lambda");
      if (stretch <= 1)
        error->all(FLERR, iarg + 2, "Fix rbc/membrane stretch lambda value {} must be above 1",
                   arg[iarg + 2]);
      parameters.stretch.i1 = stretch * stretch + 1 / (stretch * stretch);
      iarg += 3;
    } else if (keyword == "area") {
      need(2, keyword);
      parameters.global_area = not_negative(iarg + 1, "area kglobal");
      parameters.local_area = not_negative(iarg + 2, "area klocal");
      iarg += 3;
    } else if (keyword == "volume") {
      need(1, keyword);
      const std::string value = arg[iarg + 1];
      volume_kept = value == "yes";
      parameters.volume = 0;
      if (value != "yes" && value != "no") {
        if (!utils::is_double(value))
          error->all(FLERR, iarg + 1,
                     "Fix rbc/membrane volume value {} must be yes, no or a modulus", value);
        parameters.volume = not_negative(iarg + 1, keyword);
      }
      iarg += 2;
    } else if (keyword == "viscosity") {
      need(1, keyword);
      const double at_rest = not_negative(iarg + 1, keyword);
      viscosity = at_rest;
      iarg += 2;
      if (iarg < narg && strcmp(arg[iarg], "thinning") == 0) {
        need(2, "viscosity thinning");
        const double fast = not_negative(iarg + 1, "viscosity thinning eta_inf");
        if (fast > at_rest)
          error->all(FLERR, iarg + 1,
                     "Fix rbc/membrane viscosity thinning eta_inf value {} must be <= eta_m, {}",
                     arg[iarg + 1], arg[iarg - 1]);
        viscosity = {at_rest, fast, positive(iarg + 2, "viscosity thinning rate")};
        iarg += 3;
      }
    } else if (keyword == "swell") {
      need(1, keyword);
      swelling = Swelling(lmp, arg[iarg + 1]);
      if (!swelling.varies()) positive(iarg + 1, keyword);
      iarg += 2;
    } else if (keyword == "stress-free") {
      need(1, keyword);
      take_stress_free_shape(lmp, *surface, arg[3], arg[iarg + 1], "fix rbc/membrane");
      iarg += 2;
    } else
      error->all(FLERR, iarg,
                 "Unknown fix rbc/membrane keyword {}; allowed: bending, area, volume, swell, "
                 "stress-free, viscosity, crease, stretch",
                 keyword);
  }
  if (parameters.crease.stiffness > 0 && parameters.bending == 0)
    error->all(FLERR, "Fix rbc/membrane crease needs a bending modulus > 0");
  if ((swelling.varies() || swelling.now() != 1) && !volume_kept && parameters.volume == 0)
    error->all(FLERR, "Fix rbc/membrane swell needs volume yes or a modulus of the volume");
  return parameters;
}

/* ---------------------------------------------------------------------- */

int FixRBCMembrane::setmask()
{
  return POST_NEIGHBOR | POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::init()
{
  if (domain->triclinic)
    error->all(FLERR, "Fix rbc/membrane requires an orthogonal simulation box");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix rbc/membrane cannot be used with run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix rbc/membrane cannot be used with minimize");
  swelling.check(lmp, "fix rbc/membrane swell");
  stop = own_stop;
  cells->find();
  for (Fix *other : modify->get_fix_by_style("^rbc/membrane$")) {
    if (other == this) break;
    int shared = 0;
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit)) shared = 1;
    MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
    if (shared)
      error->all(FLERR, "Fix rbc/membrane {} and {} share atoms: a cell belongs to one of them",
                 other->id, id);
  }

  // what comm_modify cutoff asks for is left alone

  if (comm->cutghostuser != 0 && comm->cutghostuser != ghost_cutoff) return;
  double reach = 0;
  for (Fix *fix : modify->get_fix_by_style("^rbc/membrane$"))
    reach = std::max(reach, dynamic_cast<FixRBCMembrane *>(fix)->reach());
  if (force->pair) reach = std::max(reach, force->pair->cutforce);    // or LAMMPS warns
  comm->cutghostuser = ghost_cutoff = reach + neighbor->skin;
}

/* ----------------------------------------------------------------------
   vertices of other ranks are needed up to two edges away with bending, stretched by half
------------------------------------------------------------------------- */

double FixRBCMembrane::reach() const
{
  return (model->parameters().bending > 0 ? 3 : 2) * surface->longest_edge;
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::setup_post_neighbor()
{
  post_neighbor();
}

void FixRBCMembrane::post_neighbor()
{
  cells->bind(model->parameters().bending > 0);
  const std::size_t count = cells->cells().size();
  sizes.resize(2 * count);
  volume_rates.resize(count);
  volume_gradient.resize(volume_kept ? count * surface->size() : 0);
  linear_at.resize(is_thinning() ? count * surface->size() : 0);
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::setup(int vflag)
{
  update_swelling(true);
  post_force(vflag);
}

void FixRBCMembrane::post_force(int vflag)
{
  stopwatch.start();
  v_init(vflag);
  update_swelling(false);
  const bool measuring = model->needs_size() || neighbor->ago == 0;
  if (measuring) measure_shared_cells();
  energy = {};
  energy_step = -1;
  const auto &local = cells->cells();
  for (std::size_t c = 0; c < local.size(); ++c) {
    take(local[c]);
    if (measuring && local[c].shared < 0) store_size(c);
    check(local[c], measuring ? sizes[2 * c + 1] : surface->volume);
    add_forces(local[c], {sizes[2 * c], sizes[2 * c + 1]});
  }
  stopwatch.stop();
  if (is_viscous()) add_viscous_forces(true);
  if (stop == own_stop) stop->check();
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::update_swelling(bool new_run)
{
  if (!swelling.varies()) return;
  swelling.update(lmp, new_run);
  if (!std::isfinite(swelling.now()) || swelling.now() <= 0)
    error->all(FLERR, "Fix rbc/membrane {}: swell is {} at step {}; it must be > 0", id,
               swelling.now(), update->ntimestep);
  model->set_rest_volume(swelling.now() * surface->volume);
}

/* ----------------------------------------------------------------------
   takes a cell in hand as it is now
------------------------------------------------------------------------- */

void FixRBCMembrane::take(const LocalCells::Cell &cell)
{
  cells->gather(cell, x);
  model->set_cell(*cell.elements, x);
}

/* ----------------------------------------------------------------------
   area and volume of the cell in hand, cell c here, or this rank's share of them
------------------------------------------------------------------------- */

void FixRBCMembrane::store_size(std::size_t c)
{
  const rbc::CellSize share = model->size();
  sizes[2 * c] = share.area;
  sizes[2 * c + 1] = share.volume;
}

/* ----------------------------------------------------------------------
   area and volume of the cells that several ranks share
------------------------------------------------------------------------- */

void FixRBCMembrane::measure_shared_cells()
{
  const auto &local = cells->cells();
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (local[c].shared < 0) continue;
    take(local[c]);
    store_size(c);
  }
  cells->sum_shared(sizes, 2);
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::check(const LocalCells::Cell &cell, double volume)
{
  const std::string flaw = model->find_flaw();
  if (!flaw.empty()) report(cell, flaw);
  if (volume <= 0) report(cell, "the cell turned inside out");
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::add_forces(const LocalCells::Cell &cell, const rbc::CellSize &size)
{
  const rbc::MembraneEnergy share = model->forces(size, f);
  if (!std::isfinite(share.total())) report(cell, "the energy of the membrane is not a number");
  energy.sheet += share.sheet;
  energy.bending += share.bending;
  energy.area += share.area;
  energy.volume += share.volume;
  add_to_atoms(cell, true);
}

void FixRBCMembrane::add_to_atoms(const LocalCells::Cell &cell, bool with_virial)
{
  double **const force = atom->f;
  const int size = surface->size();
  for (int i = 0; i < size; ++i) {
    if (!cell.elements->owned[i]) continue;
    double *const at = force[cell.atom[i]];
    for (int d = 0; d < 3; ++d) at[d] += f[i][d];
  }
  if (!with_virial || !evflag) return;
  for (int i = 0; i < size; ++i) {
    if (!cell.elements->owned[i]) continue;
    double virial_of_vertex[6] = {x[i][0] * f[i][0], x[i][1] * f[i][1], x[i][2] * f[i][2],
                                  x[i][0] * f[i][1], x[i][0] * f[i][2], x[i][1] * f[i][2]};
    v_tally(cell.atom[i], virial_of_vertex);
  }
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::add_viscous_forces(bool with_virial, double multiple)
{
  stopwatch.start();
  if (comm->nprocs > 1) comm->forward_comm(this);
  for (const LocalCells::Cell &cell : cells->cells()) {
    viscous_forces(cell);
    if (multiple != 1)
      for (Vec3 &force : f) force *= multiple;
    add_to_atoms(cell, with_virial);
  }
  stopwatch.stop();
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::linearise(bool frozen)
{
  if (!is_thinning()) return;
  viscosity_frozen = frozen;
  if (comm->nprocs > 1) comm->forward_comm(this);
  Vec3 *at = linear_at.data();
  for (const LocalCells::Cell &cell : cells->cells()) {
    gather_velocities(cell);
    at = std::copy(v.begin(), v.end(), at);
  }
}

void FixRBCMembrane::add_viscous_change()
{
  if (!is_thinning()) return add_viscous_forces(false);
  stopwatch.start();
  if (comm->nprocs > 1) comm->forward_comm(this);
  const Vec3 *at = linear_at.data();
  for (const LocalCells::Cell &cell : cells->cells()) {
    cells->gather(cell, x);
    gather_velocities(cell);
    rbc::viscous_forces_change(*surface, viscosity, *cell.elements, x, at, viscosity_frozen, v, f);
    add_to_atoms(cell, false);
    at += surface->size();
  }
  stopwatch.stop();
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::gather_velocities(const LocalCells::Cell &cell)
{
  for (int i = 0; i < surface->size(); ++i)
    if (cell.atom[i] >= 0) v[i] = Vec3(atom->v[cell.atom[i]]);
}

/* ----------------------------------------------------------------------
   forces on the vertices of a cell; returns the power that its part here dissipates
------------------------------------------------------------------------- */

double FixRBCMembrane::viscous_forces(const LocalCells::Cell &cell)
{
  cells->gather(cell, x);
  gather_velocities(cell);
  return rbc::viscous_forces(*surface, viscosity, *cell.elements, x, v, f);
}

double FixRBCMembrane::viscous_power()
{
  if (comm->nprocs > 1) comm->forward_comm(this);
  double power = 0;
  for (const LocalCells::Cell &cell : cells->cells()) power += viscous_forces(cell);
  MPI_Allreduce(MPI_IN_PLACE, &power, 1, MPI_DOUBLE, MPI_SUM, world);
  return power;
}

int FixRBCMembrane::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/,
                                      int * /*pbc*/)
{
  int m = 0;
  for (int i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) buf[m++] = atom->v[list[i]][d];
  return m;
}

void FixRBCMembrane::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; ++i)
    for (int d = 0; d < 3; ++d) atom->v[i][d] = buf[m++];
}

/* ----------------------------------------------------------------------
   subtracts from the velocities the part along the volume gradient, so that
     sum_i dV/dx_i . v_i = (V_rest - V) / (VOLUME_STEPS dt) + dV_rest/dt
   the gradients of a closed surface sum to zero and exert no torque: neither the cell's velocity nor its rotation
   changes. The evaluation at the start of a step (new_step) sets the first rate, which the stages after it keep. Where the
   positions are those in the middle of a step (mid_step), so is the rest volume; it changes as over that step, or, at
   its start, as over the last.
------------------------------------------------------------------------- */

void FixRBCMembrane::keep_volume(double dt, bool new_step, bool mid_step)
{
  stopwatch.start();
  update_swelling(false);
  const double rest = (mid_step ? swelling.middle() : swelling.now()) * surface->volume;
  const double rest_rate = swelling.change() * surface->volume / dt;
  double **const v = atom->v;
  const int size = surface->size();
  const auto &local = cells->cells();
  sums.assign(3 * local.size(), 0.0);    // flux, squared gradient, volume
  for (std::size_t c = 0; c < local.size(); ++c) {
    const LocalCells::Cell &cell = local[c];
    take(cell);
    Vec3 *const gradient = &volume_gradient[c * size];
    model->volume_gradient(gradient);
    for (int i = 0; i < size; ++i) {
      if (!cell.elements->owned[i]) continue;
      sums[3 * c] += gradient[i].dot(Vec3(v[cell.atom[i]]));
      sums[3 * c + 1] += gradient[i].squaredNorm();
    }
    sums[3 * c + 2] = model->size().volume;
  }
  cells->sum_shared(sums, 3);

  for (std::size_t c = 0; c < local.size(); ++c) {
    const LocalCells::Cell &cell = local[c];
    if (!(sums[3 * c + 2] > 0)) report(cell, "the cell turned inside out");
    if (new_step) volume_rates[c] = (rest - sums[3 * c + 2]) / (VOLUME_STEPS * dt);
    const double factor = (volume_rates[c] + rest_rate - sums[3 * c]) / sums[3 * c + 1];
    const Vec3 *const gradient = &volume_gradient[c * size];
    for (int i = 0; i < size; ++i) {
      if (!cell.elements->owned[i]) continue;
      double *const velocity = v[cell.atom[i]];
      for (int d = 0; d < 3; ++d) velocity[d] += factor * gradient[i][d];
    }
  }
  stopwatch.stop();
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::report(const LocalCells::Cell &cell, const std::string &what)
{
  Vec3 centre = cell.origin;
  domain->remap(centre.data());
  stop->report(fmt::format(
      "Fix rbc/membrane {}: {} at step {}: cell with molecule ID {} near ({:.6g}, {:.6g}, {:.6g})",
      id, what, update->ntimestep, cells->molecules()[cell.index], centre[0], centre[1],
      centre[2]));
}

/* ---------------------------------------------------------------------- */

const rbc::MembraneEnergy &FixRBCMembrane::total_energy()
{
  if (energy_step != update->ntimestep) {
    MPI_Allreduce(&energy, &energy_all, 4, MPI_DOUBLE, MPI_SUM, world);
    energy_step = update->ntimestep;
  }
  return energy_all;
}

double FixRBCMembrane::compute_scalar()
{
  return total_energy().total();
}

double FixRBCMembrane::compute_vector(int n)
{
  if (n == 4) return is_viscous() ? viscous_power() : 0;
  const rbc::MembraneEnergy &parts = total_energy();
  const double part[4] = {parts.sheet, parts.bending, parts.area, parts.volume};
  return part[n];
}

/* ---------------------------------------------------------------------- */

void FixRBCMembrane::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const int size = sizeof(Swelling::State);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(&swelling.state, size, 1, fp);
}

void FixRBCMembrane::restart(char *buffer)
{
  if (swelling.varies()) memcpy(&swelling.state, buffer, sizeof(Swelling::State));
}

/* ---------------------------------------------------------------------- */

double FixRBCMembrane::memory_usage()
{
  const double vertices = static_cast<double>(cells->cells().size()) * surface->size();
  return vertices * (sizeof(int) + sizeof(Vec3)) +
         (volume_gradient.size() + linear_at.size()) * sizeof(Vec3);
}
