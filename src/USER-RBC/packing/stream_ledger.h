#pragma once

#include <cstdint>
#include <vector>

namespace rbc {

/// The account of cells that enter a vessel through one opening and leave it through others. Cells
/// are owed in proportion to the volume that enters.
class StreamLedger {
 public:
  /// What has passed an opening.
  struct Passage {
    double volume = 0;    ///< in the direction of the stream; what flows back does not count
    double cells = 0;
    double cell_volume = 0;    ///< of these cells

    /// Volume of cells over that of all that has passed.
    double hematocrit() const { return volume > 0 ? cell_volume / volume : 0; }
  };

  /// `hematocrit`: of what shall enter.
  StreamLedger(double hematocrit, int outlets) : hematocrit_(hematocrit), outlets_(outlets) {}

  void set_cell_volume(double volume) { cell_volume_ = volume; }

  /// The rates at which volume enters through the inlet and leaves through each outlet, at the
  /// start of a run. Does nothing if they are those of the last step, or of another ledger's state,
  /// but for round-off.
  void start(double inlet, const std::vector<double> &outlets);

  /// A step of time dt that ends with these rates. They are linear in it. Returns how many cells
  /// are owed for what enters.
  double pass(double dt, double inlet, const std::vector<double> &outlets);

  void let_in(int cells);
  void let_out(int outlet);

  /// Cells owed; below 0 where more have entered.
  double owed() const { return owed_; }

  const Passage &inlet() const { return inlet_; }
  const Passage &outlet(int n) const { return outlets_[n]; }
  /// Of all outlets.
  Passage left() const;

  /// All that a ledger with the same number of outlets needs to go on; whether it does.
  std::vector<double> state() const;
  bool restore(const std::vector<double> &state);

 private:
  double hematocrit_, cell_volume_ = 1, owed_ = 0;
  Passage inlet_;
  std::vector<Passage> outlets_;
  std::vector<double> rates_;    ///< of inlet and outlets at the end of the last step; none: empty
};

}    // namespace rbc
