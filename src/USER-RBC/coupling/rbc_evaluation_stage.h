#ifndef LMP_RBC_EVALUATION_STAGE_H
#define LMP_RBC_EVALUATION_STAGE_H

namespace LAMMPS_NS {

/// What the velocities of an evaluation are for. `start`: the next step starts from them; they are
/// computed at setup and at the end of each step. `within`: the integrator asks for them inside a
/// step, the estimate of the spectrum and the error estimate at the end of the step included.
/// `end`: they tell whether a step that was tried ends well; the next step may start from them.
enum class EvaluationStage { start, within, end };

}    // namespace LAMMPS_NS

#endif
