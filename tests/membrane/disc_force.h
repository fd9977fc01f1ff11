#pragma once

#include "test_support.h"

namespace test {

/// Error of the normal bending force per area on the biconcave disc, for kappa = 1 and c0 = 0. But
/// for `rms_everywhere` it is that without the vertices within two edges of the twelve where five
/// triangles meet.
struct DiscForceError {
  double rms = 0, median = 0, largest = 0;    ///< vertex by vertex
  double rms_everywhere = 0;
  double bands = 0;    ///< rms of the force on 16 bands of latitude
  double exact = 0;    ///< rms of the exact force on the bands

  DiscForceError() = default;
  DiscForceError(int frequency, const Profile &profile, const rbc::MembraneParameters &parameters)
  {
    const Mesh mesh = disc(frequency, profile);
    const rbc::SurfaceTemplate shape = mesh.surface();
    const std::vector<double> areas = vertex_areas(shape);
    const Result result = evaluate(shape, parameters, mesh.vertices);

    std::vector<char> excluded(shape.vertex_count());
    for (int v = 0; v < shape.vertex_count(); ++v) {
      if (shape.neighbors[v].size() != 5) continue;
      for (int w : shape.neighbors[v])
        for (int u : shape.neighbors[w]) excluded[u] = excluded[w] = 1;
    }

    struct Band {
      double force = 0, exact = 0, area = 0;
    };
    std::array<Band, 16> band;
    std::vector<double> errors;
    double total_area = 0;
    for (int v = 0; v < shape.vertex_count(); ++v) {
      const double angle = std::asin(std::min(1.0, mesh.vertices[v].head<2>().norm()));
      const double expected = SmoothDisc{profile}.bending_force(angle);
      const double force = result.force[v].dot(result.volume_gradient[v].normalized());
      const double error = force / areas[v] - expected;
      rms_everywhere += areas[v] / shape.area * error * error;
      if (excluded[v]) continue;
      Band &home = band[std::min(15, static_cast<int>(angle / (pi / 2) * 16))];
      home.force += force;
      home.exact += areas[v] * expected;
      home.area += areas[v];
      errors.push_back(std::abs(error));
      rms += areas[v] * error * error;
      total_area += areas[v];
    }
    for (const Band &b : band) {
      if (b.area == 0) continue;
      bands += std::pow(b.force - b.exact, 2) / b.area;
      exact += std::pow(b.exact, 2) / b.area;
    }
    for (double *square : {&bands, &rms, &exact}) *square = std::sqrt(*square / total_area);
    rms_everywhere = std::sqrt(rms_everywhere);
    if (errors.empty()) {    // a mesh of 162 vertices
      rms = median = largest = bands = exact = NAN;
      return;
    }
    std::sort(errors.begin(), errors.end());
    median = errors[errors.size() / 2];
    largest = errors.back();
  }
};

}    // namespace test
