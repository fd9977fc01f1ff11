#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace rbc {

/// Fast inertial relaxation engine: motion of unit masses that is led down the forces and stops
/// when it goes up. Bitzek et al., Phys Rev Lett 97, 170201 (2006).
class Fire {
 public:
  Fire(std::size_t size, double time_step, double largest_time_step, double largest_move) :
      velocity_(size), time_step_(time_step), least_time_step_(time_step / 10),
      largest_time_step_(largest_time_step), largest_move_(largest_move)
  {
  }

  /// The move that follows these forces.
  std::vector<double> move(const std::vector<double> &force)
  {
    double power = 0, force_square = 0, speed_square = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      power += force[i] * velocity_[i];
      force_square += force[i] * force[i];
      speed_square += velocity_[i] * velocity_[i];
    }
    if (power > 0) {
      const double turn = mixing_ * std::sqrt(speed_square / force_square);
      for (std::size_t i = 0; i < force.size(); ++i)
        velocity_[i] = (1 - mixing_) * velocity_[i] + turn * force[i];
      if (++downhill_ > patience) {
        time_step_ = std::min(1.1 * time_step_, largest_time_step_);
        mixing_ *= 0.99;
      }
    } else {
      std::fill(velocity_.begin(), velocity_.end(), 0);
      time_step_ = std::max(time_step_ / 2, least_time_step_);
      mixing_ = first_mixing;
      downhill_ = 0;
    }
    std::vector<double> move(force.size());
    double largest = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      velocity_[i] += time_step_ * force[i];
      move[i] = time_step_ * velocity_[i];
      largest = std::max(largest, std::abs(move[i]));
    }
    if (largest > largest_move_)
      for (double &x : move) x *= largest_move_ / largest;
    return move;
  }

 private:
  static constexpr int patience = 5;
  static constexpr double first_mixing = 0.1;

  std::vector<double> velocity_;
  double time_step_, least_time_step_, largest_time_step_, largest_move_;
  double mixing_ = first_mixing;
  int downhill_ = 0;
};

}    // namespace rbc
