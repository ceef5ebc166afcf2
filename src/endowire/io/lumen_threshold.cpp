#include "endowire/io/lumen_threshold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/io/voxel_pieces.hpp"

namespace endowire::io {

namespace {

constexpr std::size_t bins = 128;
/// Surfaces of fewer pairs are specks: their mean gradient says nothing.
constexpr double min_pairs = 60.0;
/// Values above this part of all voxels are metal and sparks: the scale ends there.
constexpr double sparks = 2e-5;
/// A second maximum counts from this part of the first, when the values between fall to this part of the lower one.
/// In CT the vessels' edge has a quarter of the gradient of the body's edge.
constexpr double rival_part = 0.15;
constexpr double valley_part = 0.85;
/// A maximum is as wide as its values exceed this part of it.
constexpr double plateau_part = 0.92;
/// What lumen takes of an image that shows it: the whole body would be more, a speck less.
constexpr double most_above = 0.45;
constexpr std::size_t least_voxels_above = 40;
constexpr double least_connected = 0.5;
/// Where noise has its tails, its few voxels differ most from their neighbours: next to all of the image lies above the lower
/// tail, and what lies above the upper one is strewn about.
constexpr double below_a_tail = 0.99;
constexpr double strewn = 0.1;

/// Sharpness over values.
struct Curve {
  double low = 0.0;
  double width = 1.0;  ///< of a bin
  std::array<double, bins> pairs{};
  std::array<double, bins> sharpness{};  ///< 0 where there are too few pairs

  [[nodiscard]] std::size_t bin_of(double value) const {
    const double bin = std::floor((value - low) / width);
    return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins)));
  }
  [[nodiscard]] double value_of(double bin) const { return low + (bin + 0.5) * width; }
};

/// @param sorted_sample  of the values
void set_scale(Curve& curve, const std::vector<float>& sorted_sample) {
  curve.low = sorted_sample.front();
  const auto last = static_cast<std::size_t>((1.0 - sparks) * static_cast<double>(sorted_sample.size() - 1));
  curve.width = std::max((static_cast<double>(sorted_sample[last]) - curve.low) / bins, 1e-12);
}

std::vector<float> sorted_sample(const Volume& volume) {
  constexpr std::size_t most = 2'000'000;
  const std::size_t step = volume.values.size() / most + 1;
  std::vector<float> sample;
  for (std::size_t i = 0; i < volume.values.size(); i += step) sample.push_back(volume.values[i]);
  std::sort(sample.begin(), sample.end());
  return sample;
}

Curve curve_of(const Volume& volume, const std::vector<float>& sample) {
  Curve curve;
  set_scale(curve, sample);
  // A pair counts in all bins between its values: differences first, sums afterwards.
  std::array<double, bins + 1> pairs{};
  std::array<double, bins + 1> gradients{};
  const Eigen::Vector3d spacing = volume.spacing_mm();
  const auto nx = static_cast<std::size_t>(volume.size[0]);
  const auto ny = static_cast<std::size_t>(volume.size[1]);
  const auto nz = static_cast<std::size_t>(volume.size[2]);
  const std::array<std::size_t, 3> strides{1, nx, nx * ny};
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const std::size_t here = (k * ny + j) * nx + i;
        const std::array<bool, 3> has_next{i + 1 < nx, j + 1 < ny, k + 1 < nz};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (!has_next[axis]) continue;
          const double a = volume.values[here];
          const double b = volume.values[here + strides[axis]];
          const std::size_t from = curve.bin_of(std::min(a, b));
          const std::size_t to = curve.bin_of(std::max(a, b));
          if (from == to) continue;
          const double gradient = std::abs(b - a) / spacing[static_cast<Eigen::Index>(axis)];
          pairs[from] += 1.0;
          pairs[to] -= 1.0;
          gradients[from] += gradient;
          gradients[to] -= gradient;
        }
      }
  double pair_sum = 0.0;
  double gradient_sum = 0.0;
  for (std::size_t b = 0; b < bins; ++b) {
    pair_sum += pairs[b];
    gradient_sum += gradients[b];
    curve.pairs[b] = pair_sum;
    if (pair_sum >= min_pairs) curve.sharpness[b] = gradient_sum / pair_sum;
  }
  return curve;
}

void smooth(Curve& curve) {
  constexpr int times = 4;
  for (int n = 0; n < times; ++n) {
    const std::array<double, bins> raw = curve.sharpness;
    for (std::size_t b = 0; b < bins; ++b) {
      if (raw[b] == 0.0) continue;
      const double before = b > 0 && raw[b - 1] > 0.0 ? raw[b - 1] : raw[b];
      const double after = b + 1 < bins && raw[b + 1] > 0.0 ? raw[b + 1] : raw[b];
      curve.sharpness[b] = 0.25 * before + 0.5 * raw[b] + 0.25 * after;
    }
  }
}

/// Maxima that stand out, from the highest down.
std::vector<std::size_t> peaks_of(const Curve& curve) {
  std::vector<std::size_t> order(bins);
  for (std::size_t b = 0; b < bins; ++b) order[b] = b;
  const auto& s = curve.sharpness;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return s[a] > s[b]; });
  std::vector<std::size_t> peaks;
  for (const std::size_t b : order) {
    if (s[b] <= 0.0 || s[b] < rival_part * s[order[0]]) break;
    const bool stands_out = std::all_of(peaks.begin(), peaks.end(), [&](std::size_t peak) {
      const auto [low, high] = std::minmax(b, peak);
      const double valley = *std::min_element(s.begin() + static_cast<std::ptrdiff_t>(low),
                                              s.begin() + static_cast<std::ptrdiff_t>(high) + 1);
      return valley < valley_part * s[b];
    });
    if (stands_out) peaks.push_back(b);
  }
  return peaks;
}

/// The middle of a peak's plateau.
double middle_of(const Curve& curve, std::size_t peak) {
  const double least = plateau_part * curve.sharpness[peak];
  std::size_t low = peak;
  std::size_t high = peak;
  while (low > 0 && curve.sharpness[low - 1] >= least) --low;
  while (high + 1 < bins && curve.sharpness[high + 1] >= least) ++high;
  return 0.5 * static_cast<double>(low + high);
}

/// What lies above a value.
struct Above {
  std::size_t voxels = 0;
  double part = 0.0;       ///< of all voxels
  double connected = 0.0;  ///< of those above: in the largest piece
};

Above above_of(const Volume& volume, double value) {
  const auto threshold = static_cast<float>(value);
  std::vector<std::uint8_t> marks(volume.values.size());
  Above above;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks[i] = volume.values[i] > threshold ? 1 : 0;
    above.voxels += marks[i];
  }
  if (above.voxels == 0) return above;
  above.part = static_cast<double>(above.voxels) / static_cast<double>(marks.size());
  above.connected = static_cast<double>(voxel_pieces(volume.size, marks).front().voxels) /
                    static_cast<double>(above.voxels);
  return above;
}

}  // namespace

ThresholdChoice find_lumen_threshold(const Volume& volume) {
  ThresholdChoice choice;
  const std::vector<float> sample = sorted_sample(volume);
  if (sample.front() == sample.back()) {
    choice.doubt = "all values are the same";
    return choice;
  }
  Curve curve = curve_of(volume, sample);
  smooth(curve);
  for (const std::size_t peak : peaks_of(curve)) {
    ThresholdCandidate candidate;
    candidate.value = curve.value_of(middle_of(curve, peak));
    candidate.sharpness_per_mm = curve.sharpness[peak];
    const Above above = above_of(volume, candidate.value);
    candidate.part_above = above.part;
    candidate.voxels_above = above.voxels;
    candidate.connected = above.connected;
    if (above.part < below_a_tail && above.connected > strewn) choice.candidates.push_back(candidate);
  }
  std::sort(choice.candidates.begin(), choice.candidates.end(),
            [](const ThresholdCandidate& a, const ThresholdCandidate& b) { return a.value < b.value; });
  if (choice.candidates.size() != 1) {
    choice.doubt = choice.candidates.empty() ? "no surface stands out" : "several surfaces stand out";
    return choice;
  }
  const ThresholdCandidate& only = choice.candidates.front();
  if (only.voxels_above < least_voxels_above || only.part_above > most_above) {
    choice.doubt =
        fmt::format("{:.2g} % of the voxels lie above the sharpest surface", 100.0 * only.part_above);
  } else if (only.connected < least_connected) {
    choice.doubt = fmt::format("only {:.0f} % of what lies above the sharpest surface are in one piece",
                               100.0 * only.connected);
  }
  choice.clear = choice.doubt.empty();
  return choice;
}

}  // namespace endowire::io
