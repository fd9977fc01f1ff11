#include "coupling/rbc_motion_restart.h"

#include "comm.h"
#include "coupling/rbc_massive_markers.h"
#include "coupling/rbc_time_steps.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

// The file has these numbers: LAYOUT, two of scheme direct, those of the time steps. Earlier files
// had no layout, so their first number was a timestep, and they had fewer numbers of the time
// steps.

static constexpr double LAYOUT = -1;
static constexpr int NUMBERS = 3 + TimeSteps::NSTATE;

/* ---------------------------------------------------------------------- */

void MotionRestart::write(FILE *fp) const
{
  if (comm->me != 0) return;
  double numbers[NUMBERS] = {LAYOUT};
  if (masses_) std::copy_n(masses_->state().data(), 2, numbers + 1);
  const TimeSteps::State of_steps = steps_.state();
  std::copy(of_steps.begin(), of_steps.end(), numbers + 3);
  const int size = sizeof(numbers);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(numbers, sizeof(double), NUMBERS, fp);
}

/* ---------------------------------------------------------------------- */

void MotionRestart::restore(const char *buffer)
{
  const auto found = reinterpret_cast<const double *>(buffer);
  if (found[0] < LAYOUT)
    error->all(FLERR,
               "{}: the restart file is of a later version of this package, which keeps other "
               "numbers; use that version, or another fix ID to start without them",
               style_);
  const bool of_before = found[0] >= 0;
  const double *const numbers = of_before ? found : found + 1;
  if (masses_) masses_->restore({numbers[0], numbers[1]});
  if (of_before)
    steps_.restart_from_before(numbers + 2);
  else
    steps_.restart(numbers + 2);
}
