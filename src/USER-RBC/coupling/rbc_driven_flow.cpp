#include "coupling/rbc_driven_flow.h"

#include "comm.h"
#include "coupling/rbc_ghost_layers.h"
#include "coupling/rbc_unfinished_flow.h"
#include "domain.h"
#include "error.h"
#include "fluid/advection.h"
#include "force.h"
#include "grid3d.h"
#include "support/rbc_out_of_memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

// explicit advection: the fluid may not cross more cells than this in a step

static constexpr double MAX_COURANT = 1.0;

/* ---------------------------------------------------------------------- */

DrivenFlow::DrivenFlow(LAMMPS *lmp, std::string style, const FluidSettings &settings,
                       FlowForcing forcing) :
    Pointers(lmp),
    style_(std::move(style)), settings_(settings), forcing_(std::move(forcing)),
    inside_(lmp, "f" + style_.substr(1), settings.inside), stop_(lmp), scene_(lmp, style_)
{
  build();
}

DrivenFlow::~DrivenFlow() = default;

double DrivenFlow::smallest_spacing() const
{
  const auto &h = flow_->grid().spacing;
  return std::min({h[0], h[1], h[2]});
}

double DrivenFlow::mean_spacing() const
{
  const auto &h = flow_->grid().spacing;
  return std::cbrt(h[0] * h[1] * h[2]);
}

double DrivenFlow::box_volume() const
{
  const fluid::Grid &grid = flow_->grid();
  return grid.cell_volume() * static_cast<double>(grid.size());
}

/* ----------------------------------------------------------------------
   none are needed without vertices
------------------------------------------------------------------------- */

int DrivenFlow::layers_needed() const
{
  if (!driven_ && !walls_) return 0;
  return marker_layers(lmp, style_, settings_.cells, {cells_per_step_, sheets_, layers_});
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::build()
{
  inside_.forget();
  if (ports_) ports_->forget();
  const auto &cells = settings_.cells;
  grid_ = std::make_unique<Grid3d>(lmp, world, cells[0], cells[1], cells[2]);
  int lo[3], hi[3], outlo[3], outhi[3];
  grid_->setup_grid(lo[0], hi[0], lo[1], hi[1], lo[2], hi[2], outlo[0], outhi[0], outlo[1],
                    outhi[1], outlo[2], outhi[2]);

  fluid::Grid staggered;
  fluid::Box brick;
  for (int d = 0; d < 3; ++d) {
    brick.lo[d] = lo[d];
    brick.hi[d] = hi[d] + 1;
    staggered.cells[d] = cells[d];
    staggered.origin[d] = domain->boxlo[d];
    staggered.spacing[d] = domain->prd[d] / cells[d];
  }
  staggered.plates = settings_.plates;
  staggered.plate_conditions = settings_.plate_conditions;

  ghost_layers_ = layers_needed();
  const fluid::Decomposition bricks(world, brick);
  std::unique_ptr<fluid::Flow> flow;
  const std::string shortage = fmt::format(
      "{}: not enough memory for a grid of {} x {} x {} fluid cells with {} ghost layers", style_,
      cells[0], cells[1], cells[2], ghost_layers_);
  do_or_run_out_together(lmp, shortage, [&] {
    flow = std::make_unique<fluid::Flow>(staggered, bricks, ghost_layers_, settings_.equations,
                                         sheets_ || layers_);
  });
  if (flow_) {
    earlier_traffic_ = traffic();
    do_or_run_out(lmp, style_, [&] { flow->take_over(*flow_); });
  }
  flow_ = std::move(flow);
  if (ghost_layers_ == 0) excess_ = {};
  changed();
}

bool DrivenFlow::holds_box_mean() const
{
  return !settings_.plates && settings_.equations.hold_mean && !free_mean_;
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::set_forcing(const fluid::Forcing &forcing)
{
  forcing_now_ = solved_forcing_ = forcing;
}

void DrivenFlow::set_time_at_setup()
{
  ++version_;
  if (walls_) walls_->start_clock();
  if (has_inertia() && forcing_.is_known())
    set_forcing(forcing_.end());
  else
    set_time_now();
}

void DrivenFlow::set_time_now()
{
  fraction_ = 1;
  set_forcing(forcing_.evaluate());
  if (ports_) ports_->evaluate();
}

void DrivenFlow::begin_step(bool again)
{
  if (controls_flow_rate() && !again) forcing_.set_measured(rate_inside());
  if (ports_ && ports_->controls() && !again) ports_->set_measured(port_pressures());
  forcing_.begin_step(again);
  if (ports_) ports_->begin_step(again);
  if (walls_) walls_->begin_step(again);
}

void DrivenFlow::set_time(double fraction)
{
  place_walls(fraction);
  set_forcing(forcing_.at(fraction));
  if (ports_) ports_->set_time(fraction);
}

void DrivenFlow::place_walls(double fraction)
{
  fraction_ = fraction;
  if (walls_) walls_->place(fraction);
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::clear_force()
{
  spreading_.start();
  flow_->clear_force();
  marker_force_ = excess_ = {};
  spreading_.stop();
}

int DrivenFlow::spread(const fluid::MarkerSet &markers, const double *force, double factor)
{
  spreading_.start();
  const int outside = flow_->spread(markers, force, factor);
  spreading_.stop();
  if (walls_)
    for (int n = 0; n < markers.count; ++n)
      for (int d = 0; d < 3; ++d)
        marker_force_[d] += force[3 * std::ptrdiff_t(markers.index[n]) + d] * factor;
  return outside;
}

int DrivenFlow::spread(const fluid::MarkerSet &markers, const fluid::DoubleLayer &layer,
                       const std::array<double, 3> &excess)
{
  spreading_.start();
  const int outside = flow_->spread(markers, layer);
  spreading_.stop();
  excess_ = excess;
  return outside;
}

int DrivenFlow::find_excess(const fluid::MarkerSet &markers, const double *step, double mean,
                            const std::array<double, 2> &bounds)
{
  solving_.start();
  const int outside = flow_->find_excess(markers, step, mean, bounds);
  solving_.stop();
  return outside;
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::solve(CollectiveStop &stop, bool with_walls)
{
  const bool walls = walls_ && with_walls;
  fluid::Forcing uniform = forcing_now_;
  for (int d = 0; d < 3; ++d) uniform.mean[d] += excess_[d];
  if (walls) {
    if (stop.trying) stop.check();    // wrong forces must not get into what walls remember
    spread_walls(uniform, stop);
  }
  if (ports_) ports_->supply(*flow_, inside_);
  if (flow_->has_force()) {
    stop.check();
    exchanging_.start();
    flow_->accumulate_ghosts();
    exchanging_.stop();
  }

  solving_.start();
  if (has_inertia())
    flow_->start_step(update->dt, uniform);
  else
    flow_->solve(uniform);
  solving_.stop();

  if (walls) {
    walls_->enforce(*flow_);
    if (free_mean_) uniform.mean = walls_->mean();
  }
  solved_forcing_ = uniform;
  if (!has_inertia()) changed();
}

/* ----------------------------------------------------------------------
   the body force acts inside only: shear on the outer side would enlarge the walls' hydrodynamic
   offset
------------------------------------------------------------------------- */

void DrivenFlow::spread_walls(fluid::Forcing &uniform, CollectiveStop &stop)
{
  std::array<double, 3> others = marker_force_;
  const double volume = inside_.volume(*flow_);
  if (comm->me == 0)
    for (int d = 0; d < 3; ++d) others[d] += uniform.body[d] * volume;
  if (auto *const interior = inside_.find(*flow_)) {
    interior->add_force(*flow_, uniform.body);
    uniform.body = {0, 0, 0};
  }
  walls_->spread(*flow_, fraction_, others, stop);
  if (free_mean_) uniform.mean = walls_->mean();
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::interpolate(const fluid::MarkerSet &markers, double *velocity)
{
  exchanging_.start();
  flow_->fill_ghosts();
  exchanging_.stop();

  interpolating_.start();
  flow_->interpolate(markers, velocity);
  interpolating_.stop();
}

fluid::DirectForcing::Outcome
DrivenFlow::couple_masses(fluid::DirectForcing &direct,
                          const fluid::DirectForcing::Problem &problem)
{
  solving_.start();
  const auto outcome = direct.advance(*flow_, update->dt, forcing_now_, problem);
  solving_.stop();
  return outcome;
}

int DrivenFlow::apply_mobility(const fluid::MarkerSet &markers, const double *force,
                               double *velocity, const fluid::DoubleLayer *layer,
                               const std::array<double, 3> &excess, bool with_forces)
{
  solving_.start();
  const int outside = flow_->apply_mobility(markers, force, velocity, layer, excess, with_forces);
  solving_.stop();
  return outside;
}

int DrivenFlow::add_layer(const fluid::MarkerSet &markers, const fluid::DoubleLayer &layer,
                          const std::array<double, 3> &excess, double *velocity)
{
  const int outside = apply_mobility(markers, nullptr, velocity, &layer, excess, false);
  flow_->add_mobility_flow(1);
  for (int d = 0; d < 3; ++d) {
    excess_[d] += excess[d];
    solved_forcing_.mean[d] += excess[d];
  }
  changed();
  return outside;
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::finish_step()
{
  if (!has_inertia()) return;
  solving_.start();
  set_forcing(forcing_.end());
  flow_->finish_step(forcing_now_);
  solving_.stop();
  changed();
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::changed()
{
  ++version_;
  if (settings_.equations.inertia == fluid::Inertia::convective) check_courant();
}

void DrivenFlow::check_courant()
{
  const auto fastest = fluid::fastest_cell(flow_->grid(), flow_->brick(), flow_->velocity());
  const double courant = fastest.rate * update->dt;
  if (!(courant <= MAX_COURANT)) {
    double x[3];
    for (int d = 0; d < 3; ++d)
      x[d] = domain->boxlo[d] + (fastest.cell[d] + 0.5) * flow_->grid().spacing[d];
    const std::string place = fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
    if (std::isfinite(courant))
      stop_.report(fmt::format("{}: the fluid at {} crosses {:.3g} cells in a step at step {} (CFL "
                               "above {}; timestep too large for inertia convective)",
                               style_, place, courant, update->ntimestep, MAX_COURANT),
                   Flaw::too_fast);
    else
      stop_.report(fmt::format("{}: the velocity of the fluid at {} is not a number at step {}",
                               style_, place, update->ntimestep),
                   Flaw::not_finite);
  }
  stop_.check();
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::finish_velocity()
{
  if (const auto evaluation = unfinished_.lock()) evaluation->finish_velocity();
}

void DrivenFlow::finish_evaluation()
{
  finish_velocity();
  if (const auto evaluation = unfinished_.lock()) evaluation->finish_viscosity();
}

const fluid::FlowDiagnostics &DrivenFlow::diagnostics()
{
  finish_evaluation();
  if (diagnosed_version_ != version_) {
    diagnostics_ = fluid::diagnose(*flow_, solved_forcing_);
    for (int d = 0; d < 3; ++d) diagnostics_.mean_velocity[d] -= excess_[d];
  }
  diagnosed_version_ = version_;
  return diagnostics_;
}

/* ----------------------------------------------------------------------
   all cells are taken to be inside
------------------------------------------------------------------------- */

std::array<double, 3> DrivenFlow::mean_inside()
{
  if (settings_.inside.empty()) return diagnostics().mean_velocity;
  finish_velocity();
  std::array<double, 3> mean = inside_.mean_velocity(*flow_, version_);
  const double share = box_volume() / inside_volume();
  for (int d = 0; d < 3; ++d) mean[d] -= share * excess_[d];
  return mean;
}

double DrivenFlow::driving_force(int d)
{
  finish_velocity();
  double density = forcing_.end().body[d];
  if (holds_box_mean() && !has_inertia()) density = -flow_->mean_force()[d];
  return density / force->ftm2v;
}

/* ---------------------------------------------------------------------- */

void DrivenFlow::count_from_here()
{
  first_traffic_ = traffic();
  first_solve_ = solves();
  first_step_ = update->ntimestep;
  if (walls_) walls_->reset_counts();
}

bigint DrivenFlow::steps_counted() const
{
  return update->ntimestep - first_step_;
}

fluid::Traffic DrivenFlow::traffic() const
{
  const fluid::Traffic now = flow_->traffic();
  return {earlier_traffic_.messages + now.messages, earlier_traffic_.bytes + now.bytes};
}

std::string DrivenFlow::costs() const
{
  const fluid::Traffic now = traffic();
  double sums[3] = {double(now.messages - first_traffic_.messages),
                    double(now.bytes - first_traffic_.bytes), double(flow_->bytes())};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  const double steps = static_cast<double>(std::max<bigint>(steps_counted(), 1));
  const double each = 1.0 / (steps * comm->nprocs);
  return fmt::format(
      "Fluid: {:.4g} messages and {:.4g} bytes per step and MPI task, {:.4g} bytes of "
      "memory per cell\n",
      sums[0] * each, sums[1] * each, sums[2] / flow_->grid().size());
}

std::vector<StepPart::Section> DrivenFlow::sections()
{
  std::vector<Section> sections = {{"Spread", &spreading_},
                                   {"Solve", &solving_},
                                   {"Interpolate", &interpolating_},
                                   {"Exchange", &exchanging_}};
  if (walls_)
    for (const Section &section : walls_->sections()) sections.push_back(section);
  return sections;
}
