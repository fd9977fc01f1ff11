#include "membrane_model.h"

#include "hinge_geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace rbc {

CellElements CellElements::whole(const SurfaceTemplate &shape)
{
  CellElements all;
  all.triangles.resize(shape.triangles.size());
  std::iota(all.triangles.begin(), all.triangles.end(), 0);
  all.hinges.resize(shape.hinges.size());
  std::iota(all.hinges.begin(), all.hinges.end(), 0);
  all.owned.assign(shape.size(), 1);
  return all;
}

CellElements CellElements::part(const SurfaceTemplate &shape, std::vector<char> owned, bool bending)
{
  const auto with_neighbours = [&](const std::vector<char> &core) {
    std::vector<char> grown = core;
    for (int v = 0; v < shape.size(); ++v)
      if (core[v])
        for (int w : shape.neighbours[v]) grown[w] = 1;
    return grown;
  };
  const std::vector<char> core = bending ? with_neighbours(owned) : owned;
  CellElements some;
  for (int t = 0; t < static_cast<int>(shape.triangles.size()); ++t) {
    const auto &[i, j, k] = shape.triangles[t];
    if (core[i] || core[j] || core[k]) some.triangles.push_back(t);
  }
  for (int e = 0; e < static_cast<int>(shape.hinges.size()); ++e)
    if (core[shape.hinges[e].a] || core[shape.hinges[e].b]) some.hinges.push_back(e);
  some.owned = std::move(owned);
  return some;
}

MembraneModel::MembraneModel(const SurfaceTemplate &shape, const MembraneParameters &parameters) :
    shape_(shape), parameters_(parameters), rest_volume_(shape.volume),
    triangles_(shape.triangles.size()), vertex_area_(shape.size()), vertex_curvature_(shape.size()),
    angle_(shape.hinges.size()), length_(shape.hinges.size()), vertex_tension_(shape.size()),
    folded_(shape.triangles.size())
{
}

CellSize MembraneModel::measure(const CellElements &elements, const std::vector<Vec3> &x,
                                Vec3 *volume_gradient) const
{
  if (volume_gradient) std::fill_n(volume_gradient, shape_.size(), Vec3::Zero());
  CellSize share;
  for (int t : elements.triangles) {
    const auto &[i, j, k] = shape_.triangles[t];
    const Vec3 twice_area = (x[j] - x[i]).cross(x[k] - x[i]);
    if (volume_gradient)
      for (int v : {i, j, k}) volume_gradient[v] += twice_area / 6;
    if (!elements.owned[i]) continue;
    share.area += twice_area.norm() / 2;
    share.volume += x[i].dot(twice_area) / 6;
  }
  return share;
}

MembraneEnergy MembraneModel::forces(const CellElements &elements, const std::vector<Vec3> &x,
                                     const CellSize &size, std::vector<Vec3> &f)
{
  std::fill(f.begin(), f.end(), Vec3::Zero());
  triangle_geometry(elements, x);
  const double bending = parameters_.bending > 0 ? bend(elements, x, f) : 0;
  MembraneEnergy energy = std::visit(
      [&](const auto &law) { return stretch(law, elements, x, size, f); }, parameters_.law);
  energy.bending = bending;
  return energy;
}

void MembraneModel::triangle_geometry(const CellElements &elements, const std::vector<Vec3> &x)
{
  for (int t : elements.triangles) {
    const auto &[i, j, k] = shape_.triangles[t];
    const Vec3 twice_area = (x[j] - x[i]).cross(x[k] - x[i]);
    const double norm = twice_area.norm();
    triangles_[t] = {twice_area / norm, norm / 2};
  }
}

double MembraneModel::bend(const CellElements &elements, const std::vector<Vec3> &x,
                           std::vector<Vec3> &f)
{
  std::fill(vertex_area_.begin(), vertex_area_.end(), 0.0);
  std::fill(vertex_curvature_.begin(), vertex_curvature_.end(), 0.0);
  for (int t : elements.triangles)
    for (int v : shape_.triangles[t]) vertex_area_[v] += triangles_[t].area / 3;
  for (int e : elements.hinges) {
    const Hinge &hinge = shape_.hinges[e];
    const Vec3 edge = x[hinge.b] - x[hinge.a];
    length_[e] = edge.norm();
    angle_[e] = hinge_angle(edge / length_[e], triangles_[hinge.left].normal,
                            triangles_[hinge.right].normal);
    const double quarter = length_[e] * angle_[e] / 4;
    vertex_curvature_[hinge.a] += quarter;
    vertex_curvature_[hinge.b] += quarter;
  }

  // From here vertex_curvature_ holds d(energy)/d(integral of H over the vertex area).
  double energy = 0;
  const double kappa = parameters_.bending;
  for (int v = 0; v < shape_.size(); ++v) {
    if (vertex_area_[v] == 0) continue;
    const double rest = parameters_.reference_curvature ? shape_.curvature[v]
                                                        : parameters_.spontaneous_curvature / 2;
    const double curvature = vertex_curvature_[v] / vertex_area_[v], excess = curvature - rest;
    if (elements.owned[v]) energy += 2 * kappa * excess * excess * vertex_area_[v];
    vertex_curvature_[v] = 4 * kappa * excess;
    vertex_tension_[v] = -2 * kappa * excess * (curvature + rest);
  }

  for (int e : elements.hinges) {
    const Hinge &hinge = shape_.hinges[e];
    const double moment = (vertex_curvature_[hinge.a] + vertex_curvature_[hinge.b]) / 4;
    const Vec3 edge = x[hinge.b] - x[hinge.a];
    const double length = length_[e], square = length * length;
    const Triangle &left = triangles_[hinge.left], &right = triangles_[hinge.right];
    const Vec3 left_slope = left.normal * (length / (2 * left.area));
    const Vec3 right_slope = right.normal * (length / (2 * right.area));
    const double c = (x[hinge.c] - x[hinge.a]).dot(edge) / square,
                 d = (x[hinge.d] - x[hinge.a]).dot(edge) / square;
    const double bending = moment * length;
    const Vec3 stretching = edge * (moment * angle_[e] / length);
    f[hinge.a] += stretching - bending * ((1 - c) * left_slope + (1 - d) * right_slope);
    f[hinge.b] -= stretching + bending * (c * left_slope + d * right_slope);
    f[hinge.c] += bending * left_slope;
    f[hinge.d] += bending * right_slope;
  }
  return energy;
}

template <typename Law>
MembraneEnergy MembraneModel::stretch(const Law &law, const CellElements &elements,
                                      const std::vector<Vec3> &x, const CellSize &size,
                                      std::vector<Vec3> &f) const
{
  MembraneEnergy energy;
  const double global_strain = (size.area - shape_.area) / shape_.area;
  const double global_tension =
      parameters_.global_area > 0 ? parameters_.global_area * global_strain : 0;
  const double pressure = volume_stress(size);
  for (int t : elements.triangles) {
    const auto &[i, j, k] = shape_.triangles[t];
    const ReferenceTriangle &reference = shape_.reference[t];
    const Vec3 e1 = x[j] - x[i], e2 = x[k] - x[i];
    const auto &[normal, area] = triangles_[t];
    const double J = area / reference.area;
    const double i1 = reference.g11 * e1.squaredNorm() + 2 * reference.g12 * e1.dot(e2) +
                      reference.g22 * e2.squaredNorm();
    const SheetEnergy sheet = law(i1, J);
    double tension = sheet.by_J + global_tension + parameters_.local_area * (J - 1);
    if (parameters_.bending > 0)
      tension += (vertex_tension_[i] + vertex_tension_[j] + vertex_tension_[k]) / 3;

    const double by_metric = 2 * sheet.by_i1 * reference.area;
    const Vec3 force_j =
        -by_metric * (reference.g11 * e1 + reference.g12 * e2) - (tension / 2) * e2.cross(normal);
    const Vec3 force_k =
        -by_metric * (reference.g12 * e1 + reference.g22 * e2) - (tension / 2) * normal.cross(e1);
    f[j] += force_j;
    f[k] += force_k;
    f[i] -= force_j + force_k;

    if (pressure != 0)
      for (int v : {i, j, k}) f[v] += pressure * area / 3 * normal;
    if (!elements.owned[i]) continue;
    energy.sheet += sheet.density * reference.area;
    energy.area += parameters_.local_area / 2 * (J - 1) * (J - 1) * reference.area;
  }

  // The penalties of a whole cell are counted by the rank that owns its first vertex.
  if (elements.owned[0]) {
    const double volume_strain = (size.volume - rest_volume_) / rest_volume_;
    if (parameters_.global_area > 0)
      energy.area += parameters_.global_area / 2 * global_strain * global_strain * shape_.area;
    if (parameters_.volume > 0)
      energy.volume = parameters_.volume / 2 * volume_strain * volume_strain * rest_volume_;
  }
  return energy;
}

/// Outward force per area: minus the derivative of the volume energy.
double MembraneModel::volume_stress(const CellSize &size) const
{
  if (parameters_.volume <= 0) return 0;
  return -parameters_.volume * (size.volume - rest_volume_) / rest_volume_;
}

int MembraneModel::find_inverted(const CellElements &elements, const std::vector<Vec3> &x)
{
  triangle_geometry(elements, x);
  std::fill(folded_.begin(), folded_.end(), 0);
  for (int e : elements.hinges) {
    const Hinge &hinge = shape_.hinges[e];
    if (triangles_[hinge.left].normal.dot(triangles_[hinge.right].normal) >= 0) continue;
    for (int t : {hinge.left, hinge.right})
      if (++folded_[t] == 3) return t;
  }
  return -1;
}

}    // namespace rbc
