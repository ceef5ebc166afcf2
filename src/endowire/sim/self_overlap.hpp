#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "endowire/sim/snapshot.hpp"

namespace endowire::sim {

/// The place where a wire lies deepest in itself.
struct SelfGap {
  double gap_mm = std::numeric_limits<double>::infinity();  ///< between the surfaces, < 0; infinite: none
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();    ///< on the part nearer to the tip
};

/// Finds where a wire lies in itself. Loops of a wire do not touch each other in this model: where they would have
/// to, the result is wrong, and this tells.
///
///   The rods are cut into pieces of at most 4 mm; the middles of the pieces go into a grid, hashed, whose cells
///   hold the reach of two pieces. Only pieces in neighbouring cells are measured. Time and memory grow with the
///   length of the wire and the number of its rods, as long as the wire is not a tangle.
///
/// Domain  Two places count as parts apart when the wire between them is longer than π times the sum of their
///         radii: no wire turns back on itself on less, as its axis would bend tighter than its own radius.
class SelfOverlap {
 public:
  /// Memory for wires of so many points and so long: afterwards `nearest` allocates nothing.
  void reserve(std::size_t points, double length_mm);

  /// The deepest overlap; an infinite gap when there is none.
  /// @param points  of a snapshot: from the tip on, `arc_mm` rising
  [[nodiscard]] SelfGap nearest(std::span<const SnapshotPoint> points);

  /// Pairs of pieces that the last call measured: what its time grows with.
  [[nodiscard]] std::size_t measured() const { return measured_; }

 private:
  using Cell = Eigen::Vector3i;
  struct Piece {
    Eigen::Vector3d begin_mm, end_mm;
    double arc_mm;  ///< of its beginning
    double radius_mm;
    Cell cell;
    std::int32_t next;  ///< in the same chain of the table; -1: none
  };

  void cut(std::span<const SnapshotPoint> points);
  void sort_into_cells();
  [[nodiscard]] std::size_t chain_of(const Cell& cell) const;
  void measure(const Piece& a, const Piece& b, SelfGap& least);

  std::vector<Piece> pieces_;
  std::vector<std::int32_t> chains_;  ///< first piece of each; a power of two of them
  double widest_mm_ = 0.0;            ///< radius
  std::size_t measured_ = 0;
};

}  // namespace endowire::sim
