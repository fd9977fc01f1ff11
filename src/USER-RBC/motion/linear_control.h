#pragma once

#include <vector>

namespace rbc {

/// Keeps several quantities at wanted values by as many inputs, to which they respond linearly.
/// What else they depend on, the disturbance, changes with time and is extrapolated:
/// ResponseControl for more than one.
class LinearControl {
 public:
  using Numbers = std::vector<double>;

  const Numbers &inputs() const { return inputs_; }

  /// Finds the disturbance without inputs, then the response to each of `count` inputs alone, of
  /// this size, which must not be 0.
  void probe(int count, double size);
  bool probing() const { return stage_ <= count(); }

  /// Whether one of the present inputs() is the probe of a response.
  bool probes_response() const { return probing() && stage_ > 0; }

  /// Takes the values that the present inputs() have given and chooses those which should give the
  /// wanted ones; the first count + 1 calls of a probe learn disturbance and responses.
  void adjust(const Numbers &measured, const Numbers &wanted);

  /// Once responses are known: changes the inputs by what should change the quantities by this.
  void shift(const Numbers &change);

  /// Whether any inputs and the quantities that they cause have a positive product in sum: so flows
  /// and pressures have where flow takes work. Call once the responses are known.
  bool takes_work() const;

  /// The largest part of a quantity that the inputs cause.
  double effect() const;

  /// What it knows once it does not probe: inputs, disturbance, responses.
  Numbers state() const;

  /// Returns whether that is the state of `count` inputs, which it takes up then.
  bool restore(int count, const Numbers &state);

 private:
  Numbers inputs_, disturbance_;
  Numbers response_;    ///< of quantity i to input j at i + count * j
  int stage_ = 1;       ///< 0: without inputs, 1 to count: the input probed; beyond: known
  double size_ = 1;

  int count() const { return static_cast<int>(inputs_.size()); }
  Numbers caused() const;
};

}    // namespace rbc
