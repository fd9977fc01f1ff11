#ifndef LMP_RBC_REMEDIES_H
#define LMP_RBC_REMEDIES_H

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// What is seen of a step that goes wrong.
enum class Flaw {
  too_fast,         ///< a vertex crosses too many fluid cells
  unstable,         ///< displacements grow as in an unstable step
  not_finite,       ///< a velocity or an energy is not a number
  folded,           ///< triangles of a membrane are inverted or folded, or a cell is inside out
  stretched,        ///< an edge is longer than what the ghost atoms cover
  left_fluid,       ///< a vertex left the ghost layers of the fluid
  through_plate,    ///< a vertex is beyond a plate
  crossed,          ///< surfaces of cells passed through each other
  unseen_motion,    ///< vertices moved further than their list of neighbors allows
  other
};

/// What a run has already, and numbers that remedies name.
struct Situation {
  bool inertia = false;
  bool chooses_stages = false;    ///< integrator rkc auto
  bool adapts = false;
  bool membranes = false, creases = false, limits_stretch = false;    ///< all membranes have it
  bool several_cells = false, lacks_contact = false;
  std::string pair_of_atoms;    ///< the pair style if it acts between atoms, else empty
  std::string pushing;          ///< fixes of LAMMPS that add forces to what moves, else empty
  double timestep = 0, ghost_cutoff = 0, skin = 0;
  /// Of the fluid, with which cells of another viscosity inside are thick enough; 0 if they are.
  double finer_spacing = 0;
};

/// What a user can do about the flaws seen, likeliest first, as the end of a message. Names only
/// what the run has not; empty if there is nothing to name.
std::string remedies(const std::vector<Flaw> &seen, const Situation &situation);

/// A fix that has its part in the end of a run with an error.
class RunEnd {
 public:
  /// What can be done about the flaws seen, or nothing.
  virtual std::string remedies_for(const std::vector<Flaw> & /*seen*/) { return {}; }

  /// Writes a picture of what went wrong, which the message `why` tells. Collective.
  virtual void write_failure(const std::string & /*why*/) {}

 protected:
  ~RunEnd() = default;
};

}    // namespace LAMMPS_NS

#endif
