#include "membrane/membrane_model.h"

#include "geometry/arc_tangent.h"
#include "geometry/vector_loop.h"
#include "membrane/dihedral_bending.h"
#include "membrane/helfrich_bending.h"
#include "membrane/hinge_geometry.h"
#include "membrane/triangle_load.h"

#include <algorithm>
#include <cmath>

namespace rbc {

namespace {

// Cosine of the largest angle between the normals of two neighbors, 175 degrees. Beyond it they are
// folded onto each other.

constexpr double SHARPEST_FOLD = -0.9962;

// Cosine of 120 degrees. A triangle whose normal is further than that from those of all neighbors
// is inverted. In a wrinkle as narrow as a triangle the angles are 90 degrees, and it comes back.

constexpr double FOLDED_OVER = -0.5;

// where it is worth looking again before a step ends

constexpr double NEARLY_FOLDED = -0.87;

inline PlainVector position(const double *x, int vertex)
{
  return {x[3 * vertex], x[3 * vertex + 1], x[3 * vertex + 2]};
}

}    // namespace

MembraneModel::MembraneModel(const SurfaceTemplate &shape, const MembraneParameters &parameters) :
    shape_(shape), parameters_(parameters), rest_volume_(shape.volume),
    rest_curvature_(shape.curvature), edge1_(shape.triangles.size()),
    edge2_(shape.triangles.size()), normal_(shape.triangles.size()),
    twice_area_(shape.triangles.size()), corner_force_(3 * shape.triangles.size()),
    length_(shape.hinges.size()), sine_(shape.hinges.size()), cosine_(shape.hinges.size()),
    moment_(shape.hinges.size()), pull_(shape.hinges.size()), vertex_area_(shape.vertex_count()),
    vertex_integral_(shape.vertex_count()), vertex_tension_(shape.vertex_count()),
    folded_(shape.triangles.size())
{
  const double c0 = parameters.spontaneous_curvature;
  if (!parameters.reference_curvature)
    std::fill(rest_curvature_.begin(), rest_curvature_.end(), c0 / 2);
  for (const ReferenceHinge &hinge : shape.reference_hinges) {
    const double angle =
        parameters.reference_curvature ? hinge.angle : dihedral_rest_angle(c0, hinge.dual);
    rest_angle_.push_back({std::sin(angle), std::cos(angle)});
  }
}

void MembraneModel::set_cell(const CellElements &elements, const std::vector<Vec3> &positions)
{
  elements_ = &elements;
  x_ = positions[0].data();
  for_each(static_cast<int>(elements.triangles.size()), [&](int t) {
    const PlainVector corner = position(x_, elements.corners[0][t]);
    const PlainVector e1 = position(x_, elements.corners[1][t]) - corner;
    const PlainVector e2 = position(x_, elements.corners[2][t]) - corner;
    const PlainVector product = cross(e1, e2);
    const double twice_area = norm(product);
    edge1_.set(t, e1);
    edge2_.set(t, e2);
    normal_.set(t, (1 / twice_area) * product);
    twice_area_[t] = twice_area;
  });
}

AreaVolume MembraneModel::area_and_volume() const
{
  const CellElements &elements = *elements_;
  const int count = elements.owned_triangles;
  const std::vector<double> &counts = elements.triangle_energy_weight;
  return {sum(count, [&](int t) { return counts[t] * twice_area_[t] / 2; }), sum(count, [&](int t) {
            const PlainVector corner = position(x_, elements.corners[0][t]);
            return counts[t] * dot(corner, normal_[t]) * twice_area_[t] / 6;
          })};
}

void MembraneModel::surface_shear(const Vec3 *v, Vec3 *shear, double *area) const
{
  std::fill_n(shear, shape_.vertex_count(), Vec3::Zero());
  std::fill_n(area, shape_.vertex_count(), 0.0);
  for (int t = 0; t < elements_->owned_triangles; ++t) {
    const PlainVector n = normal_[t], e1 = edge1_[t], e2 = edge2_[t];
    const PlainVector across[3] = {cross(n, e2 - e1), cross(e2, n), cross(n, e1)};
    PlainVector sum{0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const Vec3 &at = v[elements_->corners[k][t]];
      const PlainVector velocity{at[0], at[1], at[2]};
      sum = sum + dot(n, velocity) * across[k] + dot(across[k], velocity) * n;
    }
    const Vec3 third = Vec3(sum.x, sum.y, sum.z) / 6;
    for (const std::vector<int> &corner : elements_->corners) {
      shear[corner[t]] += third;
      area[corner[t]] += twice_area_[t] / 6;
    }
  }
}

std::string MembraneModel::find_flaw()
{
  const std::vector<int> &left = elements_->left, &right = elements_->right;
  const int hinges = static_cast<int>(elements_->hinges.size());
  const auto number = [&](int t) { return std::to_string(elements_->triangles[t] + 1); };
  std::string flaw;
  nearly_folded_ = false;
  std::fill(folded_.begin(), folded_.end(), 0);
  for (int e = 0; e < hinges; ++e) {
    const double cosine = dot(normal_[left[e]], normal_[right[e]]);
    if (cosine >= FOLDED_OVER) continue;
    if (cosine < SHARPEST_FOLD && flaw.empty())
      flaw = "triangles " + number(left[e]) + " and " + number(right[e]) +
             " are folded onto each other";
    nearly_folded_ = nearly_folded_ || cosine < NEARLY_FOLDED;
    for (int t : {left[e], right[e]}) {
      if (++folded_[t] == 3) return "triangle " + number(t) + " is inverted";
      nearly_folded_ = nearly_folded_ || folded_[t] == 2;
    }
  }
  return flaw;
}

MembraneEnergy MembraneModel::forces(const AreaVolume &size, std::vector<Vec3> &f)
{
  const MembraneEnergy energy = std::visit(
      [&](const auto &law) {
        if (parameters_.bending == 0) return load<BendingForm::none>(law, size);
        if (parameters_.bending_form == BendingForm::dihedral)
          return load<BendingForm::dihedral>(law, size);
        return load<BendingForm::helfrich>(law, size);
      },
      parameters_.law);
  sum_corners(f);
  return energy;
}

/// Directions and angles of the hinges.
void MembraneModel::find_hinge_angles()
{
  const CellElements &elements = *elements_;
  for_each(static_cast<int>(elements.hinges.size()), [&](int e) {
    const PlainVector edge = position(x_, elements.end[e]) - position(x_, elements.begin[e]);
    const double length = norm(edge);
    const HingeAngle angle =
        hinge_angle((1 / length) * edge, normal_[elements.left[e]], normal_[elements.right[e]]);
    length_[e] = length;
    sine_[e] = angle.sine;
    cosine_[e] = angle.cosine;
  });
}

/// Moments of the hinges.
double MembraneModel::bend_hinges()
{
  const CellElements &elements = *elements_;
  const double stiffness = dihedral_stiffness(parameters_.bending);
  return sum(static_cast<int>(elements.hinges.size()), [&](int e) {
    const RestAngle &rest = rest_angle_[elements.hinges[e]];
    const HingeEnergy hinge =
        dihedral_bending(stiffness, sine_[e], cosine_[e], rest.sine, rest.cosine);
    moment_[e] = hinge.by_angle / length_[e];
    return elements.hinge_energy_weight[e] * hinge.value;
  });
}

/// Moments and pulls of the hinges, tensions of the vertices.
double MembraneModel::bend_vertices()
{
  const CellElements &elements = *elements_;
  const int hinges = static_cast<int>(elements.hinges.size());
  for_each(hinges, [&](int e) {
    const double theta = arc_tangent(sine_[e], cosine_[e]);
    moment_[e] = theta * length_[e];
    pull_[e] = theta / length_[e];
  });

  std::fill(vertex_area_.begin(), vertex_area_.end(), 0.0);
  std::fill(vertex_integral_.begin(), vertex_integral_.end(), 0.0);
  for (std::size_t t = 0; t < elements.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      vertex_area_[elements.corners[c][t]] +=
          shape_.corner_share[c][elements.triangles[t]] * twice_area_[t] / 2;
  for (int e = 0; e < hinges; ++e)
    for (int v : {elements.begin[e], elements.end[e]}) vertex_integral_[v] += moment_[e] / 4;

  // From here vertex_integral_ holds d(energy)/d(integral).
  double energy = 0;
  for (int v = 0; v < shape_.vertex_count(); ++v) {
    const VertexEnergy vertex = helfrich_bending(parameters_.bending, vertex_area_[v],
                                                 vertex_integral_[v], rest_curvature_[v]);
    if (elements.owned[v]) energy += vertex.value;
    vertex_integral_[v] = vertex.by_integral;
    vertex_tension_[v] = vertex.by_area;
  }

  for_each(hinges, [&](int e) {
    moment_[e] = (vertex_integral_[elements.begin[e]] + vertex_integral_[elements.end[e]]) / 4;
    pull_[e] *= moment_[e];
  });
  return energy;
}

/// Adds to the moments of the hinges, which are known.
double MembraneModel::resist_creases()
{
  const CellElements &elements = *elements_;
  const CreaseResistance &crease = parameters_.crease;
  return sum(static_cast<int>(elements.hinges.size()), [&](int e) {
    const HingeEnergy hinge = crease_resistance(crease, sine_[e], cosine_[e]);
    moment_[e] += hinge.by_angle / length_[e];
    return elements.hinge_energy_weight[e] * hinge.value;
  });
}

/// Forces of the triangles on their corners.
template <BendingForm form, typename Law>
MembraneEnergy MembraneModel::load(const Law &law, const AreaVolume &size)
{
  MembraneEnergy energy;
  if constexpr (form != BendingForm::none) find_hinge_angles();
  if constexpr (form == BendingForm::dihedral) energy.bending = bend_hinges();
  if constexpr (form == BendingForm::helfrich) energy.bending = bend_vertices();
  if constexpr (form != BendingForm::none)
    if (parameters_.crease.stiffness > 0) energy.bending += resist_creases();

  const CellElements &elements = *elements_;
  // names, not structured bindings, which lambdas of C++17 cannot capture
  const auto &i = elements.corners[0], &j = elements.corners[1], &k = elements.corners[2];
  const auto &facing_i = elements.opposite[0], &facing_j = elements.opposite[1],
             &facing_k = elements.opposite[2];
  const auto &share_i = shape_.corner_share[0], &share_j = shape_.corner_share[1],
             &share_k = shape_.corner_share[2];
  const double area_strain = (size.area - shape_.area) / shape_.area;
  const double volume_strain = (size.volume - rest_volume_) / rest_volume_;
  const double global_tension =
      parameters_.global_area > 0 ? parameters_.global_area * area_strain : 0;
  const double pressure = parameters_.volume > 0 ? -parameters_.volume * volume_strain : 0;
  const double local_area = parameters_.local_area;
  const StretchLimit limit = parameters_.stretch;
  const int count = elements.owned_triangles;

  energy.sheet = sum(
      count, [&](int t) __attribute__((always_inline)) {
        TriangleLoad triangle(edge1_[t], edge2_[t], normal_[t], twice_area_[t]);
        const auto &[g11, g12, g22, area] = shape_.reference[elements.triangles[t]];
        const double J = twice_area_[t] / (2 * area);
        const double i1 = triangle.contract(g11, g12, g22);
        const SheetEnergy sheet = law(i1, J), stiffening = stretch_limit(limit, i1);
        const double by_i1 = (sheet.by_i1 + stiffening.by_i1) * area;
        triangle.add_metric(by_i1 * g11, by_i1 * g12, by_i1 * g22);
        triangle.add_tension(sheet.by_J + local_area * (J - 1) + global_tension);
        triangle.add_pressure(pressure);

        if constexpr (form != BendingForm::none)
          triangle.add_moments(moment_[facing_i[t]], moment_[facing_j[t]], moment_[facing_k[t]]);
        if constexpr (form == BendingForm::helfrich) {
          triangle.add_pulls(pull_[facing_i[t]] / 2, pull_[facing_j[t]] / 2,
                             pull_[facing_k[t]] / 2);
          const int n = elements.triangles[t];
          triangle.add_tension(share_i[n] * vertex_tension_[i[t]] +
                               share_j[n] * vertex_tension_[j[t]] +
                               share_k[n] * vertex_tension_[k[t]]);
        }

        corner_force_.set(t, triangle.corner0());
        corner_force_.set(count + t, triangle.corner1());
        corner_force_.set(2 * count + t, triangle.corner2());
        return elements.triangle_energy_weight[t] * area * (sheet.density + stiffening.density);
      });

  energy.area = area_penalty(size.area);
  energy.volume = volume_penalty(size.volume);
  return energy;
}

/// This rank's share. Whole cells are counted by the rank that owns their first vertex.
double MembraneModel::area_penalty(double cell_area) const
{
  const CellElements &elements = *elements_;
  const double local_area = parameters_.local_area;
  double energy = 0;
  if (local_area > 0)
    energy = sum(elements.owned_triangles, [&](int t) {
      const double area = shape_.reference[elements.triangles[t]].area;
      const double strain = twice_area_[t] / (2 * area) - 1;
      return elements.triangle_energy_weight[t] * local_area / 2 * strain * strain * area;
    });
  const double strain = (cell_area - shape_.area) / shape_.area;
  if (elements.owned[0]) energy += parameters_.global_area / 2 * strain * strain * shape_.area;
  return energy;
}

double MembraneModel::volume_penalty(double volume) const
{
  if (!elements_->owned[0]) return 0;
  const double strain = (volume - rest_volume_) / rest_volume_;
  return parameters_.volume / 2 * strain * strain * rest_volume_;
}

void MembraneModel::sum_corners(std::vector<Vec3> &f) const
{
  const CellElements &elements = *elements_;
  for (int v = 0; v < shape_.vertex_count(); ++v) {
    PlainVector sum{0, 0, 0};
    for (int n = elements.incident_begin[v]; n < elements.incident_begin[v + 1]; ++n)
      sum = sum + corner_force_[elements.incident_corners[n]];
    f[v] = {sum.x, sum.y, sum.z};
  }
}

}    // namespace rbc
