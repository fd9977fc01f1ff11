#pragma once

#include <array>

namespace rbc {

/// Keeps a quantity at a wanted value by an input to which it responds linearly. What else it
/// depends on, the disturbance, changes with time and is extrapolated.
class ResponseControl {
 public:
  double input() const { return input_; }

  /// What the input adds to the quantity.
  double effect() const { return response_ * input_; }

  /// Finds the disturbance without input, then the response to this one, which must not be 0.
  void probe(double input)
  {
    input_ = 0;
    probe_ = input;
    stage_ = Stage::WITHOUT_INPUT;
  }
  bool probing() const { return stage_ != Stage::KNOWN; }

  /// Whether the present input() is the probe of the response.
  bool probes_response() const { return stage_ == Stage::WITH_PROBE; }

  /// Whether the quantity grows with the input: a flow that grows against its force would set free
  /// work. Call once the response is known.
  bool takes_work() const { return response_ > 0; }

  /// What it knows once it does not probe: input, response and disturbance.
  using State = std::array<double, 3>;
  State state() const { return {input_, response_, disturbance_}; }
  void restore(const State &state)
  {
    stage_ = Stage::KNOWN;
    input_ = state[0];
    response_ = state[1];
    disturbance_ = state[2];
  }

  /// Once the response is known: changes the input by what should change the quantity by this.
  void shift(double change) { input_ += change / response_; }

  /// Takes the value `measured` that the present input() has given and chooses the input that
  /// should give `wanted`; the first two calls of a probe learn disturbance and response.
  void adjust(double measured, double wanted)
  {
    switch (stage_) {
      case Stage::WITHOUT_INPUT:
        disturbance_ = measured;
        input_ = probe_;
        stage_ = Stage::WITH_PROBE;
        return;
      case Stage::WITH_PROBE:
        response_ = (measured - disturbance_) / probe_;
        input_ = (wanted - disturbance_) / response_;
        stage_ = Stage::KNOWN;
        return;
      case Stage::KNOWN:
        const double before = disturbance_;
        disturbance_ = measured - response_ * input_;
        input_ = (wanted - 2 * disturbance_ + before) / response_;
    }
  }

 private:
  enum class Stage { WITHOUT_INPUT, WITH_PROBE, KNOWN };

  Stage stage_ = Stage::KNOWN;
  double input_ = 0, probe_ = 0, response_ = 1, disturbance_ = 0;
};

}    // namespace rbc
