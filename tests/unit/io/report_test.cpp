#include "endowire/io/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "endowire/io/decimate.hpp"
#include "endowire/io/vtp.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::io {
namespace {

using nlohmann::json;

template <class Value>
std::vector<Value> decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU);
  }
  std::vector<Value> values(bytes.size() / sizeof(Value));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return values;
}

json data_of(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"run\">";
  const std::size_t begin = html.find(open) + open.size();
  return json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

/// A made-up run of so many steps with so many points.
struct MadeUp {
  MadeUp(std::uint64_t steps, std::size_t points) : history(steps) {
    for (std::uint64_t step = 1; step <= steps; ++step) {
      sim::Snapshot snapshot;
      snapshot.points.resize(points);
      for (std::size_t i = 0; i < points; ++i) {
        snapshot.points[i].position_mm = {std::sin(0.1 * static_cast<double>(i + step)), 1.0 / 3.0,
                                          -1.0 * static_cast<double>(i)};
        snapshot.points[i].radius_mm = 0.4445;
        snapshot.points[i].wall_force_n_per_mm = 1e-3 * static_cast<double>(i);
      }
      sim::StepReport report;
      report.inserted_length_mm = static_cast<double>(step) / 3.0;
      report.push_force_n = std::sin(static_cast<double>(step));
      report.torque_n_mm = std::cos(static_cast<double>(step));
      report.max_force_5mm_n = 0.1 * static_cast<double>(step);
      report.tip_force_n = step == 2 ? std::numeric_limits<double>::quiet_NaN() : 0.5;
      reports.push_back(report);
      snapshots.push_back(snapshot);
      history.add(step, 0.1 * static_cast<double>(step), report, snapshot, false);
    }
  }
  [[nodiscard]] std::string html(const std::string& title = "a run") const {
    return report_html({title, "sub", summary, mesh, history, {}, Eigen::Vector3d(0, 0, -9.81)});
  }
  RunHistory history;
  std::vector<sim::StepReport> reports;
  std::vector<sim::Snapshot> snapshots;
  std::string summary = R"({"schema":1,"steps":3,"events":[],"max_tip_force_n":0.5})";
  vessel::TriangleMesh mesh = test::closed_tube(4.0, 60.0, 16, 8);
};

TEST(Report, EveryNumberIsTheRuns) {
  const MadeUp run(40, 12);
  const json data = data_of(run.html());
  EXPECT_EQ(data["summary"]["max_tip_force_n"], 0.5);
  EXPECT_EQ(data["series"]["count"], 40);
  const auto time = decoded<double>(data["series"]["time_s"]);
  const auto inserted = decoded<double>(data["series"]["inserted_mm"]);
  const auto push = decoded<double>(data["series"]["push_force_n"]);
  const auto torque = decoded<double>(data["series"]["torque_n_mm"]);
  const auto wall = decoded<double>(data["series"]["wall_force_n"]);
  const auto tip = decoded<double>(data["series"]["tip_force_n"]);
  ASSERT_EQ(push.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(time[i], 0.1 * static_cast<double>(i + 1));
    EXPECT_EQ(inserted[i], run.reports[i].inserted_length_mm);
    EXPECT_EQ(push[i], run.reports[i].push_force_n);
    EXPECT_EQ(torque[i], run.reports[i].torque_n_mm);
    EXPECT_EQ(wall[i], run.reports[i].max_force_5mm_n);
    EXPECT_TRUE(tip[i] == run.reports[i].tip_force_n || (i == 1 && std::isnan(tip[i])));
  }
  const auto position = decoded<float>(data["wire"]["position_mm"]);
  const auto force = decoded<float>(data["wire"]["wall_force_n_per_mm"]);
  ASSERT_EQ(data["wire"]["step"].size(), 40U);
  ASSERT_EQ(position.size(), 3U * 40U * 12U);
  for (std::size_t frame = 0; frame < 40; ++frame)
    for (std::size_t i = 0; i < 12; ++i) {
      const sim::SnapshotPoint& point = run.snapshots[frame].points[i];
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(position[3 * (12 * frame + i) + c],
                  static_cast<float>(point.position_mm[static_cast<int>(c)]));
      EXPECT_EQ(force[12 * frame + i], static_cast<float>(point.wall_force_n_per_mm));
    }
  const auto vertices = decoded<float>(data["vessel"]["position_mm"]);
  const auto corners = decoded<std::uint32_t>(data["vessel"]["corners"]);
  ASSERT_EQ(vertices.size(), 3 * run.mesh.vertices_mm.size());
  ASSERT_EQ(corners.size(), 3 * run.mesh.triangles.size());
  EXPECT_EQ(vertices[3], static_cast<float>(run.mesh.vertices_mm[1].x()));
  EXPECT_EQ(corners[4], static_cast<std::uint32_t>(run.mesh.triangles[1][1]));
}

TEST(Report, AsksTheNetworkForNothing) {
  const std::string html = MadeUp(3, 4).html();
  for (const char* wanted : {"http:", "https:", "//cdn", "src=", "@import", "url(h", "url(/", "fetch(",
                             "XMLHttpRequest", "import("})
    EXPECT_EQ(html.find(wanted), std::string::npos) << wanted;
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST(Report, NamesAreTextWhateverIsInThem) {
  const std::string title = "</title></script><script>alert(\"1\")</script>{{run}}&amp;";
  const std::string html = MadeUp(3, 4).html(title);
  EXPECT_NE(html.find("<title>&lt;/title&gt;&lt;/script&gt;&lt;script&gt;alert(&quot;1&quot;)&lt;/"
                      "script&gt;{{run}}&amp;amp;</title>"),
            std::string::npos);
  EXPECT_EQ(data_of(html)["title"], title);
  std::size_t ends = 0;
  for (std::size_t at = html.find("</script"); at != std::string::npos; at = html.find("</script", at + 1))
    ++ends;
  EXPECT_EQ(ends, 2U) << "only the page's own";
}

TEST(Report, ARunThatNeverLeftTheSheathHasAPageToo) {
  MadeUp run(0, 0);
  const json data = data_of(run.html());
  EXPECT_EQ(data["series"]["count"], 0);
  EXPECT_EQ(data["wire"]["step"].size(), 0U);
}

TEST(Report, StaysSmallForTheLongestWireTheFinestMeshAndManyEvents) {
  MadeUp run(400, 2'601);
  json summary = json::parse(run.summary);
  for (int i = 0; i < 50'000; ++i)
    summary["events"].push_back(
        {{"step", i}, {"time_s", 0.1 * i}, {"kind", "snap"}, {"value", 1.5}, {"unit", "mm"}});
  run.summary = summary.dump();
  run.mesh = test::sphere(50.0, 7);  // 327,680 triangles
  const std::string html = run.html();
  EXPECT_LE(html.size(), max_report_bytes);
  const json data = data_of(html);
  EXPECT_EQ(data["wire"]["step"].back(), 400) << "the last shape is always there";
  EXPECT_GT(data["wire"]["step"].size(), 50U);
  EXPECT_EQ(data["summary"]["events_in_all"], 50'000);
  EXPECT_LE(data["vessel"]["triangles"], 44'000);
  EXPECT_GE(data["vessel"]["triangles"], vtp_available() ? 30'000 : 0);
}

TEST(Decimated, KeepsASmallMeshAndTheShapeOfALargeOne) {
  const vessel::TriangleMesh sphere = test::sphere(50.0, 5);  // 20,480 triangles
  EXPECT_EQ(decimated(sphere, 30'000).triangles.size(), sphere.triangles.size());
  const vessel::TriangleMesh small = decimated(sphere, 4'000);
  if (!vtp_available()) {
    EXPECT_TRUE(small.triangles.empty());
    return;
  }
  EXPECT_LE(small.triangles.size(), 4'400U);
  EXPECT_NEAR(vessel::signed_volume_mm3(small) / vessel::signed_volume_mm3(sphere), 1.0, 0.01);
  for (const Eigen::Vector3d& vertex : small.vertices_mm) EXPECT_NEAR(vertex.norm(), 50.0, 0.5);
}

}  // namespace
}  // namespace endowire::io
