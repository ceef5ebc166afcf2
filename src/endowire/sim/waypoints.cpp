#include "endowire/sim/waypoints.hpp"

#include <algorithm>

namespace endowire::sim {

void Waypoints::reserve(std::size_t joints) {
  shapes_.reserve(kMost);
  joints_.reserve(kMost * joints);
  arcs_.reserve(kMost * joints);
}

void Waypoints::clear() {
  shapes_.clear();
  joints_.clear();
  arcs_.clear();
  spacing_mm_ = kFirstSpacing_mm;
  pieces_ = 0;
  pieces_apart_ = 1;
}

void Waypoints::keep(const std::vector<Eigen::Vector3d>& joints_mm, const std::vector<double>& arc_mm,
                     int attempt) {
  if (shapes_.size() == kMost) thin();
  shapes_.push_back({joints_.size(), joints_mm.size(), attempt});
  joints_.insert(joints_.end(), joints_mm.begin(), joints_mm.end());
  arcs_.insert(arcs_.end(), arc_mm.begin(), arc_mm.end());
}

void Waypoints::forget(int attempt) {
  for (; !shapes_.empty() && shapes_.back().attempt == attempt; shapes_.pop_back()) {
    joints_.resize(shapes_.back().first);
    arcs_.resize(shapes_.back().first);
  }
}

const Waypoints::Shape* Waypoints::first_of(int attempt) const {
  const auto found = std::find_if(shapes_.begin(), shapes_.end(),
                                  [attempt](const Shape& shape) { return shape.attempt == attempt; });
  return found == shapes_.end() ? nullptr : &*found;
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
    std::copy_n(joints_mm(shape), shape.joints, joints_.data() + end);
    std::copy_n(arc_mm(shape), shape.joints, arcs_.data() + end);
    shape.first = end;
    end += shape.joints;
    shapes_[kept++] = shape;
  }
  shapes_.resize(kept);
  joints_.resize(end);
  arcs_.resize(end);
  spacing_mm_ *= 2.0;
  pieces_apart_ *= 2;
}

}  // namespace endowire::sim
