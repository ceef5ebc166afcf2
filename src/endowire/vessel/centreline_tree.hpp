#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace endowire::vessel {

/// A point of a centreline: the middle of the lumen there.
struct CentrelinePoint {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0.0;                             ///< of the inscribed ball: exact distance to the wall
  double arc_mm = 0.0;                                ///< along the branch, from its first point
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();  ///< away from the root, length one
  Eigen::Vector3d curvature_per_mm = Eigen::Vector3d::Zero();  ///< towards the centre of the bend
};

/// A stretch of a vessel between two bifurcations, or between a bifurcation and an end.
///
/// At a bifurcation one branch goes on as the same vessel, the one that continues straightest and widest; the
/// others begin new vessels. Vessels are named after where they leave: "1" from the root, its side vessels
/// "1.1", "1.2", … in the order they leave it, theirs "1.1.1", …; the stretches of a vessel that others leave
/// are "1:1", "1:2", …
struct CentrelineBranch {
  std::string name;
  std::string vessel;                  ///< the name without the stretch
  std::int32_t parent = -1;            ///< -1: begins at a root
  std::vector<std::int32_t> children;  ///< the one that goes on as the same vessel first
  std::int32_t from_bifurcation = -1;  ///< -1: a root
  std::int32_t to_bifurcation = -1;    ///< -1: an end
  std::size_t first_point = 0;         ///< of all points of the tree
  std::size_t points = 0;              ///< at least 2
  double from_root_mm = 0.0;           ///< of the first point, along the tree
  double length_mm = 0.0;
  double tortuosity = 1.0;     ///< length over the straight distance of its ends, ≥ 1
  double ostium_arc_mm = 0.0;  ///< where it leaves its parent's lumen; 0 where the vessel goes on
  double cap_mm = 0.0;         ///< of arc at a closed end (or root) where the radius falls towards the cap
  double min_radius_mm = 0.0;  ///< these three from the ostium to the cap
  double mean_radius_mm = 0.0;
  double max_radius_mm = 0.0;
};

/// Where branches part: the last point of the parent, the first of each child.
struct CentrelineBifurcation {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0.0;
  std::int32_t parent = -1;
  std::vector<std::int32_t> children;
};

enum class CentrelineEndKind : std::uint8_t {
  opening,  ///< the vessel is open: a wire leaves there
  cap,      ///< the lumen is closed
  cut,      ///< no end of the lumen: a loop was cut here to make a tree
};

/// An end of the tree.
struct CentrelineEnd {
  CentrelineEndKind kind = CentrelineEndKind::cap;
  int opening = 0;  ///< number of the opening, from 1; 0: none
  std::int32_t branch = -1;
  bool root = false;  ///< the branch begins here
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< out of the lumen, length one
  double radius_mm = 0.0;                               ///< of the lumen at the end, before the cap
  std::int32_t rejoins = -1;                            ///< of a cut: the branch that the lumen goes on in
  double rejoins_arc_mm = 0.0;                          ///< and where
};

/// A place on the tree.
struct CentrelinePlace {
  std::int32_t branch = -1;
  double arc_mm = 0.0;
};

/// The place nearest to a point, and how the point lies to it.
struct NearestCentreline {
  CentrelinePlace place;
  double radius_mm = 0.0;  ///< of the lumen there
  double offset_mm = 0.0;  ///< of the point from the centreline
};

/// The centreline at a place.
struct CentrelineState {
  Eigen::Vector3d position_mm;
  Eigen::Vector3d tangent;           ///< away from the root
  Eigen::Vector3d curvature_per_mm;  ///< towards the centre of the bend
  double radius_mm;
};

/// What is ahead along a way.
struct CentrelineAhead {
  double max_curvature_per_mm = 0.0;
  double min_radius_mm = std::numeric_limits<double>::infinity();
  double length_mm = 0.0;  ///< looked at: shorter than asked for where the way ends
};

/// The next turn on a way.
struct CentrelineTurn {
  std::int32_t branch = -1;  ///< to take at the next bifurcation; -1: the way ends in this branch
  double distance_mm = 0.0;  ///< to that bifurcation, or to the end of the way
};

/// The centrelines of a vessel as a tree, or several where the lumen is in separate pieces.
///
/// Queries allocate nothing but `route`. Between points the centreline is a cubic Hermite curve; radius and
/// curvature are linear. Arcs are lengths of chords: short by at most 0.5 % in the tightest bends.
class CentrelineTree {
 public:
  CentrelineTree() = default;  ///< of a vessel without a lumen
  /// @throws base::InputError naming `label` when the parts do not make a tree.
  CentrelineTree(std::vector<CentrelineBranch> branches, std::vector<CentrelinePoint> points,
                 std::vector<CentrelineBifurcation> bifurcations, std::vector<CentrelineEnd> ends,
                 const std::string& label);

  [[nodiscard]] const std::vector<CentrelineBranch>& branches() const { return branches_; }
  [[nodiscard]] const std::vector<CentrelinePoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<CentrelineBifurcation>& bifurcations() const { return bifurcations_; }
  [[nodiscard]] const std::vector<CentrelineEnd>& ends() const { return ends_; }
  [[nodiscard]] std::span<const CentrelinePoint> points_of(std::int32_t branch) const;
  /// The branch of that name; -1 when there is none.
  [[nodiscard]] std::int32_t branch_named(const std::string& name) const;

  /// The place whose lumen a point lies in: of all places the one whose inscribed ball reaches it best,
  /// |x − c| − r least, then the foot of the point on that branch. A vessel near by, behind tissue, does not
  /// attract a point in the lumen of a wider one.
  /// @param hint  a place near by makes the search shorter, never another answer
  [[nodiscard]] NearestCentreline nearest(const Eigen::Vector3d& point_mm,
                                          const CentrelinePlace& hint = {}) const;

  /// Arcs beyond the branch mean its ends.
  [[nodiscard]] CentrelineState state_at(const CentrelinePlace& place) const;
  /// The branch whose lumen a place lies in: before the ostium of a branch that is still its parent's.
  [[nodiscard]] std::int32_t lumen_branch(const CentrelinePlace& place) const;
  /// The branch whose lumen a point lies in; -1: the tree has none.
  [[nodiscard]] std::int32_t branch_at(const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] double from_root_mm(const CentrelinePlace& place) const;

  /// Length of the way between two places along the tree; infinity between separate trees.
  [[nodiscard]] double distance_mm(const CentrelinePlace& from, const CentrelinePlace& to) const;
  /// What to do next on that way.
  [[nodiscard]] CentrelineTurn next_turn(const CentrelinePlace& from, const CentrelinePlace& to) const;
  /// The branches of that way in order, both ends included; empty between separate trees.
  [[nodiscard]] std::vector<std::int32_t> route(const CentrelinePlace& from, const CentrelinePlace& to) const;
  /// Curvature and radius over the next `length_mm` of that way.
  [[nodiscard]] CentrelineAhead ahead(const CentrelinePlace& from, const CentrelinePlace& to,
                                      double length_mm) const;

  /// The tree as bytes: versioned, keyed, with a checksum.
  /// @param key  of mesh and parameters: `centreline_key`
  [[nodiscard]] std::vector<std::byte> serialise(std::uint64_t key) const;
  /// @param label        name of the cache file for messages
  /// @throws InputError  when the bytes are foreign, damaged, of another version or of another key
  [[nodiscard]] static CentrelineTree deserialise(std::span<const std::byte> bytes,
                                                  std::uint64_t expected_key, const std::string& label);

 private:
  struct Box {
    Eigen::Vector3d low, high;
    double radius_mm;    ///< largest inside
    std::int32_t first;  ///< of segments in order_, or the right child (the left one follows its parent)
    std::int32_t count;  ///< of segments; 0 for an inner box
  };
  struct Foot {
    double score_mm = std::numeric_limits<double>::infinity();
    double distance_mm = 0.0;
    double part = 0.0;
    std::int32_t segment = -1;
  };

  void validate(const std::string& label) const;
  void build_boxes();
  std::int32_t build_boxes(std::int32_t begin, std::int32_t end);
  [[nodiscard]] Foot foot_on(std::int32_t segment, const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] Foot descend(Foot foot, const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] std::size_t segment_at(const CentrelinePlace& place) const;
  [[nodiscard]] std::int32_t fork_of(std::int32_t a, std::int32_t b) const;
  void look(std::int32_t branch, double from_mm, double to_mm, CentrelineAhead& ahead) const;

  std::vector<CentrelineBranch> branches_;
  std::vector<CentrelinePoint> points_;
  std::vector<CentrelineBifurcation> bifurcations_;
  std::vector<CentrelineEnd> ends_;
  std::vector<std::int32_t> branch_of_;  ///< of each point
  std::vector<std::int32_t> depth_;      ///< of each branch, in branches from its root
  std::vector<Box> boxes_;
  std::vector<std::int32_t> order_;  ///< segments, named by their first point
};

}  // namespace endowire::vessel
