// What an aortic arch is for: its types, its variant, its landmarks.

#include <gtest/gtest.h>

#include "endowire/vessel/generate.hpp"
#include "support/measured_vessel.hpp"

namespace endowire::vessel {
namespace {

GeneratedVessel arch(const anatomy::Settings& settings) {
  GenerateRequest request;
  request.name = "aortic_arch";
  request.settings = settings;
  return generate(request);
}

double height(const GeneratedVessel& made, const std::string& mark) {
  for (const Landmark& landmark : made.landmarks)
    if (landmark.name == mark) return landmark.position_mm.z();
  throw std::runtime_error("no landmark " + mark);
}

TEST(AorticArch, TheTrunkComesLowerFromTypeToType) {
  double last = 1e9;
  for (const double type : {1.0, 2.0, 3.0}) {
    const GeneratedVessel made = arch({{"arch_type", type}});
    const double trunk = height(made, "brachiocephalic ostium") - height(made, "left subclavian ostium");
    EXPECT_LT(trunk, last - 2.0) << type;
    last = trunk;
  }
}

TEST(AorticArch, ABovineCarotidLeavesTheTrunk) {
  const GeneratedVessel made = arch({{"bovine", 1.0}});
  const test::MeasuredVessel measured(made);
  const anatomy::Branch& carotid = measured.branch("left carotid artery");
  EXPECT_EQ(measured.parent_of(carotid).name, "brachiocephalic to right carotid artery");
  const double above = carotid.parent_arc_mm - measured.parent_of(carotid).ostium_arc_mm;
  EXPECT_GT(above, 5.0);
  EXPECT_LT(above, 25.0);
}

TEST(AorticArch, CarotidsAreLongAndTheRouteReachesTheArch) {
  for (const double type : {1.0, 2.0, 3.0})
    for (const double bovine : {0.0, 1.0}) {
      const GeneratedVessel made = arch({{"arch_type", type}, {"bovine", bovine}});
      const test::MeasuredVessel measured(made);
      EXPECT_GT(measured.length("left carotid artery"), 130.0);
      EXPECT_GT(measured.between("brachiocephalic division", "right carotid end"), 130.0);
      EXPECT_GT(made.route_mm, 400.0);
      EXPECT_LT(made.route_mm, 520.0);
      EXPECT_NEAR(
          made.route_mm,
          measured.arc("access") - measured.branch("brachiocephalic to right carotid artery").parent_arc_mm,
          1e-9);
      EXPECT_LT(made.access_direction.z(), 1.0);
      EXPECT_GT(made.access_direction.z(), 0.5);  // to the head
    }
}

TEST(AorticArch, AngleOfABranchMayBeGivenForAnyType) {
  const GeneratedVessel made = arch({{"arch_type", 3.0}, {"brachiocephalic_take_off_deg", 58.0}});
  EXPECT_NEAR(test::MeasuredVessel(made).take_off_deg("brachiocephalic to right carotid artery"), 58.0, 1.0);
  const GeneratedVessel usual = arch({{"arch_type", 3.0}});
  EXPECT_NEAR(test::MeasuredVessel(usual).take_off_deg("brachiocephalic to right carotid artery"), 45.0, 1.0);
}

}  // namespace
}  // namespace endowire::vessel
