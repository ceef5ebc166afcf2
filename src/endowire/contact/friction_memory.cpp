#include "endowire/contact/friction_memory.hpp"

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

void FrictionMemory::recall(std::size_t& hint, Sample& sample) const {
  const std::size_t n = arc_mm.size();
  sample.traction_n_per_mm.setZero();
  sample.lagged_normal_n = 0.0;
  if (n == 0 || sample.arc_mm > arc_mm[n - 1]) return;
  std::size_t& k = hint;
  while (k + 1 < n && arc_mm[k + 1] <= sample.arc_mm) ++k;
  if (sample.arc_mm <= arc_mm[k] || k + 1 == n) {
    sample.traction_n_per_mm = traction_n_per_mm[k];
    sample.lagged_normal_n = normal_n_per_mm[k] * sample.share_mm();
    return;
  }
  const double w = (sample.arc_mm - arc_mm[k]) / (arc_mm[k + 1] - arc_mm[k]);
  sample.traction_n_per_mm = (1.0 - w) * traction_n_per_mm[k] + w * traction_n_per_mm[k + 1];
  sample.lagged_normal_n = ((1.0 - w) * normal_n_per_mm[k] + w * normal_n_per_mm[k + 1]) * sample.share_mm();
}

}  // namespace endowire::contact
