#pragma once

namespace fluid {

/// What the fluid does at a plate. No plate lets fluid through. A further condition needs its name
/// and its factor here, and its word in the arguments of fix rbc/fluid. Its name goes to the end of
/// the list: restart files hold its place, below 16.
enum class PlateCondition {
  no_slip,     ///< The fluid moves with the plate.
  free_slip    ///< The plate exerts no shear traction, like a plane of symmetry.
};

/// The velocity along the plate at a point beyond it is this factor times the velocity at the
/// mirror image of the point, plus one minus the factor times the velocity of the plate. The
/// velocity across a plate has the factor -1 in all cases. Factors lie in [-1, 1]: then the
/// equations stay positive. A factor knows no spacing: one between -1 and 1 is a slip length of
/// h/2 (1 + factor) / (1 - factor), which shrinks with the grid.
constexpr double image_factor(PlateCondition condition)
{
  switch (condition) {
    case PlateCondition::no_slip:
      return -1;
    case PlateCondition::free_slip:
      return 1;
  }
  return -1;
}

/// One number for each end of z.
struct ImageFactors {
  double lower = -1, upper = -1;

  double at(bool is_upper) const { return is_upper ? upper : lower; }
};

struct PlateConditions {
  PlateCondition lower = PlateCondition::no_slip;
  PlateCondition upper = PlateCondition::no_slip;

  constexpr ImageFactors factors() const { return {image_factor(lower), image_factor(upper)}; }

  /// Without shear traction on either plate steady flow has no definite mean velocity.
  constexpr bool hold_the_flow() const { return factors().lower < 1 || factors().upper < 1; }
};

}    // namespace fluid
