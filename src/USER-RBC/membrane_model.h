#pragma once

#include "mooney_rivlin.h"
#include "skalak.h"
#include "surface_template.h"

#include <variant>

namespace rbc {

using SheetLaw = std::variant<MooneyRivlin, Skalak>;

/// Elastic constants of a membrane. A modulus of zero switches its energy off.
struct MembraneParameters {
  SheetLaw law = MooneyRivlin::neo_hookean(1);
  double bending = 0;    ///< Helfrich modulus kappa, energy
  bool reference_curvature =
      true;    ///< spontaneous curvature is that of the stress-free shape, or else
  double spontaneous_curvature = 0;          ///< c0, the sum of both principal curvatures, 1/length
  double global_area = 0, local_area = 0;    ///< force per length
  double volume = 0;                         ///< force per area
};

/// The elements of one cell that a rank evaluates: all of them, or for a cell that other ranks share those needed
/// for the forces on the vertices it owns.
struct CellElements {
  std::vector<int> triangles, hinges;
  std::vector<char> owned;    ///< of each vertex of the template

  static CellElements whole(const SurfaceTemplate &shape);

  /// Elements around the owned vertices, and with bending around their neighbours too.
  static CellElements part(const SurfaceTemplate &shape, std::vector<char> owned, bool bending);
};

/// Area and volume of a cell, or of the triangles whose first corner a rank owns.
struct CellSize {
  double area = 0, volume = 0;
};

struct MembraneEnergy {
  double sheet = 0, bending = 0, area = 0, volume = 0;
  double total() const { return sheet + bending + area + volume; }
};

/// Forces of an elastic membrane on the vertices of a cell: linear triangles carry a hyperelastic sheet, vertices
/// the Helfrich energy  2 kappa sum_i A_i (H_i - H0_i)^2  with H_i = sum_e l_e theta_e / (4 A_i) over the edges e of
/// vertex i (Juelicher, J. Phys. II France 6 (1996) 1797; Guckenberger & Gekle, J. Phys.: Condens. Matter 29 (2017)
/// 203001).
class MembraneModel {
 public:
  MembraneModel(const SurfaceTemplate &shape, const MembraneParameters &parameters);

  const MembraneParameters &parameters() const { return parameters_; }

  /// The volume that the penalty aims at; at first that of the template.
  void set_rest_volume(double volume) { rest_volume_ = volume; }

  /// Whether forces() needs the size of the whole cell.
  bool needs_size() const { return parameters_.global_area > 0 || parameters_.volume > 0; }

  /// This rank's share of the size. Where `volume_gradient` is given (an entry for each vertex of the
  /// template), dV/dx of every vertex whose triangles are all in `elements` is written there.
  CellSize measure(const CellElements &elements, const std::vector<Vec3> &x,
                   Vec3 *volume_gradient = nullptr) const;

  /// Forces on the vertices owned (others are left undefined) and this rank's share of the energy. `size` is that of
  /// the whole cell. Positions must be relative to a nearby origin.
  MembraneEnergy forces(const CellElements &elements, const std::vector<Vec3> &x,
                        const CellSize &size, std::vector<Vec3> &f);

  /// A triangle that lies folded over against all three neighbours, or -1.
  int find_inverted(const CellElements &elements, const std::vector<Vec3> &x);

 private:
  struct Triangle {
    Vec3 normal;
    double area;
  };

  void triangle_geometry(const CellElements &elements, const std::vector<Vec3> &x);
  double bend(const CellElements &elements, const std::vector<Vec3> &x, std::vector<Vec3> &f);
  template <typename Law>
  MembraneEnergy stretch(const Law &law, const CellElements &elements, const std::vector<Vec3> &x,
                         const CellSize &size, std::vector<Vec3> &f) const;
  double volume_stress(const CellSize &size) const;

  const SurfaceTemplate &shape_;
  MembraneParameters parameters_;
  double rest_volume_;

  // Of the cell in hand.
  std::vector<Triangle> triangles_;
  std::vector<double> vertex_area_, vertex_curvature_;
  std::vector<double> angle_, length_;
  std::vector<double> vertex_tension_;    ///< d(bending energy)/d(vertex area)
  std::vector<int> folded_;               ///< neighbours against which a triangle is folded over
};

}    // namespace rbc
