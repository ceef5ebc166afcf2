// docs/validation.md is what the cases of physics give today.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "cases/cases.hpp"
#include "support/validation_table.hpp"

namespace endowire::test {
namespace {

TEST(ValidationTable, TheCommittedFileIsTheOneGenerated) {
  const std::string path = std::string(ENDOWIRE_SOURCE_DIR) + "/docs/validation.md";
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  std::ostringstream committed;
  committed << file.rdbuf();
  EXPECT_EQ(table_difference(committed.str(), validation_table(all_checks())), "")
      << "regenerate it: cmake --build <build folder> --target validation";
}

TEST(ValidationTable, DiffersByMoreThanTheLastDigitOnlyWhenAValueDoes) {
  const Check check{"V0", "half [mm]", "1/2", 0.5, 0.5001, 1e-3, ErrorKind::relative, "nobody"};
  Check rounded = check;
  rounded.ours += 6e-6;
  Check changed = check;
  changed.ours += 1e-4;
  const std::string table = validation_table({check});
  EXPECT_NE(table.find("| V0 | half [mm] | 1/2 | 0.50000 | 0.50010 | 0.020 % | 0.1 % | nobody |"),
            std::string::npos)
      << table;
  EXPECT_EQ(table_difference(table, validation_table({rounded})), "");
  EXPECT_NE(table_difference(table, validation_table({changed})), "");
  EXPECT_NE(table_difference(table, validation_table({check, check})), "");
  EXPECT_NE(table_difference(validation_table({check, check}), table), "");
  Check renamed = check;
  renamed.quantity = "half [cm]";
  EXPECT_NE(table_difference(table, validation_table({renamed})), "");
}

}  // namespace
}  // namespace endowire::test
