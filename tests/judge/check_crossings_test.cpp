// The judge from outside: files in, verdict out. Depths are known in closed form: a wire of radius r parallel
// to the axis of a tube at distance e, moved towards a flat of the tube, stands e + r − R cos(π/n) outside.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tube_files.hpp"

namespace endowire::tests {
namespace {

using Eigen::Vector3d;

struct Outcome {
  int exit_code = -1;
  std::string output;
  nlohmann::json verdict;
};

Outcome run_judge(const std::string& arguments) {
  Outcome outcome;
  FILE* pipe = ::popen((std::string(ENDOWIRE_CHECK_CROSSINGS) + " " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), n);
  outcome.exit_code = WEXITSTATUS(::pclose(pipe));
  outcome.verdict = nlohmann::json::parse(outcome.output, nullptr, false);
  return outcome;
}

class CheckCrossings : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("endowire_judge_" + std::to_string(::getpid()) + "_" + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string stl() const { return (folder_ / "vessel.stl").string(); }
  [[nodiscard]] Outcome judge(const Triangles& vessel, const std::vector<RecordedAxis>& steps,
                              const std::string& flags = "") const {
    write_stl(folder_ / "vessel.stl", vessel);
    const auto pvd = write_recording(folder_, steps);
    return run_judge(pvd.string() + " " + stl() + " --json " + flags);
  }

  std::filesystem::path folder_;
  TubeMesh tube_;
};

Triangles turned(Triangles triangles) {
  for (auto& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

/// A wire parallel to the axis, moved by `offset_mm` towards the flat at +y.
RecordedAxis parallel_wire(double offset_mm) {
  return straight_wire({50.0, offset_mm, 0.0}, {5.0, offset_mm, 0.0}, 11);
}

TEST_F(CheckCrossings, WireInTheMiddleOfATubeNeverCrosses) {
  const Outcome o = judge(tube_.triangles(), {parallel_wire(0.0), parallel_wire(0.5)});
  EXPECT_EQ(o.exit_code, 0) << o.output;
  EXPECT_EQ(o.verdict["crossings"], 0);
  EXPECT_EQ(o.verdict["steps"], 2);
  EXPECT_GT(o.verdict["points"], 2 * 8 * 90);
  EXPECT_EQ(o.verdict["deepest"]["depth_mm"], 0.0);
}

TEST_F(CheckCrossings, WallThatGivesWayWithinTheLimitIsReportedButNoCrossing) {
  const double offset = tube_.flat_radius_mm() - 0.4 + 0.15;
  const Outcome o = judge(tube_.triangles(), {parallel_wire(offset)});
  EXPECT_EQ(o.exit_code, 0) << o.output;
  EXPECT_NEAR(o.verdict["deepest"]["depth_mm"], 0.15, 1e-6);
}

TEST_F(CheckCrossings, WireBeyondTheWallIsCountedWithItsDepth) {
  const double offset = tube_.flat_radius_mm() - 0.4 + 0.25;
  const Outcome o = judge(tube_.triangles(), {parallel_wire(0.0), parallel_wire(offset)});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_NEAR(o.verdict["deepest"]["depth_mm"], 0.25, 1e-6);
  EXPECT_EQ(o.verdict["deepest"]["step"], 2);
  EXPECT_EQ(o.verdict["steps_with_crossings"], 1);
  EXPECT_GE(o.verdict["deep_points"], 90);  // at every half millimetre
  EXPECT_EQ(o.verdict["axis_passes"], 0);
  EXPECT_EQ(o.verdict["path_passes"], 0);
}

TEST_F(CheckCrossings, AxisOutsideIsAsDeepAsItsFarSide) {
  const double offset = tube_.flat_radius_mm() + 1.0;
  const Outcome o = judge(tube_.triangles(), {parallel_wire(offset)});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_NEAR(o.verdict["deepest"]["depth_mm"], 1.4, 1e-6);
}

TEST_F(CheckCrossings, DirectionOfTheNormalsDoesNotMatter) {
  for (const double depth : {0.15, 0.25, 2.0}) {
    const std::vector<RecordedAxis> steps{parallel_wire(0.0),
                                          parallel_wire(tube_.flat_radius_mm() - 0.4 + depth)};
    const Outcome outward = judge(tube_.triangles(), steps);
    const Outcome inward = judge(turned(tube_.triangles()), steps);
    EXPECT_EQ(outward.verdict["crossings"], inward.verdict["crossings"]) << "depth " << depth;
    EXPECT_EQ(outward.verdict["deepest"], inward.verdict["deepest"]) << "depth " << depth;
  }
}

TEST_F(CheckCrossings, FacetsThatDisagreeAboutTheirSideAreTurned) {
  Triangles mixed = tube_.triangles();
  for (std::size_t i = 0; i < mixed.size(); i += 3) std::swap(mixed[i][1], mixed[i][2]);
  const std::vector<RecordedAxis> steps{parallel_wire(0.0),
                                        parallel_wire(tube_.flat_radius_mm() - 0.4 + 0.25)};
  const Outcome o = judge(mixed, steps);
  EXPECT_EQ(o.verdict["crossings"], judge(tube_.triangles(), steps).verdict["crossings"]);
  EXPECT_NEAR(o.verdict["deepest"]["depth_mm"], 0.25, 1e-6);
}

TEST_F(CheckCrossings, JumpToAParallelTubeBetweenTwoStepsIsAPathCrossing) {
  Triangles vessel = tube_.triangles();
  TubeMesh second = tube_;
  second.start_mm = {0.0, 8.0, 0.0};
  const Triangles other = second.triangles();
  vessel.insert(vessel.end(), other.begin(), other.end());
  const Outcome o = judge(vessel, {parallel_wire(0.0), parallel_wire(8.0)});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_EQ(o.verdict["deep_points"], 0);
  EXPECT_EQ(o.verdict["axis_passes"], 0);
  EXPECT_GE(o.verdict["path_passes"], 90);
  EXPECT_NEAR(o.verdict["examples"][0]["length_mm"], 8.0, 1e-9);
}

TEST_F(CheckCrossings, OverlapIntoALumenBehindThinTissueIsCounted) {
  // 0.1 mm of tissue between two tubes: no point is ever deeper than 0.05 mm, yet the wire reaches 0.3 mm
  // into the other lumen.
  Triangles vessel = tube_.triangles();
  TubeMesh second = tube_;
  second.start_mm = {0.0, 2.0 * tube_.flat_radius_mm() + 0.1, 0.0};
  const Triangles other = second.triangles();
  vessel.insert(vessel.end(), other.begin(), other.end());
  const Outcome o = judge(vessel, {parallel_wire(tube_.flat_radius_mm() - 0.4 + 0.4)});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_NEAR(o.verdict["deepest"]["depth_mm"], 0.4, 1e-6);
}

TEST_F(CheckCrossings, WallPassedBetweenTwoSamplesIsCounted) {
  // The axis leaves through a flat and is back in the lumen before the next half millimetre, at a corner of
  // the polyline that no sample sees: a spike 0.05 mm high.
  const double top = tube_.flat_radius_mm();
  RecordedAxis wire;
  wire.radius_mm = 0.05;
  wire.points_mm = {
      {40.10, top - 0.1, 0.0}, {40.0, top + 0.05, 0.0}, {39.90, top - 0.1, 0.0}, {10.0, 0.0, 0.0}};
  const Outcome o = judge(tube_.triangles(), {wire});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_EQ(o.verdict["axis_passes"], 2);
  EXPECT_EQ(o.verdict["deep_points"], 0);
}

TEST_F(CheckCrossings, ExitThroughAnOpeningIsNoCrossing) {
  tube_.cap_end = false;
  const std::vector<RecordedAxis> steps{straight_wire({58.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, 13),
                                        straight_wire({75.0, 0.0, 0.0}, {22.0, 0.0, 0.0}, 13)};
  const Outcome o = judge(tube_.triangles(), steps);
  EXPECT_EQ(o.exit_code, 0) << o.output;
  ASSERT_EQ(o.verdict["vessel"]["holes"].size(), 1U);
  EXPECT_EQ(o.verdict["vessel"]["holes"][0]["kind"], "opening");
  tube_.cap_end = true;  // the same wire through a closed end
  EXPECT_EQ(judge(tube_.triangles(), steps).exit_code, 1);
}

TEST_F(CheckCrossings, SheathBeforeAnOpeningIsTheContinuationOfTheVessel) {
  tube_.cap_start = false;
  const Outcome o = judge(tube_.triangles(), {straight_wire({-1.0, 0.0, 0.0}, {-4.0, 0.0, 0.0}, 2),
                                              straight_wire({20.0, 0.0, 0.0}, {-4.0, 0.0, 0.0}, 6)});
  EXPECT_EQ(o.exit_code, 0) << o.output;
}

TEST_F(CheckCrossings, ReturnThroughTheWallAfterAnExitIsACrossing) {
  tube_.cap_end = false;
  RecordedAxis wire;
  wire.points_mm = {{40.0, 0.0, 0.0}, {40.0, 8.0, 0.0}, {66.0, 8.0, 0.0}, {66.0, 0.0, 0.0}, {30.0, 0.0, 0.0}};
  const Outcome o = judge(tube_.triangles(), {wire});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_EQ(o.verdict["axis_passes"], 1);
}

TEST_F(CheckCrossings, PinHoleIsWall) {
  Triangles vessel = tube_.triangles();
  // A facet out of the flat at +y: a hole of 0.59 mm x 2 mm / 2, far below the calibre of 6 mm.
  const Vector3d hit(30.5, tube_.flat_radius_mm(), 0.1);
  std::erase_if(vessel, [&](const auto& t) {
    const Vector3d middle = (t[0] + t[1] + t[2]) / 3.0;
    return (middle - hit).norm() < 0.5 && std::abs(middle.x() - 30.5) < 0.5;
  });
  ASSERT_EQ(vessel.size(), tube_.triangles().size() - 1);
  RecordedAxis wire = straight_wire({30.6, 6.0, 0.1}, {30.6, 0.0, 0.1}, 4);
  wire.radius_mm = 0.05;
  const Outcome o = judge(vessel, {wire});
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_EQ(o.verdict["vessel"]["holes"][0]["kind"], "pin_hole");
  EXPECT_EQ(o.verdict["axis_passes"], 1);
}

TEST_F(CheckCrossings, PartInTheSheathIsNotJudged) {
  RecordedAxis wire =
      straight_wire({20.0, 0.0, 0.0}, {-30.0, 0.0, 0.0}, 10);  // enters through the closed start
  EXPECT_EQ(judge(tube_.triangles(), {wire}).exit_code, 1);
  wire.inserted_mm = 15.0;
  EXPECT_EQ(judge(tube_.triangles(), {wire}).exit_code, 0);
  wire.inserted_mm = 1e9;
  EXPECT_EQ(judge(tube_.triangles(), {wire}, "--sheath 5,0,0").exit_code, 0);
}

TEST_F(CheckCrossings, UnitLimitAndRadiusAreTheUsers) {
  Triangles metres = tube_.triangles();
  for (auto& t : metres) {
    for (Vector3d& p : t) p /= 1000.0;
  }
  const std::vector<RecordedAxis> steps{parallel_wire(tube_.flat_radius_mm() - 0.4 + 0.25)};
  const Outcome o = judge(metres, steps, "--unit m");
  EXPECT_EQ(o.exit_code, 1) << o.output;
  EXPECT_NEAR(o.verdict["deepest"]["depth_mm"], 0.25, 1e-5);
  EXPECT_EQ(judge(metres, steps, "--unit m --limit-mm 0.3").exit_code, 0);
  EXPECT_EQ(judge(metres, steps, "--unit m --radius-mm 0.1").exit_code, 0);
}

TEST_F(CheckCrossings, VerdictIsOneLine) {
  write_stl(folder_ / "vessel.stl", tube_.triangles());
  const auto pvd = write_recording(folder_, {parallel_wire(tube_.flat_radius_mm() - 0.4 + 0.031)});
  const Outcome o = run_judge(pvd.string() + " " + stl());
  EXPECT_EQ(o.output.rfind("crossings: 0  (steps 1, points ", 0), 0U) << o.output;
  EXPECT_NE(o.output.find("deepest 0.031 mm at step 1, arc "), std::string::npos) << o.output;
  EXPECT_EQ(std::count(o.output.begin(), o.output.end(), '\n'), 1);
}

TEST_F(CheckCrossings, BadInputIsOneLineAndTwo) {
  write_stl(folder_ / "vessel.stl", tube_.triangles());
  const std::string pvd = write_recording(folder_, {parallel_wire(0.0)}).string();
  const auto file = [this](const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  };
  const std::string nan_stl =
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid x\n";
  const std::vector<std::string> cases{
      pvd + " " + (folder_ / "missing.stl").string(),
      pvd + " " + file("empty.stl", ""),
      pvd + " " + file("none.stl", "solid x\nendsolid x\n"),
      pvd + " " + file("nan.stl", nan_stl),
      pvd + " " + pvd + " " +
          file("cut.stl", std::string(80, 'x') + std::string("\x02\0\0\0", 4) + std::string(50, '\x3f')),
      file("lying.stl", std::string(80, 'x') + std::string("\xff\xff\x00\x00", 4) + std::string(50, '\0')),
      (folder_ / "missing.pvd").string() + " " + stl(),
      file("no.pvd", "<VTKFile") + " " + stl(),
      file("bare.pvd", "<VTKFile type=\"Collection\"><Collection/></VTKFile>") + " " + stl(),
      file("gone.pvd",
           "<VTKFile><Collection><DataSet timestep=\"0\" file=\"gone.vtp\"/></Collection></VTKFile>") +
          " " + stl(),
      file("text.vtp", "hello") + " " + stl(),
      file("text.pvd", "<VTKFile><Collection><DataSet file=\"text.vtp\"/></Collection></VTKFile>") + " " +
          stl(),
      pvd + " " + stl() + " --limit-mm -1",
      pvd + " " + stl() + " --unit inch",
      pvd,
  };
  for (const std::string& arguments : cases) {
    const Outcome o = run_judge(arguments);
    EXPECT_EQ(o.exit_code, 2) << arguments << "\n" << o.output;
    EXPECT_EQ(std::count(o.output.begin(), o.output.end(), '\n'), 1) << arguments << "\n" << o.output;
    EXPECT_EQ(o.output.rfind("check_crossings: ", 0), 0U) << o.output;
  }
}

}  // namespace
}  // namespace endowire::tests
