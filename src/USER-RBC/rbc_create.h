#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(rbc/create,RBCCreate);
// clang-format on
#else

#ifndef LMP_RBC_CREATE_H
#define LMP_RBC_CREATE_H

#include "command.h"
#include "surface_template.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class RBCCreate : public Command {
 public:
  RBCCreate(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  using Vertices = std::vector<rbc::Vec3>;

  std::string template_id;
  std::unique_ptr<rbc::SurfaceTemplate> shape;

  bool single = false;
  rbc::Vec3 centre = rbc::Vec3::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  int wanted = 0;
  double hematocrit = 0;
  class Region *region = nullptr;
  rbc::Vec3 lo = rbc::Vec3::Zero(), length = rbc::Vec3::Zero();    // where cells may lie
  int seed = 0;
  int type = 0;
  double gap = -1;
  int attempts = 1000;

  void parse(int, char **);
  std::vector<Vertices> place_randomly();
  void check_images() const;
  void set_extent();
  double region_volume() const;
  void create_atoms(const std::vector<Vertices> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
