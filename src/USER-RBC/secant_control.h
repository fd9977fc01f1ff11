#pragma once

#include <cmath>

namespace rbc {

/// Keeps a quantity at a wanted value by an input on which it depends linearly, but for slow changes.
class SecantControl {
 public:
  bool started() const { return slope_ != 0; }
  double input() const { return input_; }

  /// From a guess of the input and of the slope of the quantity with it.
  void start(double input, double slope)
  {
    input_ = input;
    slope_ = slope;
    known_ = false;
  }

  /// To a measured value, which the input has given.
  void adjust(double measured, double wanted)
  {
    const double change = known_ ? input_ - last_input_ : input_;
    if (std::abs(change) > least_change * std::abs(input_)) {
      const double slope = (measured - (known_ ? last_measured_ : 0)) / change;
      // a change of shape in between, of cells for example, must not turn the sign
      if (slope * slope_ > 0 &&
          (!known_ || std::abs(std::log(slope / slope_)) < largest_log_change))
        slope_ = slope;
    }
    known_ = true;
    last_input_ = input_;
    last_measured_ = measured;
    input_ += (wanted - measured) / slope_;
  }

 private:
  static constexpr double least_change = 0.05, largest_log_change = 1.0;

  double input_ = 0, slope_ = 0;
  bool known_ = false;    ///< a measured value, and the input that gave it
  double last_input_ = 0, last_measured_ = 0;
};

}    // namespace rbc
