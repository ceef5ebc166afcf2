#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "endowire/vessel/anatomy/axis.hpp"
#include "endowire/vessel/anatomy/fillet.hpp"

namespace endowire::vessel::anatomy {

/// One vessel of a shape.
struct Tube {
  Axis axis;
  Fillet fillet;           ///< with those that stand before it
  double before_mm = 0.0;  ///< how far it runs on straight before its axis begins; then a half ball closes it
  double beyond_mm = 0.0;  ///< and behind its end
};

/// The lumen of joined vessels as a signed distance: negative inside.
///
///   f_i(x) = |x − c_i(s)| − r_i(s) at the foot s of x on axis i
///   F      = f₁ joined with f₂, that with f₃ and so on, each by its own fillet
///
/// The ball of a fillet fits nowhere into tissue thinner than it: vessels that do not meet must keep further apart
/// than twice its radius.
/// Cross-sections normal to an axis are circles of exactly its radius. F is the distance itself to first order
/// near F = 0, and grows by one per millimetre but for the taper of the vessels.
class LumenShape {
 public:
  /// @param reach_mm  how far outside the lumen F is needed; beyond it, it is `reach_mm`
  LumenShape(std::vector<Tube> tubes, double reach_mm);

  [[nodiscard]] WallSample at(const Eigen::Vector3d& point_mm) const;

  /// Moves a point near the surface onto it, by Newton's method along the gradient.
  /// @param tolerance_mm  how near is near enough
  /// @param sample        the surface there
  [[nodiscard]] Eigen::Vector3d projected(Eigen::Vector3d point_mm, double tolerance_mm,
                                          WallSample& sample) const;

  [[nodiscard]] const std::vector<Tube>& tubes() const { return tubes_; }
  [[nodiscard]] const Eigen::AlignedBox3d& bounds_mm() const { return bounds_mm_; }

 private:
  struct Chunk {  ///< a short piece of a tube
    std::uint32_t tube;
    double from_mm, to_mm;  ///< arc lengths
    Eigen::Vector3d begin_mm, begin_tangent;
    Eigen::Vector3d end_mm, end_tangent;
    bool first, last;  ///< of its tube: closed by a half ball
    Eigen::Vector3d centre_mm;
    double radius_mm;  ///< of a ball around the piece's lumen
  };
  using Cell = std::array<std::int64_t, 3>;

  void add_chunks(std::uint32_t tube);
  void sort_into_cells();
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] std::size_t index_of(const Cell& cell) const;
  void lower(const Chunk& chunk, const Eigen::Vector3d& point_mm, WallSample& sample) const;

  std::vector<Tube> tubes_;
  double reach_mm_;
  Eigen::AlignedBox3d bounds_mm_;
  std::vector<Chunk> chunks_;
  // Which chunks come near a cell of a coarse grid: those of cell i are chunks_near_[first_near_[i]] and so on.
  Cell cells_{};
  std::vector<std::uint32_t> first_near_;
  std::vector<std::uint32_t> chunks_near_;
};

}  // namespace endowire::vessel::anatomy
