#include "endowire/io/text_table.hpp"

#include <gtest/gtest.h>

namespace endowire::io {
namespace {

// Breaks when a width is fixed, when bytes are counted for characters, or when blanks are left behind the last column.
TEST(TextTable, ColumnsAreAsWideAsTheirLongestCell) {
  TextTable table({{"name", TextTable::Align::left}, {"EI N mm2"}, {"what", TextTable::Align::left}});
  table.add({"a", "6 … 400", "short"});
  table.add({"a much longer name", "196.8 … 1553000", "x"});
  EXPECT_EQ(table.text(),
            "name                       EI N mm2  what\n"
            "a                           6 … 400  short\n"
            "a much longer name  196.8 … 1553000  x\n");
}

TEST(TextTable, WithoutRowsThereAreHeadings) {
  EXPECT_EQ(TextTable({{"a"}, {"b", TextTable::Align::left}}).text(), "a  b\n");
}

}  // namespace
}  // namespace endowire::io
