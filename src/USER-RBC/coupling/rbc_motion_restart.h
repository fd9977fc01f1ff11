#ifndef LMP_RBC_MOTION_RESTART_H
#define LMP_RBC_MOTION_RESTART_H

#include "pointers.h"

#include <cstdio>
#include <string>

namespace LAMMPS_NS {

class MassiveMarkers;
class TimeSteps;

/// What the next step of markers needs to know of those before it, in restart files, besides what
/// is kept for each atom.
class MotionRestart : protected Pointers {
 public:
  /// `style` names the fix in errors; `masses` may be null.
  MotionRestart(LAMMPS *lmp, std::string style, TimeSteps &steps, MassiveMarkers *masses) :
      Pointers(lmp), style_(std::move(style)), steps_(steps), masses_(masses)
  {
  }

  void write(FILE *fp) const;

  /// Also takes files of before there was a layout. An error for those of a later layout.
  void restore(const char *buffer);

 private:
  std::string style_;
  TimeSteps &steps_;
  MassiveMarkers *masses_;
};

}    // namespace LAMMPS_NS

#endif
