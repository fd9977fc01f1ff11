#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/ib,FixRBCIB);
// clang-format on
#else

#ifndef LMP_FIX_RBC_IB_H
#define LMP_FIX_RBC_IB_H

#include "cells/rbc_cell_changes.h"
#include "cells/rbc_cell_contact.h"
#include "coupling/rbc_fluid_client.h"
#include "coupling/rbc_gap_slip.h"
#include "coupling/rbc_massive_markers.h"
#include "coupling/rbc_motion_settings.h"
#include "coupling/rbc_step_cost.h"
#include "coupling/rbc_time_steps.h"
#include "coupling/rbc_traction_filter.h"
#include "coupling/rbc_viscosity_contrast.h"
#include "fix.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Moves atoms with a fluid that their forces drive: arguments, checks, output and LAMMPS's hooks.
class FixRBCIB : public Fix,
                 public FluidClient,
                 public RunEnd,
                 public ContactReader,
                 public RowExchange,
                 public CellWatcher {
 public:
  FixRBCIB(class LAMMPS *, int, char **);
  ~FixRBCIB() override;
  void post_constructor() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void set_arrays(int) override;
  void cells_changed() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;

  const std::string &fluid_id() const override { return fluid; }
  bool drives_flow() const override { return true; }
  double cells_per_step() const override { return courant; }
  bool has_sheets() const override;
  bool has_layers(double) const override;
  double widest_gap() const override;

  std::string remedies_for(const std::vector<Flaw> &) override;

 private:
  using Sheets = MotionSettings::Sheets;

  std::string fluid;
  Sheets sheets = Sheets::WITH_MEMBRANES;
  double courant = 1;
  fluid::KernelKind kernel = fluid::default_kernel;
  int most_solves = 0, integrator_code = 0;
  bool takes_default = false;    // no integrator was named
  bool iterates = false;         // keywords of iterations were given
  bool asks_gaps = false;        // gaps yes was given

  DrivenFlow *flow = nullptr;
  std::unique_ptr<ImmersedMarkers> markers;
  std::unique_ptr<MassiveMarkers> masses;    // of scheme direct, else null
  std::unique_ptr<TimeSteps> steps;
  std::unique_ptr<GapSlip> gaps;    // null with gaps no
  TractionFilter tractions;
  mutable ViscosityContrast contrast;    // makes what it needs when asked for gaps
  AtomRows *exchanged = nullptr;         // in the exchange of ghosts that is under way
  StepCost cost;

  std::string store_id;
  class FixStoreAtom *store = nullptr;    // numbers kept for each atom

  fluid::MarkerKind marker_kind() const;
  bool fluid_has_inertia() const;
  void update_default();
  void start_gaps(const std::vector<CellMembranes *> &);
  bool slides_in_gaps() const;
  void start_contrast(const std::vector<CellMembranes *> &);
  void start_smoothing(const std::vector<CellMembranes *> &);
  void send_to_ghosts(AtomRows &) override;
  void add_from_ghosts(AtomRows &) override;
  void build(const MotionSettings &);
  int stored() const;
  void check_run() const;
  void check_inertia() const;
  bool check_order() const;
  void check_moves_all(const CellMembranes &) const;
  double spacing_for_insides() const;
  std::string pushing_fixes() const;
  void warn_of_default_timestep() const;
  void check_apart(const WallGroup &) const;
  void warn() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
