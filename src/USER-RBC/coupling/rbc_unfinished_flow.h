#ifndef LMP_RBC_UNFINISHED_FLOW_H
#define LMP_RBC_UNFINISHED_FLOW_H

namespace LAMMPS_NS {

/// An evaluation of a flow whose markers have their velocities, while the flow itself is that of
/// earlier velocities until someone looks at it. The atoms must be as the evaluation left them.
class UnfinishedFlow {
 public:
  /// Makes the flow that of the markers' velocities. Collective.
  virtual void finish_velocity() = 0;

  /// Finds the viscosity on the grid: the velocity that was solved for, divided by it, is that of
  /// the fluid. Collective.
  virtual void finish_viscosity() = 0;

 protected:
  ~UnfinishedFlow() = default;
};

}    // namespace LAMMPS_NS

#endif
