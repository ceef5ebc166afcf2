#include "endowire/io/lumen_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "endowire/base/error.hpp"
#include "endowire/io/lumen_threshold.hpp"
#include "endowire/io/voxel_pieces.hpp"

namespace endowire::io {

using base::InputError;

namespace {

/// More values than that are grey levels: segmentations name organs by the hundred at most. So are values that change from
/// voxel to voxel: organs are many voxels wide.
constexpr std::size_t max_labels = 256;
constexpr double max_changes = 0.15;
constexpr std::size_t max_labels_said = 65536;
/// With all pieces kept, those below this part of the largest are specks still.
constexpr double speck_part = 1e-3;
constexpr std::size_t min_lumen_voxels = 8;

/// Voxels of each label but 0; empty for a grey-level image.
/// @param said  that it is a label map: then only the values count
std::map<std::int64_t, std::size_t> labels_of(const Volume& volume, bool said) {
  std::map<std::int64_t, std::size_t> labels;
  if (!volume.whole_numbers) return labels;
  float last = std::numeric_limits<float>::quiet_NaN();
  std::size_t* count = nullptr;
  std::size_t changes = 0;
  for (const float value : volume.values) {
    if (value < 0.0F || value > 1e9F) return {};
    if (value != last) {  // labels come in rows
      last = value;
      ++changes;
      count = &labels[static_cast<std::int64_t>(value)];
      if (labels.size() > (said ? max_labels_said : max_labels)) return {};
    }
    ++*count;
  }
  const bool busy = static_cast<double>(changes) > max_changes * static_cast<double>(volume.count());
  if (!said && (!labels.contains(0) || busy)) return {};
  labels.erase(0);
  return labels;
}

std::int64_t choose_label(const std::map<std::int64_t, std::size_t>& labels, const VolumeOptions& options,
                          const std::string& file) {
  std::string list;
  for (const auto& [label, voxels] : labels) {
    if (list.size() > 300) {
      list += ", …";
      break;
    }
    list += fmt::format("{}{} ({} voxels)", list.empty() ? "" : ", ", label, voxels);
  }
  if (options.label) {
    if (labels.contains(*options.label)) return *options.label;
    throw InputError(fmt::format("{}: --label is {}; must be one of {}", file, *options.label, list));
  }
  if (labels.size() == 1) return labels.begin()->first;
  throw InputError(
      fmt::format("{}: holds {} labels, and which is the lumen is ambiguous; must be one of {}: --label",
                  file, labels.size(), list));
}

[[noreturn]] void refuse_threshold(const ThresholdChoice& choice, const std::string& file) {
  std::string suggested;
  for (const ThresholdCandidate& candidate : choice.candidates)
    suggested += fmt::format("{}{:.4g} ({:.2g} % of the voxels lie above)", suggested.empty() ? "" : ", ",
                             candidate.value, 100.0 * candidate.part_above);
  throw InputError(
      fmt::format("{}: the threshold of the lumen is ambiguous: {}; must be given with --threshold{}", file,
                  choice.doubt, suggested.empty() ? std::string() : ", for example " + suggested));
}

/// Turns values into a scalar that is positive in the lumen.
void set_threshold(Volume& volume, const VolumeOptions& options, VolumeReport& report,
                   const std::string& file) {
  if (options.label)
    throw InputError(fmt::format("{}: --label is {}, and this is a grey-level image; must be left out", file,
                                 *options.label));
  report.threshold = options.threshold;
  report.threshold_high = options.threshold_high;
  if (!report.threshold) {
    const ThresholdChoice choice = find_lumen_threshold(volume);
    if (!choice.clear) refuse_threshold(choice, file);
    report.threshold = choice.candidates.front().value;
    report.threshold_found = true;
    report.threshold_sharpness_per_mm = choice.candidates.front().sharpness_per_mm;
  }
  const auto low = static_cast<float>(*report.threshold);
  const auto high =
      static_cast<float>(report.threshold_high.value_or(std::numeric_limits<double>::infinity()));
  if (!(high > low))
    throw InputError(
        fmt::format("{}: the upper threshold is {}; must be above the lower, {}", file, high, low));
  for (float& value : volume.values) value = std::min(value - low, high - value);
}

void set_label(Volume& volume, std::int64_t label, VolumeReport& report) {
  report.label_map = true;
  report.label = label;
  const auto wanted = static_cast<float>(label);
  for (float& value : volume.values) value = value == wanted ? 1.0F : -1.0F;
}

/// Marks what is kept with 3.
std::vector<std::uint8_t> keep(const Volume& volume, bool all, VolumeReport& report,
                               const std::string& file) {
  std::vector<std::uint8_t> marks(volume.values.size());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = volume.values[i] > 0.0F ? 1 : 0;
  const std::vector<VoxelPiece> pieces = voxel_pieces(volume.size, marks);
  report.pieces = pieces.size();
  if (pieces.empty() || pieces.front().voxels < min_lumen_voxels)
    throw InputError(
        fmt::format("{}: {} voxels of lumen are joined{}; must be >= {}", file,
                    pieces.empty() ? 0 : pieces.front().voxels,
                    report.threshold ? fmt::format(" above {:.4g}", *report.threshold) : std::string(),
                    min_lumen_voxels));
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const bool large =
        static_cast<double>(pieces[p].voxels) >= speck_part * static_cast<double>(pieces.front().voxels) &&
        pieces[p].voxels >= min_lumen_voxels;
    if (p > 0 && !(all && large)) {
      report.largest_dropped = std::max(report.largest_dropped, pieces[p].voxels);
      continue;
    }
    ++report.pieces_kept;
    report.voxels_kept += fill_piece(volume.size, marks, pieces[p].seed, 3);
  }
  return marks;
}

/// The box around what is kept, and a layer around it.
void frame(const Volume& volume, const std::vector<std::uint8_t>& marks, LumenImage& image) {
  std::array<std::int64_t, 3> low = volume.size;
  std::array<std::int64_t, 3> high{-1, -1, -1};
  std::size_t i = 0;
  for (std::int64_t z = 0; z < volume.size[2]; ++z)
    for (std::int64_t y = 0; y < volume.size[1]; ++y)
      for (std::int64_t x = 0; x < volume.size[0]; ++x, ++i) {
        if (marks[i] != 3) continue;
        const std::array<std::int64_t, 3> place{x, y, z};
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], place[k]);
          high[k] = std::max(high[k], place[k]);
        }
      }
  for (std::size_t k = 0; k < 3; ++k) {
    image.first[k] = low[k] - 1;
    image.size[k] = high[k] - low[k] + 3;
  }
}

void fill_values(const Volume& volume, const std::vector<std::uint8_t>& marks, LumenImage& image) {
  image.inside.reserve(static_cast<std::size_t>(image.size[0] * image.size[1] * image.size[2]));
  for (std::int64_t z = 0; z < image.size[2]; ++z)
    for (std::int64_t y = 0; y < image.size[1]; ++y)
      for (std::int64_t x = 0; x < image.size[0]; ++x) {
        const std::array<std::int64_t, 3> wanted{x + image.first[0], y + image.first[1], z + image.first[2]};
        std::array<std::int64_t, 3> place{};
        for (std::size_t k = 0; k < 3; ++k)
          place[k] = std::clamp<std::int64_t>(wanted[k], 0, volume.size[k] - 1);
        const auto from =
            static_cast<std::size_t>((place[2] * volume.size[1] + place[1]) * volume.size[0] + place[0]);
        const float value = volume.values[from];
        const bool kept = place == wanted && marks[from] == 3;
        image.inside.push_back(kept ? value : -std::abs(value));
      }
}

/// What is outside and not joined with the layer around becomes inside.
std::size_t fill_cavities(LumenImage& image) {
  std::vector<std::uint8_t> marks(image.inside.size());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = image.inside[i] > 0.0F ? 1 : 0;
  fill_piece(image.size, marks, 0, 2);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) continue;
    image.inside[i] = std::max(std::abs(image.inside[i]), std::numeric_limits<float>::min());
    ++filled;
  }
  return filled;
}

}  // namespace

LumenImage lumen_of(Volume volume, const VolumeOptions& options, const std::string& file_label) {
  LumenImage image;
  VolumeReport& report = image.report;
  report.size = volume.size;
  report.spacing_mm = volume.spacing_mm();
  report.frame = volume.frame;
  const std::map<std::int64_t, std::size_t> labels = options.threshold
                                                         ? std::map<std::int64_t, std::size_t>()
                                                         : labels_of(volume, options.label.has_value());
  if (labels.empty()) {
    set_threshold(volume, options, report, file_label);
  } else {
    set_label(volume, choose_label(labels, options, file_label), report);
  }
  const std::vector<std::uint8_t> marks = keep(volume, options.keep_all, report, file_label);
  frame(volume, marks, image);
  fill_values(volume, marks, image);
  report.cavity_voxels = fill_cavities(image);
  return image;
}

}  // namespace endowire::io
