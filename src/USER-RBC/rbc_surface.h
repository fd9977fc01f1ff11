#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(rbc/surface,RBCSurface);
// clang-format on
#else

#ifndef LMP_RBC_SURFACE_H
#define LMP_RBC_SURFACE_H

#include "command.h"
#include "geometry/surface_template.h"

#include <vector>

namespace LAMMPS_NS {

class RBCSurface : public Command {
 public:
  RBCSurface(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  class Region *region = nullptr;
  int type = 0;
  double spacing = 0, offset = 0, mass = 0;

  void parse(int, char **);
  void extent(rbc::Vec3 &, rbc::Vec3 &) const;
  void check_spacing(const rbc::Vec3 &, const rbc::Vec3 &) const;
  void create_atoms(const std::vector<rbc::Vec3> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
