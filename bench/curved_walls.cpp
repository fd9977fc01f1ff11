// Errors of flows along and around curved walls of markers: points, behind the wall by the offset
// of a plane, and sheets, on it. Writes a table.

#include "curved_walls.h"

#include <cstdio>

using namespace test;

namespace {

struct Wall {
  KernelKind kernel;
  MarkerKind kind;

  /// How far behind the wall the markers are.
  double behind() const { return kind == MarkerKind::points ? surface_offset(kernel) : 0; }
};

void print(const char *setting, double parameter, const Wall &wall, double radius, double error)
{
  if (rank() != 0) return;
  std::printf("%s,%g,%s,%s,%.2f,%.3f\n", setting, parameter,
              wall.kernel == KernelKind::roma3 ? "roma3" : "peskin4",
              wall.kind == MarkerKind::points ? "points" : "sheets", radius, 100 * error);
  std::fflush(stdout);
}

void arrays(const Wall &wall)
{
  for (const auto &[share, reference] : zick_homsy)
    for (double wanted : {3.7, 7.4, 14.9}) {
      const int n = static_cast<int>(std::lround(wanted / share));
      const double radius = share * n;
      const double found = array(wall.kernel, radius, radius - wall.behind(), n, wall.kind);
      print("array", 4 * pi / 3 * std::pow(share, 3), wall, radius, found / reference - 1);
    }
}

void tubes(const Wall &wall)
{
  for (bool everywhere : {false, true})
    for (double radius : {7.0, 14.0, 28.0})
      print("tube", everywhere, wall, radius,
            poiseuille(wall.kernel, radius, wall.kind, everywhere).rate);
}

void spheres_in_tubes(const Wall &wall)
{
  for (const auto &[share, k1, k2] : tube_factors)
    for (double radius : {8.0, 16.0, 32.0}) {
      if (share < 0.2) continue;
      const TubeAndSphere wanted{radius, share * radius};
      const TubeFactors found =
          found_factors(wall.kernel, wall.kind, 5 * radius, wanted,
                        {wanted.tube + wall.behind(), wanted.sphere - wall.behind()});
      print("sphere in tube", share, wall, radius, found.k2 / k2 - 1);
    }
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (rank() == 0) std::puts("setting,parameter,kernel,kind,radius_over_dx,error_percent");
  for (KernelKind kernel : {KernelKind::roma3, KernelKind::peskin4})
    for (MarkerKind kind : {MarkerKind::points, MarkerKind::sheets}) {
      arrays({kernel, kind});
      tubes({kernel, kind});
      spheres_in_tubes({kernel, kind});
    }
  MPI_Finalize();
}
