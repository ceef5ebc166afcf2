// V1–V5: large deflections of a rod under dead loads, against the elastica. Tolerances: 0.1 % at 100 rods, 1e-8 where
// a closed form exists for the chain itself; second order in the rod length (V16).
#include <gtest/gtest.h>

#include <numbers>

#include "cases/cases.hpp"
#include "support/closed_forms.hpp"
#include "support/expect_checks.hpp"

namespace endowire::test {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Published figures, seven digits: they hold our own quadrature and shooting.
TEST(ClosedForms, TipLoadedCantileverAgreesWithThePublishedTable) {
  struct Row {
    double alpha, tip_deg, deflection, shortening;
  };
  for (const Row& row : {Row{0.25, 7.12143, 0.0827459, 0.0041178}, Row{1, 26.43352, 0.3017208, 0.0564332},
                         Row{2, 44.79097, 0.4934575, 0.1606417}, Row{5, 69.63546, 0.7137915, 0.3876284},
                         Row{10, 81.94932, 0.8106090, 0.5549956}}) {
    const ElasticaEnd end = tip_loaded_elastica(row.alpha);
    EXPECT_NEAR(end.tip_angle_rad * kDegrees, row.tip_deg, 1e-5);
    EXPECT_NEAR(end.deflection, row.deflection, 1e-7);
    EXPECT_NEAR(end.shortening, row.shortening, 1e-7);
  }
}

TEST(ClosedForms, SelfWeightAgreesWithTheTable) {
  EXPECT_NEAR(self_weight_elastica(1).deflection, 0.1234714, 1e-7);
  EXPECT_NEAR(self_weight_elastica(4).deflection, 0.4251593, 1e-7);
  EXPECT_NEAR(self_weight_elastica(8).deflection, 0.6406307, 1e-7);
  EXPECT_NEAR(self_weight_elastica(16).deflection, 0.7970196, 1e-7);
  EXPECT_NEAR(self_weight_elastica(32).deflection, 0.8784569, 1e-7);
}

TEST(ClosedForms, PostBucklingAgreesWithTheTable) {
  struct Row {
    double end_deg, load, span, deflection;
  };
  for (const Row& row :
       {Row{30, 1.0351207, 0.9324322, 0.1619500}, Row{60, 1.1517196, 0.7410196, 0.2966038},
        Row{90, 1.3932039, 0.4569466, 0.3813799}, Row{120, 1.8848009, 0.1231600, 0.4015855}}) {
    const PostBuckling column = post_buckling(row.end_deg / kDegrees);
    EXPECT_NEAR(column.load, row.load, 1e-7);
    EXPECT_NEAR(column.span, row.span, 1e-7);
    EXPECT_NEAR(column.deflection, row.deflection, 1e-7);
  }
}

TEST(V1TipLoadedCantilever, AgreesWithTheElastica) {
  expect_to_hold(tip_loaded_cantilever(kRods));
}
TEST(V2SelfWeightCantilever, AgreesWithTheElastica) {
  expect_to_hold(self_weight_cantilever(kRods));
}
TEST(V3RollUp, ClosesExactlyAndFollowsTheCircle) {
  expect_to_hold(roll_up(kRods));
}
TEST(V4EulerColumn, BucklesAtTheEulerLoad) {
  expect_to_hold(euler_column(kRods));
}
TEST(V5BuckledColumn, AgreesWithTheElastica) {
  expect_to_hold(buckled_column(kRods));
}

// 25 → 50 → 100 → 200 rods.
template <typename Case>
void expect_second_order_of(Case run, double allowed_order_error, double floor) {
  Checks coarse = run(25);
  for (const int rods : {50, 100, 200}) {
    Checks fine = run(rods);
    expect_second_order(coarse, fine, allowed_order_error, floor);
    coarse = std::move(fine);
  }
}

TEST(V16OrderOfConvergence, IsTwoForTheTipLoadedCantilever) {
  expect_second_order_of(tip_loaded_cantilever, 0.1, 1e-6);
}
TEST(V16OrderOfConvergence, IsTwoForTheSelfWeightCantilever) {
  expect_second_order_of(self_weight_cantilever, 0.1, 1e-6);
}

// The exact lines of the roll-up have no error to fall; the arc has.
TEST(V16OrderOfConvergence, IsTwoForTheRollUp) {
  expect_second_order_of(roll_up, 0.1, 1e-6);
}

// A joint must stand in the middle: an even number of rods.
template <typename Case>
void expect_second_order_of_even(Case run) {
  Checks coarse = run(26);
  for (const int rods : {52, 104, 208}) {
    Checks fine = run(rods);
    expect_second_order(coarse, fine, 0.1, 1e-6);
    coarse = std::move(fine);
  }
}

TEST(V16OrderOfConvergence, IsTwoForTheBuckledColumn) {
  expect_second_order_of_even(buckled_column);
}
TEST(V16OrderOfConvergence, IsTwoForTheThreePointBend) {
  expect_second_order_of_even(three_point_bend);
}

}  // namespace
}  // namespace endowire::test
