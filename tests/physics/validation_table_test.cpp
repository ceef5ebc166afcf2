// docs/validation.md and its pictures are what the cases of physics give today.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "support/validation_table.hpp"
#include "validation.hpp"

namespace endowire::test {
namespace {

std::string committed(const std::string& name) {
  const std::string path = std::string(ENDOWIRE_SOURCE_DIR) + "/docs/" + name;
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ValidationTable, TheCommittedFilesAreThoseGenerated) {
  const std::vector<Section> sections = validation();
  EXPECT_EQ(table_difference(committed("validation.md"), validation_document(sections)), "")
      << "regenerate it: make validation";
  for (const Section& section : sections) {
    for (const Figure& figure : section.figures) {
      EXPECT_EQ(table_difference(committed("images/validation/" + figure.name + ".svg"), svg(figure)), "")
          << "regenerate " << figure.name << ": make validation";
    }
  }
}

TEST(ValidationTable, HasEveryTestOfTheSuite) {
  const std::string text = committed("validation.md");
  constexpr int kTests = 16;
  for (int test = 1; test <= kTests; ++test)
    EXPECT_NE(text.find("\n## V" + std::to_string(test) + " "), std::string::npos) << test;
}

TEST(ValidationTable, DiffersByMoreThanTheLastDigitOnlyWhenAValueDoes) {
  const Check check{"V0", "half [mm]", "1/2", 0.5, 0.5001, 1e-3, ErrorKind::relative, "nobody"};
  Check rounded = check;
  rounded.ours += 6e-6;
  Check changed = check;
  changed.ours += 1e-4;
  const std::string table = validation_table({check});
  EXPECT_NE(table.find("| half [mm] | 1/2 | 0.50000 | 0.50010 | 0.020 % |  | 0.1 % | nobody |"),
            std::string::npos)
      << table;
  EXPECT_EQ(table_difference(table, validation_table({rounded})), "");
  EXPECT_NE(table_difference(table, validation_table({changed})), "");
  EXPECT_NE(table_difference(table, validation_table({check, check})), "");
  EXPECT_NE(table_difference(validation_table({check, check}), table), "");
  Check ordered = check;
  ordered.order = 2.0;
  EXPECT_NE(validation_table({ordered}).find("0.020 % | 2.0 | 0.1 %"), std::string::npos);
  Check renamed = check;
  renamed.quantity = "half [cm]";
  EXPECT_NE(table_difference(table, validation_table({renamed})), "");
}

TEST(ValidationPicture, DiffersWhenAValueDoesAndRefusesWhatIsNoNumber) {
  Figure figure{
      "v0", "V0", "x", "y", {{Mark::line, {{0.0, 0.0}, {1.0, 1.0}}, ""}, {Mark::rings, {{0.5, 0.5}}, ""}}};
  const std::string drawn = svg(figure);
  EXPECT_EQ(svg(figure), drawn);
  figure.series[1].points[0].y = 0.5003;  // less than a tenth of a pixel
  EXPECT_EQ(table_difference(drawn, svg(figure)), "");
  figure.series[1].points[0].y = 0.52;
  EXPECT_NE(table_difference(drawn, svg(figure)), "");
  figure.series[1].points[0].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(svg(figure)), std::invalid_argument);
}

}  // namespace
}  // namespace endowire::test
