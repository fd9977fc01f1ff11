#ifndef LMP_RBC_DRIVEN_FLOW_H
#define LMP_RBC_DRIVEN_FLOW_H

#include "coupling/rbc_flow_forcing.h"
#include "coupling/rbc_flow_inside.h"
#include "coupling/rbc_flow_ports.h"
#include "coupling/rbc_fluid_settings.h"
#include "coupling/rbc_rigid_walls.h"
#include "coupling/rbc_scene_table.h"
#include "fluid/diagnostics.h"
#include "fluid/direct_forcing.h"
#include "support/rbc_step_part.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FluidClient;
class UnfinishedFlow;

/// A flow and all that acts on it: forcing, the region inside of which the body force acts, walls
/// of atoms, and the time within a step. An evaluation is
///   clear_force, spread, solve, interpolate, finish_step
/// and may be made any number of times for the same step and time.
class DrivenFlow : public StepPart, protected Pointers {
 public:
  /// `style` names the fix in errors.
  DrivenFlow(LAMMPS *lmp, std::string style, const FluidSettings &settings, FlowForcing forcing);
  ~DrivenFlow() override;

  const FluidSettings &settings() const { return settings_; }
  fluid::Flow &flow() { return *flow_; }
  const fluid::Flow &flow() const { return *flow_; }
  class Grid3d *grid() const { return grid_.get(); }
  bool has_inertia() const { return settings_.equations.inertia != fluid::Inertia::none; }
  double smallest_spacing() const;
  double mean_spacing() const;    ///< cube root of the volume of a fluid cell
  double box_volume() const;
  int ghost_layers() const { return ghost_layers_; }
  SceneTable &scene() { return scene_; }

  /// Collective, at the start of a run: takes in the clients' demands and walls.
  void start_run(const std::vector<FluidClient *> &clients, const std::string &fluid_id);

  /// Collective: makes the flow anew on LAMMPS's subdomains, where they are others, and goes on
  /// with what it was.
  void build();

  /// Whether a fix rbc/ib advances this flow. Otherwise fix rbc/fluid advances it.
  bool is_driven() const { return driven_; }
  RigidWalls *walls() { return walls_.get(); }
  const RigidWalls *walls() const { return walls_.get(); }
  const FlowPorts *ports() const { return ports_.get(); }

  /// Call where a port or a wall ceases to exist; those that are left are taken in by the next run.
  void drop_ports() { ports_.reset(); }
  void drop_walls() { walls_.reset(); }

  /// What drives the flow at the time of set_time...().
  const fluid::Forcing &forcing() const { return forcing_now_; }

  /// Something changes the flow from step to step even without markers.
  bool varies() const
  {
    return forcing_.varies() || (walls_ && walls_->moves()) || (ports_ && ports_->varies());
  }

  // Time. Collective where forcing or walls depend on variables.

  /// A flow that has made steps goes on from the forcing at the end of the last, though variables
  /// may jump between runs.
  void set_time_at_setup();

  /// Evaluates the forcing at the end of LAMMPS's present step and makes it the present forcing.
  /// Where a flow rate is held and was measured since, this also adjusts what drives it. Does not
  /// move walls.
  void set_time_now();

  /// Evaluates forcing and velocities of walls at the end of the step that begins. `again`: the
  /// same step is made once more with another timestep; walls return to where they were at its
  /// start. Where a flow rate is held, that of the last step is measured for the control, unless
  /// `again`.
  void begin_step(bool again);

  /// Sets the forcing to its value at `fraction` of the step begun (0 start, 1 end), linear between
  /// the ends, and moves the walls there.
  void set_time(double fraction);

  /// Moves the atoms of walls to where they are at `fraction` of the step; the forcing stays as it
  /// is.
  void place_walls(double fraction);

  /// The mean velocity inside a vessel is held, or the pressures in its ports are.
  /// correct_flow_rate() adjusts what drives the flow by what the last solve gave, and is then as
  /// set_time_now(). After the solve at the start of a run, probe_flow_rate() tells whether there
  /// must be another one, for a probe of the response or the forcing that follows from it.
  /// Collective.
  bool controls_flow_rate() const { return forcing_.held_direction() >= 0; }
  void correct_flow_rate();
  bool probe_flow_rate();
  bool is_probing_flow_rate() const
  {
    return (controls_flow_rate() && forcing_.probing()) || (ports_ && ports_->probing());
  }

  /// Between hold_walls() and release_walls() evaluations may be made that are not to count: with
  /// `as_before` the walls go on from what they knew before. Collective.
  void hold_walls();
  void release_walls(bool as_before);

  /// What the next step of a flow without inertia needs to know of those before it, of flow rate
  /// and walls: for restart files, on rank 0, in `most` numbers at the most. Collective.
  std::vector<double> memory(std::size_t most);
  void remember(std::vector<double> memory);

  // An evaluation. Collective but for clear_force and spread.

  void clear_force();

  /// Adds forces of markers, times a factor. Returns the first marker whose kernel leaves the ghost
  /// layers, or -1.
  int spread(const fluid::MarkerSet &markers, const double *force, double factor);

  /// Adds the double layer of markers, whose flow has `excess` more mean velocity than the fluid.
  /// Returns what the other spread does.
  int spread(const fluid::MarkerSet &markers, const fluid::DoubleLayer &layer,
             const std::array<double, 3> &excess);

  /// See fluid::Flow. Collective.
  int find_excess(const fluid::MarkerSet &markers, const double *step, double mean,
                  const std::array<double, 2> &bounds);

  /// Computes the velocity of the fluid from the forces spread, the forcing and, if `with_walls`,
  /// the walls. Checks `stop` first: an error reported there ends the run, or throws FailedTrial
  /// while a step is tried. With inertia this starts a step of the fluid, and the velocity is that
  /// of the middle of the step.
  void solve(CollectiveStop &stop, bool with_walls = true);

  void interpolate(const fluid::MarkerSet &markers, double *velocity);

  /// Takes the place of clear_force, spread, solve and interpolate for markers with mass; with
  /// inertia only.
  fluid::DirectForcing::Outcome couple_masses(fluid::DirectForcing &direct,
                                              const fluid::DirectForcing::Problem &problem);

  /// Velocities at the markers that further forces on them would add, without walls. Returns what
  /// spread does.
  int apply_mobility(const fluid::MarkerSet &markers, const double *force, double *velocity,
                     const fluid::DoubleLayer *layer = nullptr,
                     const std::array<double, 3> &excess = {0, 0, 0}, bool with_forces = true);

  /// Adds a double layer and its flow to the flow solved for, for output. `velocity` is
  /// overwritten. Costs a solve. Returns what spread does. Collective.
  int add_layer(const fluid::MarkerSet &markers, const fluid::DoubleLayer &layer,
                const std::array<double, 3> &excess, double *velocity);

  /// With inertia: the end of the fluid's step. Without: nothing.
  void finish_step();

  /// Tells who has evaluated this flow and may have left the evaluation unfinished. Nothing happens
  /// once that object is gone.
  void leave_unfinished(std::weak_ptr<UnfinishedFlow> evaluation)
  {
    unfinished_ = std::move(evaluation);
  }

  /// Finishes the velocity of the last evaluation, or all of it. Call one of them before the flow
  /// is read through flow(); diagnostics() and the other functions for output do so themselves.
  /// Collective.
  void finish_velocity();
  void finish_evaluation();

  /// Call after the flow was changed through flow(): measures of it are computed anew when asked
  /// for. With inertia convective this also checks how many cells the fluid crosses in a step,
  /// which is collective and may end the run.
  void changed();

  // output; collective

  /// The force density that acts everywhere in the grid.
  const std::array<double, 3> &uniform_force() const { return solved_forcing_.body; }

  bigint version() const { return version_; }
  bigint solves() const { return flow_->solves() + earlier_solves_; }
  void set_earlier_solves(bigint solves) { earlier_solves_ = solves; }
  const fluid::FlowDiagnostics &diagnostics();
  const std::string &inside_region() const { return inside_.region(); }    ///< empty: all the box
  std::array<double, 3> mean_inside();
  double inside_volume() { return inside_.volume(*flow_); }

  /// Of a port of this flow: volume of its cells, and mean pressure, see FlowPorts::pressure().
  double port_volume(const Port *port) { return ports_->volume(port, *flow_, inside_); }
  double port_pressure(const Port *port);

  /// What the control of pressures needs to know of steps before; for restart files. Collective.
  std::vector<double> port_memory();

  /// Body force, or the pressure gradient that balances all forces where the mean velocity is held;
  /// force density.
  double driving_force(int d);

  void count_from_here();
  bigint solves_counted() const { return solves() - first_solve_; }
  bigint steps_counted() const;

  /// Messages, bytes and memory since count_from_here(), as a line of text.
  std::string costs() const;

  void report_to(const std::shared_ptr<CollectiveStop> & /*stop*/) override {}
  std::vector<Section> sections() override;

 private:
  std::string style_;
  FluidSettings settings_;
  FlowForcing forcing_;
  FlowInside inside_;
  std::unique_ptr<Grid3d> grid_;
  std::unique_ptr<fluid::Flow> flow_;
  std::unique_ptr<RigidWalls> walls_;    ///< null without walls
  std::unique_ptr<FlowPorts> ports_;     ///< null without ports
  CollectiveStop stop_;
  SceneTable scene_;

  // demands of the clients
  bool driven_ = false, sheets_ = false, layers_ = false;
  double cells_per_step_ = 1;
  int ghost_layers_ = -1;
  std::vector<double> wall_memory_;    ///< from a restart file, until there are walls
  bool free_mean_ = false;             ///< the mean velocity follows from the forces of walls

  // time
  double fraction_ = 1;              ///< of the step
  fluid::Forcing forcing_now_;       ///< at that time
  fluid::Forcing solved_forcing_;    ///< of the last solve: what acts everywhere in the grid

  // an evaluation
  std::weak_ptr<UnfinishedFlow> unfinished_;
  std::array<double, 3> marker_force_{};    ///< sum spread on this rank; kept with walls
  std::array<double, 3> excess_{};          ///< of the mean velocity that is solved for

  bigint version_ = 0, diagnosed_version_ = -1;    ///< of the velocity
  fluid::FlowDiagnostics diagnostics_;
  bigint earlier_solves_ = 0;         ///< before a restart
  fluid::Traffic earlier_traffic_;    ///< on earlier decompositions
  fluid::Traffic first_traffic_;      ///< at count_from_here()
  bigint first_step_ = 0, first_solve_ = 0;
  rbc::Stopwatch spreading_, exchanging_, solving_, interpolating_;

  int layers_needed() const;
  void take_demands(const std::vector<FluidClient *> &clients, const std::string &fluid_id);
  void connect_ports(std::vector<Port *> ports);
  void connect_walls(const std::vector<WallGroup *> &groups);
  void warn_of_idle_forcing() const;
  void warn_of_vessel_at_rest() const;
  void start_control();
  void continue_control();
  void start_port_control();
  /// Of the flow that probes how a vessel or its ports respond.
  double probe_velocity() const;
  void continue_port_control();
  bool probe_ports();
  void check_probe() const;
  const std::vector<double> &port_pressures();
  double rate_inside() { return mean_inside()[forcing_.held_direction()]; }
  bool holds_box_mean() const;
  void set_forcing(const fluid::Forcing &forcing);
  void spread_walls(fluid::Forcing &uniform, CollectiveStop &stop);
  void check_courant();
  fluid::Traffic traffic() const;
};

}    // namespace LAMMPS_NS

#endif
