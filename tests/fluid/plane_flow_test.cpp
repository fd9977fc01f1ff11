// Plane flows between plates that start or oscillate, against their exact solutions.

#include "flow_support.h"
#include "fluid/diagnostics.h"

#include <complex>
#include <functional>

using namespace test;

namespace {

constexpr double height = 0.8, viscosity = 0.1, density = 1.3, nu = viscosity / density;
constexpr double omega = 4;

using Profile = std::function<double(double z, double t)>;

/// Error of the velocity along x after n steps from time 0, on a grid with n cells from plate to
/// plate.
double error(int n, double duration, const Profile &exact,
             const std::function<Forcing(double t)> &forcing,
             const PlateConditions &conditions = {})
{
  const Grid grid{{4, 4, n}, {0, 0, 0}, {0.1, 0.1, height / n}, true, conditions};
  ForcedFlow flow(grid, even(grid, {1, 1, ranks()}), 0,
                  FlowEquations{viscosity, density, Inertia::unsteady});
  flow.set_velocity([&](int c, int i, int j, int k) {
    return c == 0 ? exact(location(grid, c, i, j, k)[2], 0) : 0;
  });
  flow.forcing = forcing(0);
  for (int step = 1; step <= n; ++step) step_to(flow, duration / n, forcing(step * duration / n));
  Error error;
  for_each(flow.brick(), [&](int i, int j, int k) {
    error.add(flow.velocity()[0](i, j, k) - exact(location(grid, 0, i, j, k)[2], duration));
  });
  return error.over_ranks().rms();
}

/// The upper plate starts at once: u = z/H + sum of 2 (-1)^n / (n pi) sin(n pi z/H) exp(-(n pi/H)^2
/// nu t).
TEST(PlaneFlow, OfAPlateThatStartsAtOnceIsOfSecondOrder)
{
  const Profile exact = [](double z, double t) {
    if (t == 0) return 0.0;
    double u = z / height;
    for (int n = 1; n < 100; ++n) {
      const double k = n * pi / height;
      u += 2 * (n % 2 ? -1 : 1) / (n * pi) * std::sin(k * z) * std::exp(-k * k * nu * t);
    }
    return u;
  };
  const auto forcing = [](double) { return Forcing{{{0, 0, 0}, {1, 0, 0}}, {}, {}}; };
  const double duration = 0.1 * height * height / nu;
  EXPECT_NEAR(order(error(32, duration, exact, forcing), error(64, duration, exact, forcing)), 2,
              0.05);
}

/// lambda^2 = i omega / nu
std::complex<double> lambda()
{
  return std::sqrt(std::complex<double>(0, omega / nu));
}

/// Stokes's second problem with a plate at rest above.
TEST(PlaneFlow, OfAnOscillatingPlateIsOfSecondOrder)
{
  const Profile exact = [](double z, double t) {
    return (std::sinh(lambda() * (height - z)) / std::sinh(lambda() * height) *
            std::polar(1.0, omega * t))
        .real();
  };
  const auto forcing = [](double t) { return Forcing{{{std::cos(omega * t), 0, 0}, {}}, {}, {}}; };
  EXPECT_NEAR(order(error(32, 1, exact, forcing), error(64, 1, exact, forcing)), 2, 0.05);
}

/// Stokes's second problem below a plate without shear.
TEST(PlaneFlow, OfAnOscillatingPlateBelowOneThatSlipsIsOfSecondOrder)
{
  const Profile exact = [](double z, double t) {
    return (std::cosh(lambda() * (height - z)) / std::cosh(lambda() * height) *
            std::polar(1.0, omega * t))
        .real();
  };
  const auto forcing = [](double t) { return Forcing{{{std::cos(omega * t), 0, 0}, {}}, {}, {}}; };
  const PlateConditions conditions{PlateCondition::no_slip, PlateCondition::free_slip};
  const double coarse = error(32, 1, exact, forcing, conditions);
  EXPECT_NEAR(order(coarse, error(64, 1, exact, forcing, conditions)), 2, 0.05);
}

/// Womersley's flow between plates.
TEST(PlaneFlow, OfAnOscillatingForceIsOfSecondOrder)
{
  const Profile exact = [](double z, double t) {
    const auto shape =
        1.0 - std::cosh(lambda() * (z - height / 2)) / std::cosh(lambda() * (height / 2));
    return (shape * std::polar(1.0, omega * t) / std::complex<double>(0, density * omega)).real();
  };
  const auto forcing = [](double t) { return Forcing{{}, {std::cos(omega * t), 0, 0}, {}}; };
  EXPECT_NEAR(order(error(32, 1, exact, forcing), error(64, 1, exact, forcing)), 2, 0.05);
}

}    // namespace
