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
             const View<Complex> *pressure, const View<Complex> *source) override
  {
    const bool mean = modes_.contains({0, 0, 0});
    if (mean) mean_.solve(spectrum, shift_, forcing, source);
    const int columns = modes_.empty() ? 0 : modes_.extent(0) * modes_.extent(1);
    for (int first = 0; first < columns; first += lanes)
      solve_block(Block(*this, first, std::min(lanes, columns - first)), spectrum, pressure,
                  source);
    if (mean) mean_.store(spectrum, pressure);
  }

 protected:
  /// The velocity or force along the plates, in the directions along the wave vector and across it.
  struct Tangential {
    Modes along, across;
  };

  /// The modes first, first + 1, ... of the plane (kx, ky), in all planes k.
  class Block {
   public:
    Block(const PlateModes &owner, int first, int count) :
        waves_(owner.x_, owner.y_, owner.modes_, first, count), corner_(owner.modes_.lo),
        first_(first), count_(count)
    {
    }

    const Lanes &kappa() const { return waves_.kappa; }

    Modes load(const View<Complex> &from, int k) const { return Modes::load(at(from, k), count_); }
    void store(const Modes &modes, const View<Complex> &to, int k) const
    {
      modes.store(at(to, k), count_);
    }

    /// Components 0 and 1 of `from`, times `scale`. The part along is taken times i, which makes
    /// the equations for it, for w and for the pressure real.
    Tangential load_tangential(const std::array<View<Complex>, 3> &from, int k, double scale) const
    {
      const Modes u = waves_.ex * load(from[0], k), v = waves_.ey * load(from[1], k);
      return {times_i(scale * (waves_.x * u + waves_.y * v)),
              scale * (waves_.x * v - waves_.y * u)};
    }

    /// The way back, without a factor.
    void store_tangential(const Tangential &from, const std::array<View<Complex>, 3> &to,
                          int k) const
    {
      const Modes along = over_i(from.along);
      store(conj(waves_.ex) * (waves_.x * along - waves_.y * from.across), to[0], k);
      store(conj(waves_.ey) * (waves_.y * along + waves_.x * from.across), to[1], k);
    }

   private:
    WaveVectors waves_;
    Index3 corner_;
    int first_, count_;

    Complex *at(const View<Complex> &view, int k) const
    {
      return &view(corner_[0], corner_[1], k) + first_;
    }
  };

  virtual void solve_block(const Block &block, const std::array<View<Complex>, 3> &spectrum,
                           const View<Complex> *pressure, const View<Complex> *source) = 0;

  /// Of the unnormalised transforms in x and y.
  double scale() const { return 1.0 / (double(grid_.cells[0]) * grid_.cells[1]); }

  Grid grid_;
  Box modes_;
  double viscosity_, shift_;
  Wavenumbers x_, y_;

 private:
  MeanProfile mean_;
};

}    // namespace fluid
