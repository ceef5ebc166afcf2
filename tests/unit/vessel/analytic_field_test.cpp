#include "endowire/vessel/analytic_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "endowire/base/error.hpp"
#include "endowire/vessel/random.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

struct Case {
  std::string name;
  std::shared_ptr<AnalyticField> field;
};

class Analytic : public testing::TestWithParam<Case> {};

TEST_P(Analytic, GradientIsTheDerivativeAndHasLengthOne) {
  SplitMix random(1);
  int tested = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vector3d p(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-40, 40));
    const WallDistance w = GetParam().field->at(p);
    ASSERT_NEAR(w.gradient.norm(), 1.0, 1e-12);
    const double h = 1e-5;
    bool smooth = true;
    Vector3d difference;
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      const WallDistance ahead = GetParam().field->at(p + step);
      const WallDistance behind = GetParam().field->at(p - step);
      smooth = smooth && (ahead.gradient - behind.gradient).norm() < 1e-3;  // not across the medial axis
      difference[k] = (ahead.distance_mm - behind.distance_mm) / (2.0 * h);
    }
    if (!smooth) continue;
    ++tested;
    ASSERT_LT((difference - w.gradient).norm(), 1e-6) << p.transpose();
    // Walking down the gradient by φ reaches the wall.
    ASSERT_NEAR(GetParam().field->at(p - w.distance_mm * w.gradient).distance_mm, 0.0, 1e-9) << p.transpose();
  }
  EXPECT_GT(tested, 1500);
}

INSTANTIATE_TEST_SUITE_P(
    All, Analytic,
    testing::Values(
        Case{"sphere", std::make_shared<SphereField>(Vector3d(1, 2, 3), 9.0)},
        Case{"plane", std::make_shared<HalfSpaceField>(Vector3d(1, 2, 3), Vector3d(1, -1, 2), 5.0)},
        Case{"tube", std::make_shared<TubeField>(Vector3d(1, 2, 3), Vector3d(1, 2, 1), 4.0)},
        Case{"cone", std::make_shared<ConeField>(Vector3d(1, 2, 3), Vector3d(0, 1, 1), 0.3)},
        Case{"torus", std::make_shared<TorusField>(Vector3d(1, 2, 3), Vector3d(0, 1, 2), 25.0, 4.0)},
        Case{"bent tube", std::make_shared<BentTubeField>(Vector3d(1, 2, 3), Vector3d(1, 0, 1),
                                                          Vector3d(0, 1, 0), 15.0, 2.0, 3.0)}),
    [](const auto& instance) {
      std::string name = instance.param.name;
      for (char& c : name)
        if (c == ' ') c = '_';
      return name;
    });

TEST(BentTube, FollowsItsCentreline) {
  const double angle = 0.5 * std::numbers::pi;
  const BentTubeField tube(Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), 20.0, angle, 3.0);
  EXPECT_LT((tube.centreline_mm(-5.0) - Vector3d(-5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((tube.centreline_mm(20.0 * angle) - Vector3d(20, 20, 0)).norm(), 1e-12);
  EXPECT_LT((tube.centreline_mm(20.0 * angle + 7.0) - Vector3d(20, 27, 0)).norm(), 1e-12);
  for (double s = -10.0; s < 50.0; s += 0.7) {
    EXPECT_NEAR(tube.at(tube.centreline_mm(s)).distance_mm, 3.0, 1e-12) << s;
    EXPECT_NEAR(tube.at(tube.centreline_mm(s) + Vector3d(0, 0, 2.0)).distance_mm, 1.0, 1e-12) << s;
    EXPECT_LT(((tube.centreline_mm(s + 1e-6) - tube.centreline_mm(s - 1e-6)) / 2e-6 - tube.tangent(s)).norm(),
              1e-6);
  }
}

TEST(Analytic, RefusesImpossibleShapes) {
  EXPECT_THROW(SphereField(Vector3d::Zero(), -1.0), base::InputError);
  EXPECT_THROW(TubeField(Vector3d::Zero(), Vector3d::Zero(), 1.0), base::InputError);
  EXPECT_THROW(TorusField(Vector3d::Zero(), Vector3d::UnitZ(), 2.0, 3.0), base::InputError);
  EXPECT_THROW(ConeField(Vector3d::Zero(), Vector3d::UnitZ(), 2.0), base::InputError);
}

}  // namespace
}  // namespace endowire::vessel
