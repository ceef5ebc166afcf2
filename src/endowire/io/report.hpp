#pragma once

#include <cstddef>
#include <string>

#include "endowire/io/run_history.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// What a report is made of.
struct ReportContent {
  std::string title;
  std::string subtitle;
  const std::string& summary;  ///< summary.json: the report's numbers are its numbers
  const vessel::TriangleMesh& mesh;
  const RunHistory& history;
  sim::Access access;
  /// Of the patient on the back: the front is seen along it.
  Eigen::Vector3d gravity_m_per_s2 = Eigen::Vector3d::Zero();
};

inline constexpr std::size_t max_report_bytes = 8'000'000;

/// `report.html`: one page for any browser with WebGL 2, at most max_report_bytes, that asks the network for nothing.
/// The wire in its translucent vessel, scrubbed through time; forces over insertion; events; timing.
///
/// The page is made of the readable files in io/report/, put in at build time; the numbers stand in it as one JSON
/// element `run`: `summary`, `series` and `wire` (arrays, base64 of little-endian bytes), `vessel`, `view`. What is
/// not finite is null, or NaN in an array, and is drawn as a gap.
[[nodiscard]] std::string report_html(const ReportContent& content);

}  // namespace endowire::io
