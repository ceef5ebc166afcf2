// Where the samples of a step lie on the wire.
#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/contact/contact_set.hpp"

namespace endowire::contact {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

constexpr int kMaxSamplesPerRod = 16;
constexpr double kMinShare_mm = 0.25;
/// A stretch whose clearance is larger touches nothing in the step: what the prediction may be off by.
constexpr double kNear_mm = 0.02;
/// A stretch is even whose clearance differs by less from one end to the other, and in its middle from their mean.
constexpr double kUneven_mm = 0.002;
/// Longer stretches that are even at both ends and in the middle are looked at in parts, so that a ridge beside these is seen.
constexpr double kFlat_mm = 1.0;

/// Intervals of a rod between samples: a power of two, so that samples persist when the lumen narrows.
int intervals(double rod_length_mm, double lumen_radius_mm, const ContactSpec& spec) {
  const double spacing = std::clamp(0.5 * lumen_radius_mm, kMinShare_mm, spec.max_share_mm);
  int count = 1;
  while (count < kMaxSamplesPerRod && rod_length_mm > spacing * count * (1.0 + 1e-9)) count *= 2;
  return count;
}

}  // namespace

/// Walks along the wire and puts samples where they are needed.
class ContactSet::Placement {
 public:
  Placement(const Wire& wire, const vessel::Field& field, const ContactSpec& spec,
            std::vector<Sample>& samples)
      : wire_(wire), field_(field), spec_(spec), samples_(samples) {}

  void run(int rods) {
    rods_left_ = rods;
    end_mm_ = wire_.material.arc_mm[at(rods)];
    for (rod_ = 0; rod_ < rods; ++rod_, --rods_left_) {
      const double length = wire_.material.length_mm[at(rod_)];
      const Eigen::Vector3d middle =
          0.5 * (wire_.shape.joints_mm[at(rod_)] + wire_.shape.joints_mm[at(rod_ + 1)]);
      const int count = intervals(length, field_.lumen_radius_mm(middle), spec_);
      bulge_ = 0.25 * length * length * (curvature_per_mm(rod_, rods) + curvature_per_mm(rod_ + 1, rods));
      Site from = look_at(0.0);
      for (int k = 0; k < count; ++k) {
        known_.fill(false);
        remember(0, from);
        from = look_at(static_cast<double>(k + 1) / count);
        remember(kParts, from);
        put(sites_[0]);
        divide(0, kParts);
      }
    }
  }

 private:
  /// A point of the curve that the rods stand for: that a straight rod touches a round wall with its ends only is no unevenness of the wall.
  struct Site {
    double fraction = 0.0;
    double arc_mm = 0.0;
    double clearance_mm = 0.0;
  };

  /// Curvature vector at a joint; at the two ends that of their neighbour.
  [[nodiscard]] Eigen::Vector3d curvature_per_mm(int joint, int rods) const {
    const int j = std::clamp(joint, 1, std::max(1, rods - 1));
    const auto& frames = wire_.shape.frames;
    const double span = 0.5 * (wire_.material.length_mm[at(j - 1)] + wire_.material.length_mm[at(j)]);
    return (frames[at(j - 1)].col(2) - frames[at(j)].col(2)) / span;
  }

  void remember(int part, const Site& site) {
    sites_[at(part)] = site;
    known_[at(part)] = true;
  }

  /// A site of the present stretch, looked at once.
  const Site& site(int part) {
    if (!known_[at(part)]) {
      const double share = static_cast<double>(part) / kParts;
      remember(part, look_at(sites_[0].fraction + share * (sites_[kParts].fraction - sites_[0].fraction)));
    }
    return sites_[at(part)];
  }

  [[nodiscard]] Site look_at(double fraction) const {
    const double arc = wire_.material.arc_mm[at(rod_)] + fraction * wire_.material.length_mm[at(rod_)];
    const Eigen::Vector3d x = (1.0 - fraction) * wire_.shape.joints_mm[at(rod_)] +
                              fraction * wire_.shape.joints_mm[at(rod_ + 1)] -
                              fraction * (1.0 - fraction) * bulge_;
    return {fraction, arc, field_.at(x).distance_mm - wire_.line.radius_mm(arc)};
  }

  void put(const Site& site) {
    Sample s;
    s.rod = rod_;
    s.fraction = site.fraction;
    s.arc_mm = site.arc_mm;
    s.radius_mm = wire_.line.radius_mm(site.arc_mm);
    s.friction = wire_.line.friction(site.arc_mm);
    samples_.push_back(s);
  }

  [[nodiscard]] static bool even(const Site& a, const Site& middle, const Site& b) {
    return std::abs(a.clearance_mm - b.clearance_mm) < kUneven_mm &&
           std::abs(middle.clearance_mm - 0.5 * (a.clearance_mm + b.clearance_mm)) < kUneven_mm;
  }

  /// The nearest that a wall can be to a stretch whose ends are p and q off it: the height of a triangle with these three sides.
  static double least_distance_mm(double p, double q, double length) {
    const double foot = (length * length + p * p - q * q) / (2.0 * length);
    if (foot <= 0.0 || foot >= length) return std::min(p, q);
    return std::sqrt(std::max(0.0, p * p - foot * foot));
  }

  /// Whether the wire comes near the wall between two sites and its clearance there is not the same all along.
  [[nodiscard]] bool touches_unevenly(int from, int to) {
    const Site& a = site(from);
    const Site& b = site(to);
    const double length = b.arc_mm - a.arc_mm;
    if (to - from < 2 || length < 2.0 * kFinest_mm * (1.0 - 1e-9)) return false;
    const double radius = wire_.line.radius_mm(a.arc_mm);
    if (least_distance_mm(std::max(0.0, a.clearance_mm + radius), std::max(0.0, b.clearance_mm + radius),
                          length) > radius + kNear_mm)
      return false;
    const int half = (from + to) / 2;
    const Site& middle = site(half);
    const bool flat = even(a, middle, b);
    if (!flat && std::min({a.clearance_mm, middle.clearance_mm, b.clearance_mm}) < kNear_mm) return true;
    if (flat && length <= kFlat_mm) return false;
    return touches_unevenly(from, half) || touches_unevenly(half, to);
  }

  /// There is always room for the samples that the lumen asks for, to the end of the wire.
  [[nodiscard]] bool has_room() const {
    const double most = 2.0 * (end_mm_ - samples_.back().arc_mm) / kMinShare_mm + rods_left_;
    return static_cast<double>(samples_.size()) + most + 2.0 < static_cast<double>(samples_.capacity());
  }

  void divide(int from, int to) {
    if (!touches_unevenly(from, to) || !has_room()) return;
    const int half = (from + to) / 2;
    divide(from, half);
    put(site(half));
    divide(half, to);
  }

  /// Parts that a stretch may have: with the longest, 64 mm of rod in sixteen stretches, no more than half of kFinest_mm each.
  static constexpr int kParts = 64;

  const Wire& wire_;
  const vessel::Field& field_;
  const ContactSpec& spec_;
  std::vector<Sample>& samples_;
  std::array<Site, kParts + 1> sites_;
  std::array<bool, kParts + 1> known_{};
  int rod_ = 0;
  Eigen::Vector3d bulge_ =
      Eigen::Vector3d::Zero();  ///< four times the sagitta, towards the centre of curvature
  int rods_left_ = 0;
  double end_mm_ = 0.0;
};

void ContactSet::begin(const Wire& wire, const FrictionMemory& memory) {
  samples_.clear();
  memory_.assign(memory);
  start_shape_ = wire.shape;
  start_arc_mm_.assign(wire.material.arc_mm.begin(), wire.material.arc_mm.end());
}

void ContactSet::place(const Wire& wire, int rods_in_lumen, const vessel::Field& field,
                       const ContactSpec& spec, double advanced_mm) {
  samples_.clear();
  advanced_mm_ = advanced_mm;
  Placement(wire, field, spec, samples_).run(rods_in_lumen);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& s = samples_[i];
    const double next_mm =
        i + 1 < samples_.size() ? samples_[i + 1].arc_mm : wire.material.arc_mm[at(rods_in_lumen)];
    s.from_mm = i > 0 ? samples_[i - 1].to_mm : s.arc_mm;
    s.to_mm = 0.5 * (s.arc_mm + next_mm);
    s.start_mm = start_position_mm(s);
    s.start_spin_rad = start_shape_.spin_rad[at(s.rod)];
    memory_.recall(advanced_mm_, s);
    s.normal_n = s.lagged_normal_n;
    s.detected_at_mm = s.start_mm;
  }
}

}  // namespace endowire::contact
