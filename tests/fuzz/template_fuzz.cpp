// Molecule templates: lines `v x y z` are vertices, lines `f a b c` triangles, as in the file
// format of Wavefront. What is no closed surface must be refused.

#include "geometry/surface_template.h"
#include "membrane/membrane_model.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using rbc::SurfaceTemplate;
using rbc::Vec3;

SurfaceTemplate parse(const std::string &text)
{
  std::istringstream lines(text);
  std::vector<Vec3> vertices;
  std::vector<SurfaceTemplate::Corners> triangles;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    Vec3 x;
    SurfaceTemplate::Corners corners;
    if (word == "v" && words >> x[0] >> x[1] >> x[2]) vertices.push_back(x);
    if (word == "f" && words >> corners[0] >> corners[1] >> corners[2]) {
      for (int &corner : corners) corner = corner == INT32_MIN ? corner : corner - 1;
      triangles.push_back(corners);
    }
  }
  return SurfaceTemplate(std::move(vertices), std::move(triangles));
}

void check(bool condition)
{
  if (!condition) std::abort();
}

/// What every template that was taken promises.
void check_template(const SurfaceTemplate &shape)
{
  check(shape.volume > 0 && shape.area > 0);
  check(2 * shape.hinges.size() == 3 * shape.triangles.size());
  const double area = std::accumulate(shape.vertex_area.begin(), shape.vertex_area.end(), 0.0);
  check(std::abs(area - shape.area) <= 1e-6 * shape.area);
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  try {
    SurfaceTemplate shape = parse(std::string(data, data + size));
    check_template(shape);
    const SurfaceTemplate same = shape;
    shape.take_reference(same);
    const rbc::MembraneModel model(shape, {});
    check(!model.needs_size());
  } catch (const std::invalid_argument &) {
    // refused, with a reason
  }
  return 0;
}
