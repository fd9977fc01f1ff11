#pragma once

#include "geometry/surface_template.h"
#include "geometry/vector_array.h"
#include "membrane/cell_elements.h"
#include "membrane/crease_resistance.h"
#include "membrane/sheet_laws.h"
#include "membrane/stretch_limit.h"

#include <string>

namespace rbc {

enum class BendingForm { none, helfrich, dihedral };

/// Elastic constants of a membrane. A modulus of zero switches its energy off.
struct MembraneParameters {
  SheetLaw law = NeoHookean(1);
  double bending = 0;    ///< Helfrich modulus kappa, energy
  BendingForm bending_form = BendingForm::helfrich;
  bool reference_curvature = true;     ///< spontaneous curvature is that of the template, or else
  double spontaneous_curvature = 0;    ///< c0, the sum of both principal curvatures, 1/length
  CreaseResistance crease;
  StretchLimit stretch;
  double global_area = 0, local_area = 0;    ///< force per length
  double volume = 0;                         ///< force per area
};

/// Area and volume of a cell, or of the triangles whose first corner a rank owns.
struct AreaVolume {
  double area = 0, volume = 0;
};

struct MembraneEnergy {
  double sheet = 0, bending = 0, area = 0, volume = 0;
  double total() const { return sheet + bending + area + volume; }
};

/// Forces of an elastic membrane on the vertices of a cell: linear triangles carry a hyperelastic
/// sheet. Bending is that of vertices, the Helfrich energy  2 kappa sum_v A_v (H_v - H0_v)^2  with
/// H_v = sum_e l_e theta_e / (4 A_v) over the edges e of vertex v (Juelicher, J. Phys. II France 6
/// (1996) 1797) and the areas A_v of the template's shares of each triangle; or that of hinges.
class MembraneModel {
 public:
  MembraneModel(const SurfaceTemplate &shape, const MembraneParameters &parameters);

  const MembraneParameters &parameters() const { return parameters_; }

  /// Replaces what resists folds and large stretches.
  void limit(const CreaseResistance &crease, const StretchLimit &stretch)
  {
    parameters_.crease = crease;
    parameters_.stretch = stretch;
  }

  /// The volume that the penalty aims at; at first that of the template.
  void set_rest_volume(double volume) { rest_volume_ = volume; }

  /// Whether forces() needs the size of the whole cell.
  bool needs_size() const { return parameters_.global_area > 0 || parameters_.volume > 0; }

  /// Makes this the current cell, which all functions below work on. Positions must be relative to
  /// a nearby origin. They and `elements` are kept by reference.
  void set_cell(const CellElements &elements, const std::vector<Vec3> &x);

  /// This rank's share of the size.
  AreaVolume area_and_volume() const;

  /// v holds a velocity for each vertex. Sets for each vertex that is owned a third of the areas
  /// around it, and that times the sum over two tangents a of (n . dv/da) a + (a . dv/da) n, with n
  /// the outward normal.
  void surface_shear(const Vec3 *v, Vec3 *shear, double *area) const;

  /// Says which triangle is folded over by more than 120 degrees against all three neighbors, or
  /// which two are folded onto each other: the mesh does not resolve the shape, or parts of it
  /// have passed through others. Empty if there are none.
  std::string find_flaw();

  /// Whether find_flaw() has met a fold sharper than 150 degrees, or a triangle that is folded over
  /// against two neighbors.
  bool is_nearly_folded() const { return nearly_folded_; }

  /// Forces on the vertices owned (others are left undefined) and this rank's share of the energy.
  /// `size` is that of the whole cell.
  MembraneEnergy forces(const AreaVolume &size, std::vector<Vec3> &f);

 private:
  struct RestAngle {
    double sine, cosine;
  };

  void find_hinge_angles();
  double bend_hinges();
  double bend_vertices();
  double resist_creases();
  template <BendingForm form, typename Law>
  MembraneEnergy load(const Law &law, const AreaVolume &size);
  double area_penalty(double cell_area) const;
  double volume_penalty(double volume) const;
  void sum_corners(std::vector<Vec3> &f) const;

  const SurfaceTemplate &shape_;
  MembraneParameters parameters_;
  double rest_volume_;
  std::vector<RestAngle> rest_angle_;     ///< of each hinge of the template
  std::vector<double> rest_curvature_;    ///< of each vertex of the template

  // Of the current cell.
  const CellElements *elements_ = nullptr;
  const double *x_ = nullptr;
  VectorArray edge1_, edge2_, normal_;    ///< of each triangle: from its first corner to the others
  std::vector<double> twice_area_;
  VectorArray corner_force_;
  std::vector<double> length_, sine_, cosine_;    ///< of each hinge and the angle of its normals
  std::vector<double> moment_;                    ///< of each hinge: d(energy)/d(angle) per length
  std::vector<double> pull_;                      ///< of each hinge: d(energy)/d(length) per length
  std::vector<double> vertex_area_, vertex_integral_;    ///< of the mean curvature
  std::vector<double> vertex_tension_;                   ///< d(bending energy)/d(vertex area)
  bool nearly_folded_ = false;
  std::vector<int> folded_;    ///< neighbors against which a triangle is folded over
};

}    // namespace rbc
