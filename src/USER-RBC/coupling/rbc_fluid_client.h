#ifndef LMP_RBC_FLUID_CLIENT_H
#define LMP_RBC_FLUID_CLIENT_H

#include <string>
#include <vector>

namespace LAMMPS_NS {

struct Port;
class WallGroup;

/// A fix whose atoms are immersed in a fluid. At the start of a run fix rbc/fluid asks each of its
/// clients what it needs.
class FluidClient {
 public:
  /// ID of the fix rbc/fluid that it belongs to.
  virtual const std::string &fluid_id() const = 0;

  /// The client advances the flow together with its atoms. A fluid has one such client at most.
  virtual bool drives_flow() const { return false; }

  /// Fluid cells that its atoms may cross in a step.
  virtual double cells_per_step() const { return 0; }

  /// Its atoms are sheets of markers, whose velocities need differences of the flow.
  virtual bool has_sheets() const { return false; }

  /// Its atoms bound fluid of another viscosity than this one.
  virtual bool has_layers(double /*viscosity*/) const { return false; }

  /// Atoms on which the fluid does not slip, or null.
  virtual WallGroup *wall_group() { return nullptr; }

  /// An opening of a vessel, or null.
  virtual Port *port() { return nullptr; }

 protected:
  ~FluidClient() = default;
};

/// All fixes that are clients of a fluid, in the order of their definition.
std::vector<FluidClient *> fluid_clients(class Modify *modify);

}    // namespace LAMMPS_NS

#endif
