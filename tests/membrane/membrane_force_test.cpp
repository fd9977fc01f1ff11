// Forces: minus the gradient of the energy, balanced, none at rest, turning with the cell.

#include "test_support.h"

using namespace test;

namespace {

class MembraneForce : public testing::TestWithParam<std::string> {
 protected:
  const rbc::SurfaceTemplate shape_ = disc(4).surface();
  const Vertices x_ = waved(shape_.vertices, 11);
  rbc::MembraneModel model_{shape_, each_energy().at(GetParam())};
};

TEST_P(MembraneForce, IsMinusTheGradientOfTheEnergy)
{
  const Result result = evaluate(model_, shape_, x_);
  Vertices x = x_, expected(x.size());
  const double step = 2e-4;
  for (std::size_t v = 0; v < x.size(); ++v)
    for (int d = 0; d < 3; ++d) {
      const auto energy = [&](double change) {
        x[v][d] = x_[v][d] + change;
        return evaluate(model_, shape_, x).energy.total();
      };
      const double near = energy(step) - energy(-step), far = energy(2 * step) - energy(-2 * step);
      x[v][d] = x_[v][d];
      expected[v][d] = -(8 * near - far) / (12 * step);
    }
  double largest = 0;
  for (const Vec3 &f : expected) largest = std::max(largest, f.norm());
  EXPECT_GT(largest, 0.01) << "the deformation must load every vertex well above round-off";
  EXPECT_LT(largest_difference(result.force, expected), 1e-8 * largest);
}

TEST_P(MembraneForce, HasNoSumAndNoTorque)
{
  const Vertices force = evaluate(model_, shape_, x_).force;
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  for (std::size_t v = 0; v < x_.size(); ++v) {
    sum += force[v];
    torque += x_[v].cross(force[v]);
  }
  EXPECT_LT(sum.norm(), 1e-14 * total_norm(force));
  EXPECT_LT(torque.norm(), 1e-14 * total_norm(force));
}

TEST_P(MembraneForce, TurnsWithTheCell)
{
  Random random(5);
  const Matrix3 turn = random.rotation();
  const Vec3 shift = random.vector(-2, 2);
  const Result result = evaluate(model_, shape_, x_);
  const Result turned = evaluate(
      model_, shape_, transformed(x_, [&](const Vec3 &x) { return Vec3(turn * x + shift); }));
  const Vertices expected =
      transformed(result.force, [&](const Vec3 &f) { return Vec3(turn * f); });
  EXPECT_LT(largest_difference(turned.force, expected), 1e-13 * total_norm(expected));
  EXPECT_NEAR(turned.energy.total(), result.energy.total(), 1e-13 * result.energy.total());
  EXPECT_NEAR(turned.size.area, result.size.area, 1e-13 * result.size.area);
  EXPECT_NEAR(turned.size.volume, result.size.volume, 1e-13 * result.size.volume);
}

INSTANTIATE_TEST_SUITE_P(, MembraneForce, testing::ValuesIn(names_of_energies()), test_name);

TEST(StressFreeShape, HasNoForcesWhereverItStands)
{
  const rbc::SurfaceTemplate shape = disc(4).surface();
  Random random(9);
  const Matrix3 turn = random.rotation();
  const Vec3 shift = random.vector(-2, 2);
  const Vertices moved =
      transformed(shape.vertices, [&](const Vec3 &x) { return Vec3(turn * x + shift); });
  for (const auto &[name, parameters] : each_energy()) {
    if (!parameters.reference_curvature) continue;    // bent at rest
    SCOPED_TRACE(name);
    const Result result = evaluate(shape, parameters, moved);
    const Result loaded = evaluate(shape, parameters, waved(shape.vertices, 11));
    EXPECT_LT(total_norm(result.force), 1e-12 * total_norm(loaded.force));
    EXPECT_NEAR(result.energy.total(), 0, 1e-13 * loaded.energy.total());
  }
}

}    // namespace
