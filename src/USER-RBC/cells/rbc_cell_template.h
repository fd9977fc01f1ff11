#ifndef LMP_RBC_CELL_TEMPLATE_H
#define LMP_RBC_CELL_TEMPLATE_H

#include "geometry/surface_template.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;

/// Coords and Angles of a molecule template as a closed oriented surface; an error naming `style`
/// if they are not one.
std::unique_ptr<rbc::SurfaceTemplate> make_cell_template(LAMMPS *lmp, const std::string &id,
                                                         const std::string &style);

/// Makes the triangles of another molecule template the stress-free ones of `surface`, made from
/// template `id`; an error naming `style` unless it has the same triangles.
void take_stress_free_shape(LAMMPS *lmp, rbc::SurfaceTemplate &surface, const std::string &id,
                            const std::string &stress_free_id, const std::string &style);

}    // namespace LAMMPS_NS

#endif
