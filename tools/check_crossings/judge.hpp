#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lumen.hpp"
#include "recording.hpp"

namespace crossings {

struct Settings {
  double limit_mm = 0.2;    ///< depth outside the lumen that still counts as the wall giving way, > 0
  double spacing_mm = 0.5;  ///< of the judged cross-sections along the arc
  int points_around = 8;    ///< of each cross-section; the first aims at the nearest wall
};

/// depth: a point of the surface outside the lumen deeper than the limit.
/// axis:  a piece of the axis that passes the wall.
/// path:  the way of an axis point from one recorded step to the next that passes the wall.
enum class CrossingKind { depth, axis, path };
[[nodiscard]] const char* name_of(CrossingKind kind);

struct Crossing {
  CrossingKind kind = CrossingKind::depth;
  int step = 0;  ///< counted from 1 in the order of time
  double arc_mm = 0.0;
  double depth_mm = 0.0;   ///< of a `depth`
  double length_mm = 0.0;  ///< of the piece or the way that passes
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
};

struct Verdict {
  long long steps = 0;
  long long points = 0;  ///< points of the surface judged
  long long deep_points = 0;
  long long axis_passes = 0;
  long long path_passes = 0;
  long long steps_with_crossings = 0;
  Crossing deepest;  ///< the point farthest outside, below the limit or not; depth 0: none is outside
  std::vector<Crossing> examples;  ///< the first of them, at most `max_examples`
  static constexpr std::size_t max_examples = 20;

  [[nodiscard]] long long crossings() const { return deep_points + axis_passes + path_passes; }
};

/// Judges the recorded steps of one wire, in order.
///
/// The axis is walked from the sheath to the tip. A piece that meets no triangle keeps its side; where it
/// meets one, the winding number decides anew. Points reached through an opening are beyond the vessel and
/// judged no further, until the axis comes back. A cross-section whose nearest wall is farther than its
/// radius needs no points. Of the others, each point is outside when the way from the axis to it passes the
/// wall an odd number of times, and its depth is the distance to the wall that it passed. When that way
/// passes two walls, the wire overlaps the tissue between two lumens by the length behind the first. The tip
/// is taken as a half ball about the first point.
class Judge {
 public:
  Judge(const Lumen& lumen, Settings settings) : lumen_(lumen), settings_(settings) {}
  void step(const Axis& axis);
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }

 private:
  enum class Side { lumen, beyond_opening, wall };
  struct Section {
    double arc_mm = 0.0;
    double radius_mm = 0.0;
    Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
    Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  ///< towards the tip
    bool judged = true;                                  ///< false: only a corner of the axis
  };

  void lay_sections(const Axis& axis);
  [[nodiscard]] Side side_at_sheath(const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] Side side_after(Side before, const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm,
                                const SegmentHits& wall_hits) const;
  void judge_section(const Section& section, Side side, bool tip);
  void judge_point(const Section& section, Side side, const Eigen::Vector3d& point_mm);
  void judge_paths();
  void count(Crossing crossing);

  const Lumen& lumen_;
  Settings settings_;
  Verdict verdict_;
  std::vector<Section> sections_;  // from the sheath to the tip
  std::vector<Section> previous_;  // of the step before
  std::vector<int> near_;          // wall triangles within the radius of the section at hand
  bool step_crosses_ = false;
};

}  // namespace crossings
