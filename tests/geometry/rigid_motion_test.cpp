#include "geometry/rigid_motion.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using rbc::RigidFit;
using rbc::Vec3;

namespace {

struct Points {
  std::vector<Vec3> places, velocities;

  RigidFit fit() const
  {
    double sums[RigidFit::of_places] = {};
    for (const Vec3 &place : places) RigidFit::add_place(place, sums);
    return {sums, static_cast<int>(places.size())};
  }

  rbc::RigidMotion motion() const
  {
    const RigidFit fitted = fit();
    double sums[RigidFit::of_velocities] = {};
    for (std::size_t n = 0; n < places.size(); ++n)
      RigidFit::add_velocity(places[n] - fitted.centre, velocities[n], sums);
    return fitted.motion(sums, static_cast<int>(places.size()));
  }
};

Points cloud(int count)
{
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  Points points;
  for (int n = 0; n < count; ++n) {
    points.places.emplace_back(3 + normal(engine), 2 * normal(engine), 0.2 * normal(engine));
    points.velocities.emplace_back(normal(engine), normal(engine), normal(engine));
  }
  return points;
}

}    // namespace

TEST(RigidFit, GivesARigidMotionAsItIs)
{
  Points points = cloud(40);
  const Vec3 translation(0.3, -2, 1), rate(1, 0.5, -0.7);
  const Vec3 centre = points.fit().centre;
  for (std::size_t n = 0; n < points.places.size(); ++n)
    points.velocities[n] = translation + rate.cross(points.places[n] - centre);
  const auto found = points.motion();
  EXPECT_LT((found.translation - translation).norm(), 1e-13);
  EXPECT_LT((found.rate - rate).norm(), 1e-13);
}

TEST(RigidFit, LeavesNeitherMeanNorMoment)
{
  Points points = cloud(25);
  const auto found = points.motion();
  const Vec3 centre = points.fit().centre;
  Vec3 mean = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t n = 0; n < points.places.size(); ++n) {
    const Vec3 place = points.places[n] - centre, left = points.velocities[n] - found.at(place);
    mean += left;
    moment += place.cross(left);
  }
  EXPECT_LT(mean.norm(), 1e-12);
  EXPECT_LT(moment.norm(), 1e-12);
}
