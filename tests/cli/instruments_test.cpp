// endowire instruments, as a user types it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.hpp"
#include "cli/vessels.hpp"

namespace endowire {
namespace {

using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The cells of a table whose columns two blanks or more divide.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t end = line.find("  ", at);
    if (end != at) cells.push_back(line.substr(at, end == std::string::npos ? end : end - at));
    at = line.find_first_not_of(' ', end);
  }
  return cells;
}

TEST(Instruments, ListsTheLibraryAsAnAlignedTable) {
  const TemporaryFolder folder;
  const Outcome list = run_endowire(folder, {"instruments"});
  EXPECT_EQ(list.code, 0);
  const std::vector<std::string> lines = lines_of(list.out);
  ASSERT_GE(lines.size(), 32U);
  const std::vector<std::string> headings{"model",           "diameter mm",      "length cm",
                                          "EI at tip N mm2", "EI at hand N mm2", "description"};
  EXPECT_EQ(cells_of(lines[0]), headings) << "every number under its name and unit";
  const std::size_t column = lines[0].find("description");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(cells_of(lines[i]).size(), headings.size()) << lines[i];
    ASSERT_GT(lines[i].size(), column) << lines[i];
    EXPECT_EQ(lines[i][column - 1], ' ') << lines[i];
    EXPECT_NE(lines[i][column], ' ') << lines[i];
    // Numbers end under the ends of their headings.
    for (std::size_t h = 1; h + 1 < headings.size(); ++h) {
      const std::size_t end = lines[0].find(headings[h]) + headings[h].size();
      EXPECT_NE(lines[i][end - 1], ' ') << lines[i];
      EXPECT_EQ(lines[i][end], ' ') << lines[i];
    }
  }
  const auto stiff = std::find_if(lines.begin(), lines.end(),
                                  [](const auto& line) { return line.starts_with("stiff_035_158gpa"); });
  ASSERT_NE(stiff, lines.end());
  EXPECT_EQ(cells_of(*stiff),
            (std::vector<std::string>{"stiff_035_158gpa", "0.889", "260", "8", "4857",
                                      "0.035 inch stiff wire, 260 cm, flexural modulus 158.4 GPa"}));
}

// Breaks when a column has a fixed width: the axial rigidities of a transition are longer than their heading.
TEST(Instruments, SectionsOfAnInstrumentStandInColumns) {
  const TemporaryFolder folder;
  for (const char* const name : {"hydrophilic_035_angled", "coronary_014_floppy", "simmons_6f"}) {
    const std::vector<std::string> lines = lines_of(run_endowire(folder, {"instruments", name}).out);
    const auto head = std::find_if(lines.begin(), lines.end(), [](const auto& line) {
      return line.find("from mm") != std::string::npos;
    });
    ASSERT_NE(head, lines.end());
    int rows = 0;
    for (auto row = head + 1; row != lines.end() && !row->empty(); ++row, ++rows) {
      EXPECT_EQ(row->size(), head->size()) << *row;
      EXPECT_EQ(row->find('e'),
                row->find("none") == std::string::npos ? std::string::npos : row->find("none") + 3)
          << "a power of ten: " << *row;
      EXPECT_EQ(cells_of(row->substr(row->find_first_not_of(' '))).size(), 10U) << *row;
    }
    EXPECT_GT(rows, 1) << name;
  }
}

TEST(Instruments, ShowsSectionsStiffnessShapeAndSources) {
  const TemporaryFolder folder;
  const Outcome one = run_endowire(folder, {"instruments", "hydrophilic_035_angled"});
  EXPECT_EQ(one.code, 0);
  for (const char* const part : {"EI N mm2", "6..27.59", "EI [N mm2] from the tip to the hand",
                                 "unloaded end", "section[0].rest_curvature_per_mm", "estimate: "})
    EXPECT_NE(one.out.find(part), std::string::npos) << part;
}

TEST(Instruments, JsonOfTheLibraryAndOfOne) {
  const TemporaryFolder folder;
  const nlohmann::json list = nlohmann::json::parse(run_endowire(folder, {"instruments", "--json"}).out);
  ASSERT_GE(list.size(), 30U);
  for (const nlohmann::json& one : list) {
    EXPECT_GT(one["shaft_flexural_rigidity_n_mm2"], 0.0);
    EXPECT_GT(one["length_mm"], 500.0);
  }
  const nlohmann::json one =
      nlohmann::json::parse(run_endowire(folder, {"instruments", "stiff_035_017gpa", "--json"}).out);
  EXPECT_EQ(one["profile"].size(), 200U);
  EXPECT_NEAR(one["profile"].back()["flexural_rigidities_n_mm2"][0].get<double>(), 521.2, 0.1);
  EXPECT_GT(one["values"].size(), 20U);
  EXPECT_GT(one["unloaded_end_mm"].size(), 100U);
}

TEST(Instruments, DrawsAPictureOfOne) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_endowire(folder, {"instruments", "pigtail_5f", "--picture", "p.svg"}).code, 0);
  const std::string svg = test::read_text(folder / "p.svg");
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_NE(svg.find("pigtail_5f"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const Outcome other = run_endowire(folder, {"instruments", "pigtail_5f", "--picture", "p.gif"});
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.err, "instruments: --picture is \"p.gif\"; must end in .svg\n");
  EXPECT_EQ(run_endowire(folder, {"instruments", "--picture", "p.svg"}).code, 2);
}

TEST(Instruments, AFileOfOnesOwnIsShownOrRefusedInOneLine) {
  const TemporaryFolder folder;
  std::string text = test::read_text(std::string(ENDOWIRE_SOURCE_DIR) + "/instruments/angled_4f.toml");
  test::write_text(folder / "own.toml", text);
  EXPECT_EQ(run_endowire(folder, {"instruments", "own.toml"}).code, 0);
  const std::string bore = "bore_mm = { value = 0.95";
  ASSERT_NE(text.find(bore), std::string::npos);
  text.replace(text.find(bore), bore.size(), "bore_mm = { value = -1");
  test::write_text(folder / "own.toml", text);
  const Outcome bad = run_endowire(folder, {"instruments", "own.toml"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_EQ(bad.err, "own.toml: section[0].bore_mm.value is -1; must be between 0 and 1.3334\n");
}

// The hand rests with the border between the middle and the shaft, which is four times stiffer, just at the end of the sheath, and turns.
// Breaks when compliance jumps there: the steps that turn then do not converge.
TEST(Instruments, ABorderOfSectionsMayRestAtTheEndOfTheSheath) {
  const TemporaryFolder folder;
  test::write_text(folder / "s.toml", R"(schema = 1
[vessel]
generate = "aortic_arch"
[[instrument]]
model = "microcatheter_021"
[[motion]]
duration_s = 10.0
hands = [{ instrument = 1, advance_mm = 400.0, torque_deg = 0.0 }]
[[motion]]
duration_s = 1.0
hands = [{ instrument = 1, advance_mm = 0.0, torque_deg = 30.0 }]
)");
  const Outcome outcome =
      run_endowire(folder, {"simulate", "s.toml", "--out", "o", "--cache", test::test_cache(), "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(test::read_text(folder / "o/summary.json"));
  EXPECT_EQ(summary["converged_steps"], 403);
  EXPECT_NEAR(summary["instruments"][0]["inserted_length_mm"].get<double>(), 400.0, 1e-3);
}

}  // namespace
}  // namespace endowire
