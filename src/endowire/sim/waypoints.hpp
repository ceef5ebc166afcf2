#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace endowire::sim {

/// Shapes that the wire passes through within one step, at most 128: on the way to an equilibrium, and the equilibria between
/// the pieces of a long command. When there are more, every second one is dropped, and those to come are taken half as often.
/// Allocates nothing once reserved.
class Waypoints {
 public:
  struct Shape {
    std::size_t first;  ///< of its joints in the list of all
    std::size_t joints;
    int attempt;  ///< number of the sub-step in which the wire passed it
  };

  void reserve(std::size_t joints);
  /// A new step begins.
  void clear();
  /// Whether a wire that moved this far since the last shape is worth another.
  [[nodiscard]] bool far_enough(double moved_mm) const { return moved_mm >= spacing_mm_; }
  /// Whether the equilibrium after one more piece of a command is worth keeping: every one, second, fourth …
  [[nodiscard]] bool piece_is_due() { return pieces_++ % pieces_apart_ == 0; }
  /// @param arc_mm  material arc of each joint
  void keep(const std::vector<Eigen::Vector3d>& joints_mm, const std::vector<double>& arc_mm, int attempt);
  /// Forgets the shapes of a sub-step that failed, the last one.
  void forget(int attempt);

  /// The first shape that the wire passed in a sub-step; null when it passed none.
  [[nodiscard]] const Shape* first_of(int attempt) const;
  [[nodiscard]] int size() const { return static_cast<int>(shapes_.size()); }
  [[nodiscard]] const Shape& shape(int index) const { return shapes_.at(static_cast<std::size_t>(index)); }
  [[nodiscard]] const Eigen::Vector3d* joints_mm(const Shape& shape) const {
    return joints_.data() + shape.first;
  }
  [[nodiscard]] const double* arc_mm(const Shape& shape) const { return arcs_.data() + shape.first; }
  /// The joints of the last shape when there are as many as asked for, else null.
  [[nodiscard]] const Eigen::Vector3d* last_mm(std::size_t joints) const;

 private:
  void thin();

  static constexpr std::size_t kMost = 128;
  static constexpr double kFirstSpacing_mm = 0.5;
  std::vector<Shape> shapes_;
  std::vector<Eigen::Vector3d> joints_;
  std::vector<double> arcs_;
  double spacing_mm_ = kFirstSpacing_mm;
  std::size_t pieces_ = 0;
  std::size_t pieces_apart_ = 1;
};

}  // namespace endowire::sim
