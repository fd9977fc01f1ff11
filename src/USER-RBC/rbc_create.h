#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(rbc/create,RBCCreate);
// clang-format on
#else

#ifndef LMP_RBC_CREATE_H
#define LMP_RBC_CREATE_H

#include "command.h"
#include "geometry/surface_template.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class RBCCreate : public Command {
 public:
  RBCCreate(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  struct Kind {
    std::string id;
    std::shared_ptr<const rbc::SurfaceTemplate> shape;    // one for all kinds of a template
    double fraction;
    int type;
    int count;
  };
  struct Cell {
    const Kind *kind;
    rbc::Vec3 centre;
    Eigen::Matrix3d rotation;

    rbc::Vec3 vertex(int v) const { return centre + rotation * kind->shape->vertices[v]; }
  };

  std::vector<Kind> kinds;    // that of the template first, then those mixed in

  std::string given_by;    // the keyword that gives places, empty if they are random
  rbc::Vec3 centre = rbc::Vec3::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  std::string file;    // of places
  int wanted = 0;
  double hematocrit = 0;
  class Region *region = nullptr;
  rbc::Vec3 lo = rbc::Vec3::Zero(), length = rbc::Vec3::Zero();    // where cells may lie
  double volume = 0;                                               // of that region or box
  int seed = 0;
  double gap = -1;
  int attempts = 3000;
  double speed = 0;

  void parse(int, char **);
  void check_words(bool seeded) const;
  void read_rotation(class Arguments &);
  void read_region(Arguments &);
  void read_mix(Arguments &);
  Cell place(const rbc::Vec3 &, const Eigen::Matrix3d &, const std::string &what) const;
  std::vector<Cell> place_all();
  std::vector<Cell> pack();
  [[noreturn]] void fail_to_pack(double size) const;
  std::vector<rbc::Vec3> existing_atoms() const;
  void check_images() const;
  void set_extent();
  void set_counts();
  double mean_cell_volume() const;
  double region_volume() const;
  void create_atoms(const std::vector<Cell> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
