#ifndef LMP_RBC_CELL_PLACES_H
#define LMP_RBC_CELL_PLACES_H

#include "geometry/vec3.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace LAMMPS_NS {

class LAMMPS;

struct CellPlace {
  rbc::Vec3 origin;            ///< of the template
  Eigen::Matrix3d rotation;    ///< about it
  int line;                    ///< of the file
};

/// By an angle in degrees, right-handed about an axis of any length but 0.
Eigen::Matrix3d rotation_about(double degrees, const rbc::Vec3 &axis);

/// By a line of HemoCell's .pos files: its cells lie with their axis along y, those here along z,
/// and are turned about x, y and z one after the other, by degrees.
Eigen::Matrix3d hemocell_rotation(double rx, double ry, double rz);

enum class PlaceForm {
  axis,       ///< x y z, or x y z theta nx ny nz with a rotation
  hemocell    ///< the number of cells in the first line, then x y z rx ry rz
};

/// Reads places of cells, one in a line of a text file. Rank 0 reads it for all. Collective. Errors
/// name the file, the line and what is wrong.
std::vector<CellPlace> read_cell_places(LAMMPS *lmp, const std::string &file, PlaceForm form,
                                        const std::string &style);

}    // namespace LAMMPS_NS

#endif
