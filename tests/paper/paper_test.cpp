// docs/paper.md is what its experiments give today: where that can be seen in seconds.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "bends_section.hpp"
#include "support/validation_table.hpp"

namespace endowire::paper {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

const fs::path docs = fs::path(ENDOWIRE_SOURCE_DIR) / "docs";

TEST(Paper, EveryFigureIsThereAndEveryOneThereIsShown) {
  const std::string text = text_of(docs / "paper.md");
  const std::regex link(R"(\]\(images/paper/([a-z_]+\.svg)\))");
  std::set<std::string> shown;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) shown.insert((*it)[1]);
  std::set<std::string> there;
  for (const auto& entry : fs::directory_iterator(docs / "images" / "paper"))
    there.insert(entry.path().filename().string());
  EXPECT_GT(shown.size(), 4U);
  EXPECT_EQ(shown, there);
}

/// The line of a table that begins like another one.
std::string line_like(const std::string& text, const std::string& row) {
  std::size_t cells = 0;
  std::size_t length = 0;
  while (cells < 3)
    if (row[length++] == '|') ++cells;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.compare(0, length, row, 0, length) == 0) return line + "\n";
  return "";
}

class BendRow : public testing::TestWithParam<Bend> {};

TEST_P(BendRow, IsTheOneInTheDocument) {
  const std::string row = bend_row(GetParam());
  EXPECT_EQ(test::table_difference(line_like(text_of(docs / "paper.md"), row), row), "")
      << "regenerate it: make paper";
}

// One that short rods pass, and one that most do not.
INSTANTIATE_TEST_SUITE_P(Narrow, BendRow, testing::Values(Bend{10.0, 1.5}, Bend{5.0, 0.75}),
                         [](const auto& run) {
                           return "Radius" + std::to_string(static_cast<int>(run.param.radius_mm));
                         });

}  // namespace
}  // namespace endowire::paper
