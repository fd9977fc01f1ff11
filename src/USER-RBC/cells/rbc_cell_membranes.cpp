#include "cells/rbc_cell_membranes.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "geometry/surface_thickness.h"
#include "membrane/membrane_viscosity.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using rbc::Vec3;

// relaxation time of a drift of the volume, in steps (Baumgarte stabilisation)

static constexpr double VOLUME_STEPS = 10.0;

/* ---------------------------------------------------------------------- */

CellMembranes::CellMembranes(LAMMPS *lmp, std::string style, int groupbit,
                             MembraneSettings settings) :
    Pointers(lmp),
    style_(std::move(style)), groupbit_(groupbit), settings_(std::move(settings)),
    model_(*settings_.surface, settings_.elastic), gradient_of_(*settings_.surface),
    cells_(lmp, *settings_.surface, groupbit, style_),
    own_stop_(std::make_shared<CollectiveStop>(lmp)), stop_(own_stop_)
{
  model_.set_rest_volume(settings_.swelling.now() * shape().volume);
  x_.resize(shape().vertex_count());
  f_.resize(shape().vertex_count());
  if (is_viscous()) v_.resize(shape().vertex_count());
}

/* ---------------------------------------------------------------------- */

std::vector<CellMembranes *> LAMMPS_NS::all_cell_membranes(LAMMPS *lmp)
{
  std::vector<CellMembranes *> found;
  for (Fix *fix : lmp->modify->get_fix_list())
    if (auto *const owner = dynamic_cast<MembraneOwner *>(fix))
      found.push_back(&owner->membranes());
  return found;
}

/* ---------------------------------------------------------------------- */

void CellMembranes::limit(const rbc::CreaseResistance &crease, const rbc::StretchLimit &stretch)
{
  settings_.elastic.crease = crease;
  settings_.elastic.stretch = stretch;
  model_.limit(crease, stretch);
}

/* ---------------------------------------------------------------------- */

double CellMembranes::shear_modulus() const
{
  const auto by_i1 = [](const auto &law) { return law(2, 1).by_i1; };
  return 2 * std::visit(by_i1, settings_.elastic.law);
}

double CellMembranes::thickness()
{
  if (thickness_ < 0) thickness_ = rbc::surface_thickness(shape());
  return thickness_;
}

/* ---------------------------------------------------------------------- */

void CellMembranes::start_run()
{
  settings_.swelling.check(lmp, "fix rbc/membrane swell");
  stop_ = own_stop_;
  largest_growth_ = {};
  cells_.identify();
}

void CellMembranes::update_ownership()
{
  cells_.update_ownership(bends());
  const std::size_t count = cells_.cells().size();
  sizes_.resize(2 * count);
  volume_rates_.resize(count);
  const auto shared = std::count_if(cells_.cells().begin(), cells_.cells().end(),
                                    [](const LocalCells::Cell &cell) { return cell.shared; });
  if (keeps_volume()) {
    gradient_.resize(shape().vertex_count());
    shared_gradient_.resize(shared * shape().vertex_count());
  }
  linear_at_.resize(is_thinning() ? count * shape().vertex_count() : 0);
}

/* ----------------------------------------------------------------------
   forces on a vertex reach its neighbors' neighbors with bending; edges may be stretched by half
------------------------------------------------------------------------- */

double CellMembranes::ghost_reach() const
{
  return (bends() ? 3 : 2) * shape().longest_edge;
}

/* ---------------------------------------------------------------------- */

void CellMembranes::update_swelling(bool new_run)
{
  Swelling &swelling = settings_.swelling;
  if (!swelling.varies()) return;
  swelling.update(lmp, new_run);
  if (!std::isfinite(swelling.now()) || swelling.now() <= 0)
    error->all(FLERR, "{}: swell is {} at step {}; it must be > 0", style_, swelling.now(),
               update->ntimestep);
  model_.set_rest_volume(swelling.now() * shape().volume);
}

/* ---------------------------------------------------------------------- */

void CellMembranes::add_forces()
{
  stopwatch_.start();
  update_swelling(false);
  const bool measuring = model_.needs_size() || neighbor->ago == 0;
  if (measuring) measure_shared_cells();
  energy_ = {};
  nearly_folded_ = false;
  const auto &local = cells_.cells();
  for (std::size_t c = 0; c < local.size(); ++c) {
    set_current_cell(local[c]);
    if (measuring && !local[c].shared) store_size(c);
    check_mesh(local[c]);
    if (measuring) check_volume(local[c], sizes_[2 * c + 1]);
    // Where sizes are not measured, those of an earlier step stand here and the model uses none.
    add_elastic_forces(local[c], {sizes_[2 * c], sizes_[2 * c + 1]});
  }
  stopwatch_.stop();
  if (is_viscous()) add_viscous_forces(true);
  if (stop_ == own_stop_) stop_->check();
}

/* ---------------------------------------------------------------------- */

void CellMembranes::set_current_cell(const LocalCells::Cell &cell)
{
  cells_.gather(cell, x_);
  model_.set_cell(*cell.elements, x_);
}

/* ----------------------------------------------------------------------
   area and volume of the current cell, cell c here, or this rank's share of them
------------------------------------------------------------------------- */

void CellMembranes::store_size(std::size_t c)
{
  const rbc::AreaVolume share = model_.area_and_volume();
  sizes_[2 * c] = share.area;
  sizes_[2 * c + 1] = share.volume;
}

void CellMembranes::measure_shared_cells()
{
  const auto &local = cells_.cells();
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (!local[c].shared) continue;
    set_current_cell(local[c]);
    store_size(c);
  }
  cells_.sum_shared(sizes_, 2);
}

/* ---------------------------------------------------------------------- */

void CellMembranes::check_mesh(const LocalCells::Cell &cell)
{
  const std::string flaw = model_.find_flaw();
  if (!flaw.empty()) report(cell, flaw, Flaw::folded);
  nearly_folded_ = nearly_folded_ || model_.is_nearly_folded();
}

void CellMembranes::check_volume(const LocalCells::Cell &cell, double volume)
{
  if (volume <= 0) report(cell, "the cell turned inside out", Flaw::folded);
}

/* ---------------------------------------------------------------------- */

void CellMembranes::add_elastic_forces(const LocalCells::Cell &cell, const rbc::AreaVolume &size)
{
  const rbc::MembraneEnergy share = model_.forces(size, f_);
  if (!std::isfinite(share.total()))
    report(cell, "the energy of the membrane is not a number", Flaw::not_finite);
  energy_.sheet += share.sheet;
  energy_.bending += share.bending;
  energy_.area += share.area;
  energy_.volume += share.volume;
  add_to_atoms(cell, true);
}

void CellMembranes::add_to_atoms(const LocalCells::Cell &cell, bool with_virial)
{
  double **const force = atom->f;
  const int size = shape().vertex_count();
  for (int i = 0; i < size; ++i) {
    if (!cell.elements->owned[i]) continue;
    double *const at = force[cell.atom[i]];
    for (int d = 0; d < 3; ++d) at[d] += f_[i][d];
  }
  if (!with_virial || !tally_) return;
  for (int i = 0; i < size; ++i) {
    if (!cell.elements->owned[i]) continue;
    const Vec3 &x = x_[i], &f = f_[i];
    double virial[6] = {x[0] * f[0], x[1] * f[1], x[2] * f[2],
                        x[0] * f[1], x[0] * f[2], x[1] * f[2]};
    tally_(cell.atom[i], virial);
  }
}

/* ---------------------------------------------------------------------- */

rbc::MembraneEnergy CellMembranes::energy() const
{
  double parts[4] = {energy_.sheet, energy_.bending, energy_.area, energy_.volume};
  MPI_Allreduce(MPI_IN_PLACE, parts, 4, MPI_DOUBLE, MPI_SUM, world);
  rbc::MembraneEnergy all;
  all.sheet = parts[0];
  all.bending = parts[1];
  all.area = parts[2];
  all.volume = parts[3];
  return all;
}

/* ---------------------------------------------------------------------- */

void CellMembranes::add_viscous_forces(bool with_virial, double multiple)
{
  stopwatch_.start();
  share_velocities();
  for (const LocalCells::Cell &cell : cells_.cells()) {
    viscous_forces(cell);
    if (multiple != 1)
      for (Vec3 &force : f_) force *= multiple;
    add_to_atoms(cell, with_virial);
  }
  stopwatch_.stop();
}

/* ---------------------------------------------------------------------- */

void CellMembranes::linearise(bool frozen)
{
  if (!is_thinning()) return;
  viscosity_frozen_ = frozen;
  share_velocities();
  Vec3 *at = linear_at_.data();
  for (const LocalCells::Cell &cell : cells_.cells()) {
    gather_velocities(cell);
    at = std::copy(v_.begin(), v_.end(), at);
  }
}

void CellMembranes::add_viscous_change()
{
  if (!is_thinning()) return add_viscous_forces(false);
  stopwatch_.start();
  share_velocities();
  const Vec3 *at = linear_at_.data();
  for (const LocalCells::Cell &cell : cells_.cells()) {
    cells_.gather(cell, x_);
    gather_velocities(cell);
    rbc::viscous_forces_change(shape(), settings_.viscosity, *cell.elements, x_, at,
                               viscosity_frozen_, v_, f_);
    add_to_atoms(cell, false);
    at += shape().vertex_count();
  }
  stopwatch_.stop();
}

/* ---------------------------------------------------------------------- */

void CellMembranes::share_velocities()
{
  if (comm->nprocs > 1) comm->forward_comm_array(3, atom->v);
}

void CellMembranes::gather_velocities(const LocalCells::Cell &cell)
{
  for (int i = 0; i < shape().vertex_count(); ++i)
    if (cell.atom[i] >= 0) v_[i] = Vec3(atom->v[cell.atom[i]]);
}

/* ----------------------------------------------------------------------
   forces on the vertices of a cell; returns the power that its part here dissipates
------------------------------------------------------------------------- */

double CellMembranes::viscous_forces(const LocalCells::Cell &cell)
{
  cells_.gather(cell, x_);
  gather_velocities(cell);
  return rbc::viscous_forces(shape(), settings_.viscosity, *cell.elements, x_, v_, f_);
}

double CellMembranes::viscous_power()
{
  share_velocities();
  double power = 0;
  for (const LocalCells::Cell &cell : cells_.cells()) power += viscous_forces(cell);
  MPI_Allreduce(MPI_IN_PLACE, &power, 1, MPI_DOUBLE, MPI_SUM, world);
  return power;
}

/* ---------------------------------------------------------------------- */

void CellMembranes::constrain_volume(double dt, bool new_step, bool mid_step)
{
  stopwatch_.start();
  update_swelling(false);
  const Swelling &swelling = settings_.swelling;
  const double rest = (mid_step ? swelling.middle() : swelling.now()) * shape().volume;
  const auto rate = [](double change, double time) { return time > 0 ? change / time : 0; };
  const double rest_rate = rate(swelling.change() * shape().volume, dt);

  add_volume_gradients([&](std::size_t c, const VolumeSums &sums) {
    if (!(sums.volume > 0)) report(cells_.cells()[c], "the cell turned inside out", Flaw::folded);
    if (new_step) volume_rates_[c] = rate(rest - sums.volume, VOLUME_STEPS * dt);
    return (volume_rates_[c] + rest_rate - sums.rate) / sums.square;
  });
  stopwatch_.stop();
}

void CellMembranes::remove_volume_change()
{
  stopwatch_.start();
  add_volume_gradients(
      [](std::size_t /*c*/, const VolumeSums &sums) { return -sums.rate / sums.square; });
  stopwatch_.stop();
}

/* ----------------------------------------------------------------------
   Adds factor(c, sums) times the volume's gradient to the velocities of each cell c here. Gradients
   are kept for those cells alone whose sums come from several ranks.
------------------------------------------------------------------------- */

template <typename Factor> void CellMembranes::add_volume_gradients(const Factor &factor)
{
  const int size = shape().vertex_count();
  const auto &local = cells_.cells();
  sums_.assign(VolumeSums::COUNT * local.size(), 0.0);
  Vec3 *kept = shared_gradient_.data();
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (!local[c].shared) continue;
    const VolumeSums share = find_volume_gradient(local[c], kept);
    share.store(&sums_[VolumeSums::COUNT * c]);
    kept += size;
  }
  cells_.sum_shared(sums_, VolumeSums::COUNT);

  kept = shared_gradient_.data();
  for (std::size_t c = 0; c < local.size(); ++c) {
    if (local[c].shared) {
      const VolumeSums sums(&sums_[VolumeSums::COUNT * c]);
      add_volume_gradient(local[c], factor(c, sums), kept);
      kept += size;
    } else {
      const VolumeSums sums = find_volume_gradient(local[c], gradient_.data());
      add_volume_gradient(local[c], factor(c, sums), gradient_.data());
    }
  }
}

/* ----------------------------------------------------------------------
   Finds the gradient at the vertices of this rank, and returns their share of the sums.
------------------------------------------------------------------------- */

CellMembranes::VolumeSums CellMembranes::find_volume_gradient(const LocalCells::Cell &cell,
                                                              Vec3 *gradient)
{
  double **const v = atom->v;
  cells_.gather(cell, x_);
  VolumeSums sums;
  sums.volume = gradient_of_.find(*cell.elements, x_.data(), gradient);
  for (int i = 0; i < shape().vertex_count(); ++i) {
    if (!cell.elements->owned[i]) continue;
    sums.rate += gradient[i].dot(Vec3(v[cell.atom[i]]));
    sums.square += gradient[i].squaredNorm();
  }
  return sums;
}

void CellMembranes::add_volume_gradient(const LocalCells::Cell &cell, double factor,
                                        const Vec3 *gradient)
{
  for (int i = 0; i < shape().vertex_count(); ++i) {
    if (!cell.elements->owned[i]) continue;
    double *const velocity = atom->v[cell.atom[i]];
    for (int d = 0; d < 3; ++d) velocity[d] += factor * gradient[i][d];
  }
}

/* ---------------------------------------------------------------------- */

void CellMembranes::report(const LocalCells::Cell &cell, const std::string &what, Flaw flaw)
{
  Vec3 centre = cell.origin;
  domain->remap(centre.data());
  stop_->report(
      fmt::format("{}: {} at step {}: cell with molecule ID {} near ({:.6g}, {:.6g}, {:.6g})",
                  style_, what, update->ntimestep, cell.molecule, centre[0], centre[1], centre[2]),
      flaw);
}

/* ---------------------------------------------------------------------- */

double CellMembranes::bytes() const
{
  const double vertices = static_cast<double>(cells_.cells().size()) * shape().vertex_count();
  return vertices * sizeof(int) + (shared_gradient_.size() + linear_at_.size()) * sizeof(Vec3) +
         cells_.bytes();
}
