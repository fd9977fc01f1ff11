// Resistances of a rigid sphere that moves near a plate or near its mirror image, another sphere.
// Spheres are points, behind the surface by the offset of a plane, or sheets, on it. Writes a
// table, without a resistance where the solution for forces does not converge.

#include "curved_walls.h"

#include <cstdio>

using namespace test;

namespace {

constexpr double middle_offset[] = {0.13, 0.21};    // of the axis from the grid's faces

/// How a sphere moves, z being the line to the plate or to the other sphere. The other one moves
/// against it: away, past it, or so that the surfaces in the gap slide past each other.
struct Motion {
  const char *name;
  bool turns;
  int axis;
};

constexpr Motion motions[] = {{"apart", false, 2},
                              {"past", false, 0},
                              {"turning across", true, 1},
                              {"turning along", true, 2}};

struct Setting {
  KernelKind kernel;
  MarkerKind kind;
  double radius, gap;
  bool plate;
};

Real3 cross(const Real3 &a, const Real3 &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Two spheres in the middle of a cube, or one above a plate.
class NearSpheres {
 public:
  explicit NearSpheres(const Setting &setting) :
      setting_(setting), grid_(grid()), centres_(centres()),
      scene_(grid_, even(grid_, {1, 1, ranks()}), setting.kernel, bodies(), false, 1e-4,
             setting.kind)
  {
  }

  /// The force on the fluid over 6 pi a U, or the torque over 8 pi a^3 times the angular velocity.
  double resistance(const Motion &motion)
  {
    const auto velocity = [&](int body, const Real3 &x) {
      Real3 along{0, 0, 0};
      along[motion.axis] = sense(body, motion);
      if (!motion.turns) return along;
      return cross(along,
                   {x[0] - centres_[body][0], x[1] - centres_[body][1], x[2] - centres_[body][2]});
    };
    const auto outcome = scene_.attempt(no_force, velocity);
    solves_ = outcome.solves;
    converged_ = outcome.converged;
    const double a = setting_.radius;
    if (!motion.turns) return sense(0, motion) * scene_.force(0)[motion.axis] / (6 * pi * a);
    return sense(0, motion) * scene_.torque(0, centres_[0])[motion.axis] / (8 * pi * a * a * a);
  }

  int solves() const { return solves_; }
  bool converged() const { return converged_; }

 private:
  Setting setting_;
  Grid grid_;
  std::vector<Real3> centres_;
  Scene scene_;
  int solves_ = 0;
  bool converged_ = false;

  Grid grid() const
  {
    const int wide = fast_size(static_cast<int>(12 * setting_.radius));
    const int high = setting_.plate ? fast_size(static_cast<int>(6 * setting_.radius)) : wide;
    return {{wide, wide, high}, {0, 0, 0}, {1, 1, 1}, setting_.plate};
  }

  std::vector<Real3> centres() const
  {
    const double x = grid_.cells[0] / 2 + middle_offset[0],
                 y = grid_.cells[1] / 2 + middle_offset[1], a = setting_.radius, gap = setting_.gap;
    if (setting_.plate) return {{x, y, a + gap}};
    const double z = grid_.cells[2] / 2 + 0.3;
    return {{x, y, z - a - gap / 2}, {x, y, z + a + gap / 2}};
  }

  std::vector<Points> bodies() const
  {
    const double behind = setting_.kind == MarkerKind::points ? surface_offset(setting_.kernel) : 0;
    std::vector<Points> spheres;
    for (const Real3 &centre : centres_)
      spheres.push_back(sphere(centre, setting_.radius - behind, 1.2));
    return spheres;
  }

  /// Two that turn the same way across the line slide past each other in the gap.
  static double sense(int body, const Motion &motion)
  {
    return body == 1 && !(motion.turns && motion.axis == 1) ? -1 : 1;
  }
};

void print(const Setting &setting)
{
  NearSpheres spheres(setting);
  for (const Motion &motion : motions) {
    const double found = spheres.resistance(motion);
    if (rank() != 0) continue;
    std::printf("%s,%s,%s,%s,%g,%g,%d,", setting.plate ? "plate" : "sphere", motion.name,
                setting.kernel == KernelKind::roma3 ? "roma3" : "peskin4",
                setting.kind == MarkerKind::points ? "points" : "sheets", setting.radius,
                setting.gap, spheres.solves());
    std::puts(spheres.converged() ? std::to_string(found).c_str() : "");
    std::fflush(stdout);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (rank() == 0)
    std::puts("near,motion,kernel,kind,radius_over_dx,gap_over_dx,solves,resistance");
  for (bool plate : {false, true})
    for (KernelKind kernel : {KernelKind::roma3, KernelKind::peskin4})
      for (MarkerKind kind : {MarkerKind::points, MarkerKind::sheets})
        for (double radius : {5.0, 10.0})
          for (double gap : {0.2, 0.5, 1.0, 2.0}) print({kernel, kind, radius, gap, plate});
  MPI_Finalize();
}
