#include "membrane/volume_gradient.h"

#include "geometry/vector_loop.h"

namespace rbc {

double VolumeGradient::find(const CellElements &elements, const Vec3 *x, Vec3 *gradient)
{
  const double *const numbers = x->data();
  const auto &i = elements.corners[0], &j = elements.corners[1], &k = elements.corners[2];
  for_each(elements.owned_triangles, [&](int t) {
    const PlainVector corner = at(numbers, i[t]);
    area_vector_.set(t, cross(at(numbers, j[t]) - corner, at(numbers, k[t]) - corner));
  });
  double volume = 0;
  const int vertices = static_cast<int>(elements.owned.size());
  for (int v = 0; v < vertices; ++v) {
    PlainVector sum{0, 0, 0};
    for (int n = elements.incident_begin[v]; n < elements.incident_begin[v + 1]; ++n)
      sum = sum + area_vector_[elements.incident_triangles[n]];
    gradient[v] = {sum.x / 6, sum.y / 6, sum.z / 6};
    if (elements.owned[v]) volume += gradient[v].dot(x[v]) / 3;
  }
  return volume;
}

}    // namespace rbc
