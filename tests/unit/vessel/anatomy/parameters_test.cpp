#include "endowire/vessel/anatomy/parameters.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::vessel::anatomy {
namespace {

constexpr std::array table{
    Parameter{"wide_mm", "mm", 10.0, 6.0, 14.0, false, Trait::calibre, "", ""},
    Parameter{"narrow_mm", "mm", 3.0, 2.0, 4.0, false, Trait::calibre, "", ""},
    Parameter{"angle_deg", "deg", 50.0, 40.0, 80.0, false, Trait::own, "", ""},
    Parameter{"kind", "-", 1.0, 1.0, 3.0, true, Trait::own, "", ""},
};

std::string refused(const Settings& given) {
  return test::message_of<base::InputError>([&] { static_cast<void>(complete(table, given, "s.toml: p.")); });
}

TEST(Parameters, DefaultsFillWhatIsNotGiven) {
  const Values values = complete(table, {{"angle_deg", 60.0}}, "");
  EXPECT_EQ(values["wide_mm"], 10.0);
  EXPECT_EQ(values["angle_deg"], 60.0);
}

TEST(Parameters, BadNumbersAreRefusedByNameValueAndRange) {
  EXPECT_EQ(refused({{"wide_mm", 14.5}}), "s.toml: p.wide_mm is 14.5; must be between 6 and 14");
  EXPECT_EQ(refused({{"wide_mm", std::nan("")}}), "s.toml: p.wide_mm is nan; must be between 6 and 14");
  EXPECT_EQ(refused({{"kind", 1.5}}), "s.toml: p.kind is 1.5; must be a whole number between 1 and 3");
  EXPECT_EQ(refused({{"width", 1.0}}),
            "s.toml: p.width is unknown; known here: wide_mm, narrow_mm, angle_deg, kind");
}

TEST(Parameters, DrawsLieInTheirRangesAndFollowTheTrait) {
  constexpr int count = 4000;
  double sum = 0.0;
  double wide2 = 0.0;
  double narrow2 = 0.0;
  double both = 0.0;
  std::array<int, 4> kinds{};
  for (int seed = 0; seed < count; ++seed) {
    const Values v = drawn(table, {}, "", static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < table.size(); ++i) {
      EXPECT_GE(v.numbers()[i], table[i].low);
      EXPECT_LE(v.numbers()[i], table[i].high);
    }
    const double wide = v["wide_mm"] - 10.0;
    const double narrow = v["narrow_mm"] - 3.0;
    sum += wide;
    wide2 += wide * wide;
    narrow2 += narrow * narrow;
    both += wide * narrow;
    ++kinds[static_cast<std::size_t>(v["kind"])];
  }
  EXPECT_NEAR(sum / count, 0.0, 0.1);
  EXPECT_NEAR(std::sqrt(wide2 / count), 2.0, 0.35);  // a quarter of the range, less what was cut off
  EXPECT_NEAR(both / std::sqrt(wide2 * narrow2), 0.72, 0.08);
  EXPECT_NEAR(kinds[1] / static_cast<double>(count), 0.6, 0.03);
  EXPECT_NEAR(kinds[2] / static_cast<double>(count), 0.2, 0.03);
  EXPECT_NEAR(kinds[3] / static_cast<double>(count), 0.2, 0.03);
}

TEST(Parameters, ASeedAlwaysGivesTheSameAndGivingOneLeavesTheOthers) {
  const Values a = drawn(table, {}, "", 7);
  EXPECT_EQ(a.numbers(), drawn(table, {}, "", 7).numbers());
  EXPECT_NE(a.numbers(), drawn(table, {}, "", 8).numbers());
  EXPECT_NE(a.numbers(), drawn(table, {}, "", 7, 1).numbers());
  const Values given = drawn(table, {{"wide_mm", 6.5}}, "", 7);
  EXPECT_EQ(given["wide_mm"], 6.5);
  EXPECT_EQ(given["narrow_mm"], a["narrow_mm"]);
  EXPECT_EQ(given["kind"], a["kind"]);
}

TEST(Parameters, TablesAreJoinedInOrder) {
  static constexpr auto both = joined(table, table);
  ASSERT_EQ(both.size(), 8U);
  EXPECT_STREQ(both[4].name, "wide_mm");
}

}  // namespace
}  // namespace endowire::vessel::anatomy
