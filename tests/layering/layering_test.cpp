#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numeric>

#include "includes.hpp"

namespace endowire::tests {
namespace {

namespace fs = std::filesystem;

std::string lines_of(const LayeringReport& report) {
  return std::accumulate(report.violations.begin(), report.violations.end(), std::string(),
                         [](const std::string& all, const std::string& one) { return all + one + "\n"; });
}

TEST(Layering, NoLayerIncludesOneAboveOrBesideIt) {
  const LayeringReport report = read_includes(ENDOWIRE_SOURCE_DIR);
  EXPECT_GT(report.files, 30);  // it did read the tree
  EXPECT_GT(report.includes, 100);
  EXPECT_TRUE(report.violations.empty()) << lines_of(report);
}

/// A tree with one file; the test of the test.
class PlantedInclude : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("endowire_layering_" + std::to_string(::getpid()));
    fs::create_directories(root_ / "src" / "endowire");
  }
  void TearDown() override { fs::remove_all(root_); }
  [[nodiscard]] std::string violations(const std::string& file, const std::string& line) const {
    const fs::path path = root_ / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "#pragma once\n" << line << "\n";
    const std::string found = lines_of(read_includes(root_));
    fs::remove(path);
    return found;
  }
  fs::path root_;
};

TEST_F(PlantedInclude, UpwardIsFound) {
  EXPECT_EQ(violations("src/endowire/rod/a.hpp", "#include \"endowire/sim/simulation.hpp\""),
            "src/endowire/rod/a.hpp:2: rod must not include sim (endowire/sim/simulation.hpp)\n");
  EXPECT_NE(violations("src/endowire/base/a.cpp", "  #  include  \"endowire/math/b.hpp\"  // why"), "");
  EXPECT_NE(violations("src/endowire/sim/a.cpp", "#include <endowire/io/file.hpp>"), "");
}

TEST_F(PlantedInclude, SiblingIsFound) {
  EXPECT_NE(violations("src/endowire/vessel/a.hpp", "#include \"endowire/rod/chain.hpp\""), "");
  EXPECT_NE(violations("src/endowire/rod/a.hpp", "#include \"endowire/solve/newton.hpp\""), "");
}

TEST_F(PlantedInclude, LibraryBelowIoIsFound) {
  EXPECT_NE(violations("src/endowire/sim/a.cpp", "#include <nlohmann/json.hpp>"), "");
  EXPECT_NE(violations("src/endowire/vessel/a.cpp", "#include <vtkPolyData.h>"), "");
  EXPECT_NE(violations("src/endowire/math/a.cpp", "#include <unistd.h>"), "");
}

TEST_F(PlantedInclude, ThreadsOutsideTheBatchAreFound) {
  EXPECT_NE(violations("src/endowire/sim/a.cpp", "#include <oneapi/tbb/parallel_for.h>"), "");
  EXPECT_EQ(violations("src/endowire/batch/a.cpp", "#include <oneapi/tbb/parallel_for.h>"), "");
  EXPECT_NE(violations("src/endowire/batch/a.cpp", "#include <fmt/format.h>"), "");
  EXPECT_NE(violations("src/endowire/batch/a.cpp", "#include \"endowire/io/file.hpp\""), "");
  EXPECT_NE(violations("src/endowire/io/a.cpp", "#include \"endowire/batch/batch.hpp\""), "");
  EXPECT_NE(violations("src/endowire/sim/a.cpp", "#include \"endowire/batch/batch.hpp\""), "");
}

TEST_F(PlantedInclude, NameThatHidesItsLayerIsFound) {
  EXPECT_NE(violations("src/endowire/rod/a.cpp", "#include \"../sim/simulation.hpp\""), "");
}

TEST_F(PlantedInclude, SimulatorInTheJudgeIsFound) {
  EXPECT_NE(violations("tools/check_crossings/a.cpp", "#include \"endowire/vessel/mesh.hpp\""), "");
}

TEST_F(PlantedInclude, FolderThatIsNoLayerIsFound) {
  EXPECT_NE(violations("src/endowire/misc/a.hpp", "#include <vector>"), "");
}

TEST_F(PlantedInclude, WhatIsAllowedIsNotReported) {
  EXPECT_EQ(violations("src/endowire/contact/a.cpp", "#include \"endowire/vessel/field.hpp\""), "");
  EXPECT_EQ(violations("src/endowire/rod/a.cpp", "#include <Eigen/Dense>"), "");
  EXPECT_EQ(violations("src/endowire/rod/a.cpp", "#include <cmath>"), "");
  EXPECT_EQ(violations("src/endowire/io/a.cpp", "#include <toml++/toml.h>"), "");
  EXPECT_EQ(violations("apps/cli/a.cpp", "#include \"endowire/io/file.hpp\""), "");
}

}  // namespace
}  // namespace endowire::tests
