#pragma once

#include "motion/chebyshev.h"
#include "motion/integrator.h"
#include "motion/stability_estimate.h"

namespace rbc {

/// Runge-Kutta-Chebyshev method of second order, or of third with the displacements of the last
/// steps. The number of stages is given or, where it is 0, the fewest that are stable for the
/// spectral radius. Then a step that went wrong can be taken again: with more stages for a new
/// estimate of the radius, and from the second time on in 2, 4, 8 .. equal parts of second order.
class RungeKuttaChebyshev : public Integrator {
 public:
  RungeKuttaChebyshev(int stages, int order);

  int order() const override { return 2; }
  double largest_growth() const override;
  int kept_vectors() const override { return past_steps() + (automatic_ ? 1 : 0); }
  bool counts_steps() const override { return past_steps() > 0; }
  void start_run(double length, bool continues, bool forces_differ) override
  {
    stability_.start_run(length, continues, forces_differ);
  }
  void points_migrated(const Motion &motion, std::size_t points, const PointStore &store) override;
  bool has_grown() const override { return grown_; }
  bool was_sudden() const override { return sudden_; }
  bool can_retake() const override { return automatic_; }
  bool retake() override;
  void step(Motion &motion, PointStore &store, const StepStart &start, Numbers &x) override;
  void accept(PointStore &store, const StepStart &start, const Numbers &x) override;
  void reject(const Motion &motion, PointStore &store, const StepStart &start,
              const Numbers &x) override;
  int stages() const override { return chebyshev_.stages(); }
  double spectral_radius() const override { return automatic_ ? stability_.last() : 0; }
  State state() const override;
  void restore(const State &state) override;
  std::size_t bytes() const override;

 private:
  ChebyshevMethod chebyshev_;
  bool automatic_;
  StabilityEstimate stability_{work_};
  int retakes_ = 0;    ///< of the step that is being taken
  bool grown_ = false, sudden_ = false;

  // third order
  DisplacementHistory past_;
  std::array<double, DisplacementHistory::LONGEST> past_dt_{};
  int known_steps_ = 0;    ///< of all points

  Numbers scratch_, velocity_;

  int past_steps() const { return chebyshev_.past_steps(); }
  int mode_vector() const { return past_steps(); }
  void load_past(const PointStore &store, double dt);
  void step_in_parts(Motion &motion, const StepStart &start, double radius, int parts, Numbers &x);
  void check_growth(Motion &motion, PointStore &store, const StepStart &start, const Numbers &x,
                    int parts);
  void choose_stages(double dt, double radius);
  double bearable(double dt) const;
};

}    // namespace rbc
