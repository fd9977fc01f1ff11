#ifndef LMP_RBC_EVALUATION_STAGE_H
#define LMP_RBC_EVALUATION_STAGE_H

namespace LAMMPS_NS {

/// Whether an evaluation of velocities is one at the start of a step or one within it.
enum class EvaluationStage { start, within };

}    // namespace LAMMPS_NS

#endif
