// STL files: what the reader takes must either be refused with a reason or enclose something.

#include "vessel/mesh_connectivity.h"
#include "vessel/stl_file.h"
#include "vessel/triangulated_solid.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

namespace {

using rbc::Vec3;

const rbc::PackingBox box{Vec3::Zero(), Vec3::Constant(12), {true, false, false}};

/// A file in memory, which read_stl opens by its name.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t *data, std::size_t size) : descriptor_(memfd_create("stl", 0))
  {
    if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size))
      std::abort();
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile &) = delete;
  MemoryFile &operator=(const MemoryFile &) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

void require(bool condition)
{
  if (!condition) std::abort();
}

void measure(const rbc::TriangulatedSolid &solid)
{
  require(solid.volume() > 0);
  for (const Vec3 &x : {Vec3(6, 6, 6), Vec3(0, 0, 0), Vec3(12, 1, 11.5), solid.lo(), solid.hi()}) {
    const auto nearest = solid.nearest(x, 3);
    if (nearest) require(solid.contains(x) == (nearest->distance <= 0));
  }
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const MemoryFile file(data, size);
  try {
    std::vector<rbc::Triangle> triangles = rbc::read_stl(file.path());
    const rbc::MeshConnectivity mesh(triangles, box);
    require(mesh.vertices() >= 3);
    // a table of distances takes a second
    if (size % 64 == 0) measure(rbc::TriangulatedSolid(triangles, box));
  } catch (const std::invalid_argument &) {
    // refused, with a reason
  }
  return 0;
}
