#pragma once

#include "fluid/mean_profile.h"
#include "fluid/wave_vectors.h"

namespace fluid {

/// Modes between plates: the mean ones by their profile, all others in blocks of lanes.
class PlateModes : public ModeSolver {
 public:
  PlateModes(const Grid &grid, const Box &modes, double viscosity, double shift) :
      grid_(grid), modes_(modes), viscosity_(viscosity), shift_(shift),
      x_(grid.cells[0], grid.spacing[0], modes.lo[0], modes.hi[0]),
      y_(grid.cells[1], grid.spacing[1], modes.lo[1], modes.hi[1]), mean_(grid, viscosity)
  {
  }

  void set_shift(double shift) override { shift_ = shift; }

  void solve(const std::array<View<Complex>, 3> &spectrum, const Forcing &forcing,
             const View<Complex> *pressure) override
  {
    const bool mean = modes_.contains({0, 0, 0});
    if (mean) mean_.solve(spectrum, shift_, forcing);
    const int columns = modes_.empty() ? 0 : modes_.extent(0) * modes_.extent(1);
    for (int first = 0; first < columns; first += lanes)
      solve_block(spectrum, pressure, first, std::min(lanes, columns - first));
    if (mean) mean_.store(spectrum, pressure);
  }

 protected:
  /// Modes first, first + 1, ... of the plane.
  virtual void solve_block(const std::array<View<Complex>, 3> &spectrum,
                           const View<Complex> *pressure, int first, int count) = 0;

  Grid grid_;
  Box modes_;
  double viscosity_, shift_;
  Wavenumbers x_, y_;

 private:
  MeanProfile mean_;
};

}    // namespace fluid
