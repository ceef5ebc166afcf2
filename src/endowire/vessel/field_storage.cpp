#include <cmath>

#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/storage.hpp"

namespace endowire::vessel {
namespace {

constexpr StorageKind prepared_field{0x444c464552495745ULL, 1, "prepared field"};  // "EWIREFLD"
constexpr std::int32_t max_levels = 20;

}  // namespace

std::vector<std::byte> MeshField::serialise() const {
  StorageWriter w(prepared_field, key_, facts_.bytes + 4096);
  w.vector(origin_mm_);
  w.value(root_mm_);
  w.value(band_mm_);
  w.value(roots_along_);
  w.value(levels_);
  w.values(roots_);
  w.values(children_);
  w.values(bricks_);
  w.values(samples_);
  w.values(far_);
  w.value(static_cast<std::uint64_t>(tubes_.size()));
  for (const VirtualTube& tube : tubes_) {
    w.vector(tube.centre_mm);
    w.vector(tube.direction);
    for (double v : {tube.begin_mm, tube.end_mm, tube.radius_mm}) w.value(v);
  }
  w.value(static_cast<std::uint64_t>(facts_.bytes));
  for (double v : {facts_.finest_spacing_mm, facts_.coarsest_spacing_mm, facts_.error_max_mm,
                   facts_.error_p99_mm, facts_.error_p50_mm})
    w.value(v);
  w.value(static_cast<std::uint64_t>(facts_.error_points));
  w.value(static_cast<std::uint64_t>(facts_.refinement_complete ? 1 : 0));
  w.value(facts_.lumen_diameter_percentiles_mm);
  return w.seal();
}

MeshField MeshField::deserialise(std::span<const std::byte> bytes, std::uint64_t expected_key,
                                 const std::string& label) {
  StorageReader r(bytes, prepared_field, expected_key, label);
  MeshField f;
  f.key_ = expected_key;
  f.origin_mm_ = r.vector();
  f.root_mm_ = r.value<double>();
  f.band_mm_ = r.value<double>();
  f.roots_along_ = r.value<std::array<std::int32_t, 3>>();
  f.levels_ = r.value<std::int32_t>();
  f.roots_ = r.values<Reference>();
  f.children_ = r.values<std::array<Reference, 8>>();
  f.bricks_ = r.values<Brick>();
  f.samples_ = r.values<std::uint16_t>();
  f.far_ = r.values<FarCell>();
  const auto tubes = r.value<std::uint64_t>();
  for (std::uint64_t k = 0; k < tubes; ++k) {  // ends with InputError when the bytes do
    VirtualTube tube;
    tube.centre_mm = r.vector();
    tube.direction = r.vector();
    tube.begin_mm = r.value<double>();
    tube.end_mm = r.value<double>();
    tube.radius_mm = r.value<double>();
    f.tubes_.push_back(tube);
  }
  f.facts_.bricks = f.bricks_.size();
  f.facts_.bytes = static_cast<std::size_t>(r.value<std::uint64_t>());
  f.facts_.finest_spacing_mm = r.value<double>();
  f.facts_.coarsest_spacing_mm = r.value<double>();
  f.facts_.error_max_mm = r.value<double>();
  f.facts_.error_p99_mm = r.value<double>();
  f.facts_.error_p50_mm = r.value<double>();
  f.facts_.error_points = static_cast<std::size_t>(r.value<std::uint64_t>());
  f.facts_.refinement_complete = r.value<std::uint64_t>() != 0;
  f.facts_.lumen_diameter_percentiles_mm = r.value<std::array<double, 5>>();
  r.expect_end();
  f.validate(label);
  return f;
}

/// Every reference ends in something that exists, after at most levels_ steps; every number is finite.
void MeshField::validate(const std::string& label) const {
  const auto check = [&](bool holds, const char* why) {
    if (!holds) StorageReader::fail(prepared_field, label, why);
  };
  check(origin_mm_.allFinite() && std::isfinite(root_mm_) && root_mm_ > 0.0, "its box is not finite");
  check(std::isfinite(band_mm_) && band_mm_ > 0.0, "its band is not positive");
  check(levels_ >= 0 && levels_ <= max_levels, "its depth is absurd");
  std::int64_t roots = 1;
  for (std::int32_t n : roots_along_) {
    check(n > 0 && (static_cast<std::int64_t>(n) << levels_) < (std::int64_t{1} << 31),
          "its extent is absurd");
    roots *= n;
    check(roots < (std::int64_t{1} << 31), "its extent is absurd");
  }
  check(static_cast<std::size_t>(roots) == roots_.size(), "its roots do not fill its box");
  check(samples_.size() == bricks_.size() * samples_per_brick, "its samples do not match its bricks");
  std::vector<std::int32_t> depth(children_.size(), -1);
  const auto visit = [&](Reference reference, std::int64_t parent, std::int32_t below) {
    if (reference >= 0) {
      const auto group = static_cast<std::size_t>(reference);
      check(group < children_.size() && static_cast<std::int64_t>(group) > parent,
            "a cell refers to nothing");
      check(below <= levels_ && depth[group] < 0, "its tree is tangled");
      depth[group] = below;
    } else {
      check(index_of(reference) < (is_far(reference) ? far_.size() : bricks_.size()),
            "a cell refers to nothing");
    }
  };
  for (Reference reference : roots_) visit(reference, -1, 1);
  for (std::size_t g = 0; g < children_.size(); ++g) {
    check(depth[g] > 0, "a cell is never referred to");
    for (Reference reference : children_[g]) visit(reference, static_cast<std::int64_t>(g), depth[g] + 1);
  }
  for (const Brick& b : bricks_)
    check(std::isfinite(b.low_mm) && std::isfinite(b.step_mm) && b.step_mm >= 0.0F && b.tissue_mm >= 0.0F,
          "a brick is not finite");
  for (const FarCell& c : far_)
    check(std::isfinite(c.distance_mm) && std::isfinite(c.gradient[0]) && std::isfinite(c.gradient[1]) &&
              std::isfinite(c.gradient[2]) && std::isfinite(c.radius_mm) && c.radius_mm > 0.0F &&
              c.tissue_mm >= 0.0F,
          "a cell is not finite");
  for (const VirtualTube& t : tubes_)
    check(t.centre_mm.allFinite() && t.direction.allFinite() &&
              std::isfinite(t.begin_mm + t.end_mm + t.radius_mm),
          "a virtual tube is not finite");
}

}  // namespace endowire::vessel
