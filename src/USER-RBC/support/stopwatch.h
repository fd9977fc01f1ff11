#pragma once

#include <mpi.h>

namespace rbc {

/// Wall time spent between start() and stop(), summed over calls.
class Stopwatch {
 public:
  void start() { begin_ = MPI_Wtime(); }
  void stop() { seconds_ += MPI_Wtime() - begin_; }
  void reset() { seconds_ = 0; }
  double seconds() const { return seconds_; }

 private:
  double begin_ = 0, seconds_ = 0;
};

}    // namespace rbc
