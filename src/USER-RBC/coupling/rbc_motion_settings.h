#ifndef LMP_RBC_MOTION_SETTINGS_H
#define LMP_RBC_MOTION_SETTINGS_H

#include "coupling/rbc_immersed_markers.h"
#include "motion/integrators.h"

namespace LAMMPS_NS {

/// How markers move, as the arguments of fix rbc/ib say it.
struct MotionSettings {
  enum class Sheets { WITH_MEMBRANES, YES, NO };

  ImmersedMarkers::Settings markers;
  rbc::IntegratorOptions options;
  const rbc::IntegratorKind *integrator = nullptr;    ///< null where none was named
  double error_bound = 0, largest_dt = 0;             ///< of adapt; 0 without it
  double tolerance = 1e-4;
  int max_solves = 100;
  bool iterates = false;    ///< tol or maxiter was given
  bool direct = false;      ///< scheme direct
  Sheets sheets = Sheets::WITH_MEMBRANES;
  bool gaps = true;          ///< sheets slide in gaps as the fluid there lets them
  bool asks_gaps = false;    ///< gaps yes was given

  /// Reads the arguments from `first` on. A bad one is an error.
  static MotionSettings read(LAMMPS *, int narg, char **arg, int first);

  /// It is an error if values exclude each other. Call when `integrator` is set.
  void check(class Error *) const;
};

/// The integrator that is used where none is named. In a fluid with inertia stages are of no use.
const rbc::IntegratorKind *default_integrator(bool inertia);

}    // namespace LAMMPS_NS

#endif
