#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/program.hpp"
#include "support/temporary_folder.hpp"

// Scenes in which a wire is steered to a target: what has to hold when it gets there, and the controls in which it must
// not.

namespace endowire::test {

/// A scene that ships, as text that may lie anywhere: the shared vessels are found from it.
inline std::string shipped_scene(const std::string& name) {
  const std::string text = read_text(std::filesystem::path(ENDOWIRE_SOURCE_DIR) / "scenes" / name);
  return std::regex_replace(text, std::regex(R"(\.\./\.\./shared/)"), std::string(ENDOWIRE_SHARED_DIR) + "/");
}

inline std::string without_torque(const std::string& scene) {
  return std::regex_replace(scene, std::regex("torque_deg = [-0-9.]+"), "torque_deg = 0.0");
}

inline std::string with_straight_tip(const std::string& scene) {
  return std::regex_replace(scene, std::regex("hydrophilic_035_angled"), "hydrophilic_035_straight");
}

/// Every turn of the hand is off by so much.
inline std::string with_turns_off_by(const std::string& scene, double degrees) {
  const std::regex turn("torque_deg = ([-0-9.]+)");
  std::string text;
  auto rest = scene.cbegin();
  for (std::sregex_iterator match(scene.begin(), scene.end(), turn), end; match != end; ++match) {
    const double asked = std::stod((*match)[1]);
    text.append(rest, (*match)[0].first);
    text += "torque_deg = " + std::to_string(asked == 0.0 ? 0.0 : asked + degrees);
    rest = (*match)[0].second;
  }
  return text.append(rest, scene.cend());
}

inline std::string with_rods_of(const std::string& scene, double length_mm) {
  return scene + "\n[rods]\nadaptive = false\nrod_length_mm = " + std::to_string(length_mm) + "\n";
}

inline std::string with_steps_of(const std::string& scene, double advance_mm) {
  return std::regex_replace(scene, std::regex("max_advance_mm = [0-9.]+"),
                            "max_advance_mm = " + std::to_string(advance_mm));
}

/// Plays a scene as a user would.
/// @return  its summary; null when there is none
inline nlohmann::json summary_of(const std::string& scene) {
  const TemporaryFolder folder;
  write_text(folder / "scene.toml", scene);
  const std::string cache = (std::filesystem::temp_directory_path() / "endowire-test-cache").string();
  const Outcome outcome =
      run_endowire(folder, {"simulate", "scene.toml", "--out", "out", "--cache", cache, "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  if (!std::filesystem::exists(folder / "out/summary.json")) return nullptr;
  nlohmann::json summary = nlohmann::json::parse(read_text(folder / "out/summary.json"));
  const nlohmann::json& target = summary["target"];
  std::printf("tip in %s, %s, %.1f mm to go, %.2f radii from the centreline, %d steps, %.3f detections\n",
              summary["instruments"][0]["tip_branch"].get<std::string>().c_str(),
              target["reached"].get<bool>() ? "reached" : "not reached", target["to_go_mm"].get<double>(),
              target["offset_radii"].get<double>(), summary["steps"].get<int>(),
              summary["detections_per_step_without_snap"].get<double>());
  return summary;
}

/// What holds in every run, wherever the tip ends.
inline void expect_sound(const nlohmann::json& summary) {
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["converged_steps"], summary["steps"]) << summary["first_failure"].dump();
  EXPECT_LE(summary["detections_per_step_without_snap"], 1.05);
  EXPECT_EQ(summary["wall_crossings"], 0) << summary.value("wall_crossings_note", "");
}

inline void expect_arrival(const nlohmann::json& summary) {
  ASSERT_NO_FATAL_FAILURE(expect_sound(summary));
  EXPECT_EQ(summary["target"]["reached"], true);
  EXPECT_EQ(summary["target"]["beyond_ostium_mm"], 60.0);
  EXPECT_EQ(summary["target"]["within_radii"], 1.5);
  EXPECT_LT(summary["instruments"][0]["max_push_force_n"], 2.0) << "the grip of the wire";
  const auto& events = summary["events"];
  EXPECT_TRUE(std::none_of(events.begin(), events.end(), [](const nlohmann::json& event) {
    return event["kind"] == "perforation" || event["kind"] == "hand_slip" || event["kind"] == "exit";
  }));
}

/// The tip lies in another vessel, not short of the goal in the right one.
inline void expect_wrong_vessel(const nlohmann::json& summary) {
  ASSERT_NO_FATAL_FAILURE(expect_sound(summary));
  EXPECT_EQ(summary["target"]["reached"], false);
  const auto vessel = [](const std::string& branch) { return branch.substr(0, branch.find(':')); };
  EXPECT_NE(vessel(summary["instruments"][0]["tip_branch"]), vessel(summary["target"]["branch"]));
  EXPECT_GT(summary["target"]["to_go_mm"], 60.0);
}

}  // namespace endowire::test
