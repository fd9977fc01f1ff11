#ifdef REGION_CLASS
// clang-format off
RegionStyle(rbc/mesh,RegionRBCMesh);
// clang-format on
#else

#ifndef LMP_REGION_RBC_MESH_H
#define LMP_REGION_RBC_MESH_H

#include "region.h"
#include "vessel/periodic_lids.h"
#include "vessel/triangulated_solid.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class RegionRBCMesh : public Region {
 public:
  RegionRBCMesh(class LAMMPS *, int, char **);
  ~RegionRBCMesh() override;
  void init() override;
  int inside(double, double, double) override;
  int surface_interior(double *, double) override;
  int surface_exterior(double *, double) override;

 private:
  double box_lo[3], box_hi[3];    // when the surface was read
  std::unique_ptr<rbc::TriangulatedSolid> solid;

  std::vector<rbc::Triangle> read(const std::string &) const;
  void check_lids(const char *, const std::array<rbc::Lids, 3> &) const;
  void warn_if_beyond_box(const char *) const;
  bool has_openings() const;
  int add_nearest(double *, double, bool);
};

}    // namespace LAMMPS_NS

#endif
#endif
