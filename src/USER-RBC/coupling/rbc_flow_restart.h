#ifndef LMP_RBC_FLOW_RESTART_H
#define LMP_RBC_FLOW_RESTART_H

#include "fluid/flow.h"
#include "lmptype.h"
#include "pointers.h"

#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// A flow in restart files. With inertia: numbers that tell what it belongs to, solves so far, then
/// its history. Without: a number below zero that tells the kind of what follows, how many numbers
/// that is, and what the flow remembers.
class FlowRestart : protected Pointers {
 public:
  FlowRestart(LAMMPS *lmp, std::string style) : Pointers(lmp), style_(std::move(style)) {}

  /// An error if the history is larger than what a restart file holds.
  void check_size(const fluid::Flow &flow) const;

  /// Collective.
  void write(FILE *fp, fluid::Flow &flow, bigint solves) const;

  /// Returns the solves so far.
  bigint restore(const char *buffer, fluid::Flow &flow) const;

  /// Without inertia.
  static bool is_of_steady_flow(const char *buffer);
  /// Numbers of write_memory() at most: every rank reads all of them.
  static constexpr std::size_t MOST_REMEMBERED = std::size_t(1) << 24;
  void write_memory(FILE *fp, const std::vector<double> &memory) const;
  std::vector<double> read_memory(const char *buffer) const;

 private:
  std::string style_;

  std::vector<double> head(const fluid::Flow &flow) const;
  double bytes(const fluid::Flow &flow) const;
};

}    // namespace LAMMPS_NS

#endif
