#include "endowire/io/summary.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "support/hand_made_trees.hpp"

namespace endowire::io {
namespace {

sim::StepReport report(bool converged, int splits, double deflection_mm) {
  sim::StepReport report;
  report.converged = converged;
  report.splits = splits;
  report.detections = 1 + splits;
  report.verifications = 2;
  report.newton_iterations = 4 + splits;
  report.rods = 100;
  report.contact_samples = 300;
  report.inserted_length_mm = 10.0;
  report.push_force_n = 0.5;
  report.torque_n_mm = -0.25;
  report.max_wall_deflection_mm = deflection_mm;
  return report;
}

TEST(Percentile, IsTheNearestRank) {
  EXPECT_EQ(percentile({}, 0.5), 0.0);
  EXPECT_EQ(percentile({3.0}, 0.99), 3.0);
  EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);
  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i) hundred.push_back(i);
  EXPECT_EQ(percentile(hundred, 0.99), 99.0);
  EXPECT_EQ(percentile(hundred, 1.0), 100.0);
}

TEST(RunStatistics, CountsStepsSplitsFailuresAndSnapsApart) {
  RunStatistics run;
  run.add(0.1, report(true, 0, 0.01), {}, 100.0);
  run.add(0.2, report(true, 1, 0.02), {}, 200.0);
  sim::StepReport snapped = report(false, 2, 0.05);
  snapped.snapped = true;
  snapped.solve.termination = solve::Termination::stalled;
  snapped.events.push_back({sim::EventKind::snap, 1.5, {1, 2, 3}});
  run.add(0.3, snapped, snapped.events, 900.0);
  run.add(0.4, report(false, 0, 0.01), {}, 100.0);
  EXPECT_EQ(run.steps, 4U);
  EXPECT_EQ(run.converged_steps, 2U);
  EXPECT_EQ(run.split_steps, 2U);
  EXPECT_EQ(run.detections, 7.0);
  EXPECT_EQ(run.calm_detections, 4.0);
  EXPECT_EQ(run.step_us.size(), 3U);
  ASSERT_EQ(run.snap_step_us.size(), 1U);
  EXPECT_EQ(run.snap_step_us[0], 900.0);
  EXPECT_EQ(run.max_torque_n_mm, 0.25);
  ASSERT_EQ(run.failed.size(), 1U);
  EXPECT_EQ(run.failed[0].step, 3U);
  ASSERT_EQ(run.events.size(), 1U);
  EXPECT_EQ(run.events[0].time_s, 0.3);
}

class Summary : public ::testing::Test {
 protected:
  Summary() : mesh_(cube()), field_(vessel::MeshField::build(mesh_.repaired, parameters())) {
    run_.add(0.1, report(true, 0, 0.01), {}, 100.0);
    run_.add(0.2, report(true, 1, 0.03), {}, 150.0);
    last_.points.resize(2);
    last_.points[0].position_mm = {1, 2, std::numeric_limits<double>::quiet_NaN()};
    last_.inserted_length_mm = 12.5;
    scene_.name = "s.toml";
    scene_.instrument.model = "wire";
  }

  static vessel::FieldParameters parameters() {
    vessel::FieldParameters coarse;
    coarse.error_target_mm = 0.5;
    coarse.max_bytes = 2'000'000;
    return coarse;
  }

  static VesselMesh cube() {
    vessel::TriangleMesh soup;
    for (int i = 0; i < 8; ++i)
      soup.vertices_mm.emplace_back(20.0 * (i & 1), 20.0 * (i >> 1 & 1), 20.0 * (i >> 2));
    soup.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return {"cube.stl", 0xabcULL, vessel::LengthUnit::millimetre, vessel::repair(soup, "cube.stl"), {}};
  }

  nlohmann::json written(const CrossingVerdict& verdict, const MachineFacts& machine) const {
    return nlohmann::json::parse(summary_json(scene_, mesh_, field_, {tree_, target_}, run_, last_,
                                              0xfedcba9876543210ULL, verdict, machine));
  }

  SceneFile scene_;
  VesselMesh mesh_;
  vessel::MeshField field_;
  vessel::CentrelineTree tree_;
  std::optional<sim::Target> target_;
  RunStatistics run_;
  sim::Snapshot last_;
};

TEST_F(Summary, HoldsWhatTheRunWas) {
  const nlohmann::json json = written({0, ""}, {});
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["steps"], 2);
  EXPECT_EQ(json["split_steps"], 1);
  EXPECT_EQ(json["detections_per_step"], 1.5);
  EXPECT_EQ(json["detections_per_step_without_snap"], 1.5);
  EXPECT_EQ(json["newton_iterations"]["mean"], 4.5);
  EXPECT_EQ(json["newton_iterations"]["max"], 5.0);
  EXPECT_EQ(json["max_wall_deflection_mm"], 0.03);
  EXPECT_EQ(json["wall_crossings"], 0);
  EXPECT_EQ(json["instruments"][0]["model"], "wire");
  EXPECT_EQ(json["instruments"][0]["max_push_force_n"], 0.5);
  EXPECT_EQ(json["instruments"][0]["inserted_length_mm"], 12.5);
  EXPECT_EQ(json["state_hash"], "fedcba9876543210");
  EXPECT_EQ(json["vessel"]["triangles"], 12);
  EXPECT_EQ(json["vessel"]["openings"].size(), 0U);
  EXPECT_EQ(json["machine"]["step_time_us"]["max"], 150.0);
  EXPECT_EQ(json["first_failure"], nullptr);
}

TEST_F(Summary, SaysHowFarTheTargetIs) {
  EXPECT_TRUE(written({0, ""}, {})["target"].is_null());
  EXPECT_TRUE(written({0, ""}, {})["instruments"][0]["tip_branch"].is_null());
  tree_ = test::tree_with_side_vessel();
  scene_.target = sim::TargetSpec{"left", "1.1:1", Eigen::Vector3d::Zero(), 20.0, 1.5};
  target_ = sim::find_target(tree_, *scene_.target);
  last_.points[0].position_mm = {0.0, 0.0, 40.0};
  run_.events.push_back({2, 0.2, {sim::EventKind::new_branch, 2.0, {1, 2, 3}, 2}});
  nlohmann::json json = written({0, ""}, {});
  EXPECT_EQ(json["instruments"][0]["tip_branch"], "1:1");
  EXPECT_EQ(json["target"]["name"], "left");
  EXPECT_EQ(json["target"]["branch"], "1.1:1");
  EXPECT_EQ(json["target"]["reached"], false);
  EXPECT_NEAR(json["target"]["to_go_mm"].get<double>(), 45.0, 1e-9);
  EXPECT_EQ(json["events"][0]["kind"], "new_branch");
  EXPECT_EQ(json["events"][0]["branch"], "1.1:1");
  EXPECT_EQ(json["events"][0]["unit"], "mm");
  last_.points[0].position_mm = {30.0, 1.0, 60.0};
  json = written({0, ""}, {});
  EXPECT_EQ(json["target"]["reached"], true);
  EXPECT_EQ(json["target"]["to_go_mm"], 0.0);
  EXPECT_NEAR(json["target"]["offset_radii"].get<double>(), 0.5, 1e-9);
}

TEST_F(Summary, ANumberThatIsNotFiniteBecomesNull) {
  const nlohmann::json json = written({0, ""}, {});
  EXPECT_EQ(json["instruments"][0]["tip_position_mm"], nlohmann::json::array({1.0, 2.0, nullptr}));
}

TEST_F(Summary, WithoutAJudgeTheReasonStandsInTheCountsPlace) {
  const nlohmann::json json = written({std::nullopt, "not judged: because"}, {});
  EXPECT_TRUE(json["wall_crossings"].is_null());
  EXPECT_EQ(json["wall_crossings_note"], "not judged: because");
}

TEST_F(Summary, OnlyMachineDependsOnTheMachine) {
  nlohmann::json one = written({0, ""}, {10.0, 1.0, false, "a"});
  nlohmann::json other = written({0, ""}, {20.0, 2.0, true, "b"});
  EXPECT_NE(one, other);
  one.erase("machine");
  other.erase("machine");
  EXPECT_EQ(one, other);
}

}  // namespace
}  // namespace endowire::io
