#include "endowire/sim/waypoints.hpp"

#include <algorithm>

namespace endowire::sim {

void Waypoints::reserve(std::size_t joints) {
  shapes_.reserve(kMost);
  joints_.reserve(kMost * joints);
}

void Waypoints::clear() {
  shapes_.clear();
  joints_.clear();
  spacing_mm_ = kFirstSpacing_mm;
}

void Waypoints::keep(const std::vector<Eigen::Vector3d>& joints_mm, double inserted_mm, int attempt) {
  if (shapes_.size() == kMost) thin();
  shapes_.push_back({joints_.size(), joints_mm.size(), inserted_mm, attempt});
  joints_.insert(joints_.end(), joints_mm.begin(), joints_mm.end());
}

void Waypoints::forget(int attempt) {
  for (; !shapes_.empty() && shapes_.back().attempt == attempt; shapes_.pop_back())
    joints_.resize(shapes_.back().first);
}

const Eigen::Vector3d* Waypoints::last_mm(std::size_t joints) const {
  if (shapes_.empty() || shapes_.back().joints != joints) return nullptr;
  return joints_mm(shapes_.back());
}

void Waypoints::thin() {
  std::size_t kept = 0;
  std::size_t end = 0;
  for (std::size_t k = 0; k < shapes_.size(); k += 2) {
    Shape shape = shapes_[k];
    const auto from = joints_.begin() + static_cast<std::ptrdiff_t>(shape.first);
    std::copy_n(from, shape.joints, joints_.begin() + static_cast<std::ptrdiff_t>(end));
    shape.first = end;
    end += shape.joints;
    shapes_[kept++] = shape;
  }
  shapes_.resize(kept);
  joints_.resize(end);
  spacing_mm_ *= 2.0;
}

}  // namespace endowire::sim
