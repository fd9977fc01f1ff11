#ifndef LMP_RBC_GHOST_CUTOFF_H
#define LMP_RBC_GHOST_CUTOFF_H

#include "comm.h"
#include "pointers.h"

namespace LAMMPS_NS {

/// A ghost cutoff that a style asks for. What an input script asks for with comm_modify cutoff is
/// left alone.
class GhostCutoff : protected Pointers {
 public:
  using Pointers::Pointers;
  GhostCutoff(const GhostCutoff &) = delete;
  GhostCutoff &operator=(const GhostCutoff &) = delete;
  ~GhostCutoff() override
  {
    if (comm->cutghostuser == mine_) comm->cutghostuser = 0;
  }

  bool is_given_by_user() const { return comm->cutghostuser != 0 && comm->cutghostuser != mine_; }

  void ask_for(double cutoff) { comm->cutghostuser = mine_ = cutoff; }

 private:
  double mine_ = 0;
};

}    // namespace LAMMPS_NS

#endif
