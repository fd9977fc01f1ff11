#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/wall,FixRBCWall);
// clang-format on
#else

#ifndef LMP_FIX_RBC_WALL_H
#define LMP_FIX_RBC_WALL_H

#include "coupling/rbc_fluid_client.h"
#include "coupling/rbc_wall_group.h"
#include "fix.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

/// Atoms on which a fluid does not slip: arguments, checks, output and LAMMPS's hooks.
class FixRBCWall : public Fix, public FluidClient {
 public:
  FixRBCWall(class LAMMPS *, int, char **);
  ~FixRBCWall() override;
  int setmask() override;
  void init() override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;

  const std::string &fluid_id() const override { return fluid; }
  WallGroup *wall_group() override { return &wall; }
  bool has_sheets() const override { return wall.settings().kind == fluid::MarkerKind::sheets; }

 private:
  std::string fluid;
  WallGroup wall;
  bigint atoms_checked = 0;    // whose spacing is known
  bigint measured = -1;        // evaluation of the fluid
  std::array<double, 6> total{};

  WallGroup::Settings parse(int, char **);
  class FixRBCFluid *fluid_fix() const;    ///< null once it is deleted
  const class RigidWalls *all_walls() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
