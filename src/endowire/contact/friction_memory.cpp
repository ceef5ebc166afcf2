#include "endowire/contact/friction_memory.hpp"

#include <algorithm>

namespace endowire::contact {

void FrictionMemory::clear() {
  arc_mm.clear();
  traction_n_per_mm.clear();
  normal_n_per_mm.clear();
}

void FrictionMemory::reserve(std::size_t samples) {
  arc_mm.reserve(samples);
  traction_n_per_mm.reserve(samples);
  normal_n_per_mm.reserve(samples);
}

void FrictionMemory::assign(const FrictionMemory& other) {
  arc_mm.assign(other.arc_mm.begin(), other.arc_mm.end());
  traction_n_per_mm.assign(other.traction_n_per_mm.begin(), other.traction_n_per_mm.end());
  normal_n_per_mm.assign(other.normal_n_per_mm.begin(), other.normal_n_per_mm.end());
}

void FrictionMemory::recall(double advanced_mm, Sample& sample) const {
  constexpr double kTip_mm = 3.0;
  sample.traction_n_per_mm.setZero();
  sample.lagged_normal_n = 0.0;
  if (arc_mm.empty()) return;
  const auto between = [&](double arc, auto&& value) {
    const auto after = std::upper_bound(arc_mm.begin(), arc_mm.end(), arc);
    const auto k = static_cast<std::size_t>(after - arc_mm.begin());
    if (k == 0) return value(std::size_t{0}, std::size_t{0}, 0.0);
    if (k == arc_mm.size()) return value(k - 1, k - 1, 0.0);
    return value(k - 1, k, (arc - arc_mm[k - 1]) / (arc_mm[k] - arc_mm[k - 1]));
  };
  if (sample.arc_mm <= arc_mm.back()) {
    between(sample.arc_mm, [&](std::size_t a, std::size_t b, double w) {
      sample.traction_n_per_mm = (1.0 - w) * traction_n_per_mm[a] + w * traction_n_per_mm[b];
    });
  }
  const double there_mm = sample.arc_mm - advanced_mm;
  const double wall_mm = std::min(sample.arc_mm, there_mm) < kTip_mm ? sample.arc_mm : there_mm;
  if (wall_mm <= arc_mm.back()) {
    between(wall_mm, [&](std::size_t a, std::size_t b, double w) {
      sample.lagged_normal_n = ((1.0 - w) * normal_n_per_mm[a] + w * normal_n_per_mm[b]) * sample.share_mm();
    });
  }
}

}  // namespace endowire::contact
