#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "endowire/base/error.hpp"
#include "endowire/vessel/hash.hpp"
#include "endowire/vessel/mesh_field.hpp"

namespace endowire::vessel {
namespace {

using base::InputError;

static_assert(std::endian::native == std::endian::little, "prepared fields are stored little-endian");

constexpr std::uint64_t magic = 0x444c464552495745ULL;  // "EWIREFLD"
constexpr std::uint64_t format_version = 1;
constexpr std::size_t header_words = 5;  // magic, version, key, bytes of payload, checksum of payload
constexpr std::int32_t max_levels = 20;

class Writer {
 public:
  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&v);
    out_.insert(out_.end(), bytes, bytes + sizeof(T));
  }
  template <typename T>
  void values(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(v.size()));
    const auto* bytes = reinterpret_cast<const std::byte*>(v.data());
    out_.insert(out_.end(), bytes, bytes + v.size() * sizeof(T));
  }
  void vector(const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) value(v[k]);
  }
  std::vector<std::byte> out_;
};

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, std::string label) : bytes_(bytes), label_(std::move(label)) {}
  template <typename T>
  T value() {
    T v{};
    take(&v, sizeof(T));
    return v;
  }
  template <typename T>
  std::vector<T> values() {
    const auto count = value<std::uint64_t>();
    if (count > (bytes_.size() - at_) / sizeof(T)) fail("an array is longer than the file");
    std::vector<T> v(static_cast<std::size_t>(count));
    if (!v.empty()) take(v.data(), v.size() * sizeof(T));
    return v;
  }
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = value<double>();
    return v;
  }
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(label_ + ": prepared field is unusable: " + why + "; must be written by this version");
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) fail("it ends early");
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::span<const std::byte> bytes_;
  std::string label_;
  std::size_t at_ = 0;
};

std::uint64_t checksum(std::span<const std::byte> bytes) {
  ContentHash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  return hash.value();
}

}  // namespace

std::vector<std::byte> MeshField::serialise() const {
  Writer w;
  w.out_.reserve(facts_.bytes + 4096);
  for (std::uint64_t word : {magic, format_version, key_, std::uint64_t{0}, std::uint64_t{0}}) w.value(word);
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
  const std::span<const std::byte> payload = std::span(w.out_).subspan(8 * header_words);
  const std::uint64_t tail[2] = {payload.size(), checksum(payload)};
  std::memcpy(w.out_.data() + 24, tail, sizeof tail);
  return std::move(w.out_);
}

MeshField MeshField::deserialise(std::span<const std::byte> bytes, std::uint64_t expected_key,
                                 const std::string& label) {
  Reader header(bytes.first(std::min(bytes.size(), 8 * header_words)), label);
  if (header.value<std::uint64_t>() != magic) header.fail("it does not begin as one");
  if (header.value<std::uint64_t>() != format_version) header.fail("its format is of another version");
  const auto key = header.value<std::uint64_t>();
  if (key != expected_key) header.fail("it belongs to another mesh or other parameters");
  const std::span<const std::byte> payload = bytes.subspan(8 * header_words);
  if (header.value<std::uint64_t>() != payload.size()) header.fail("its length is wrong");
  if (header.value<std::uint64_t>() != checksum(payload)) header.fail("its checksum is wrong");

  Reader r(payload, label);
  MeshField f;
  f.key_ = key;
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
  if (!r.at_end()) r.fail("it is too long");
  f.validate(label);
  return f;
}

/// Every reference ends in something that exists, after at most levels_ steps; every number is finite.
void MeshField::validate(const std::string& label) const {
  const Reader r({}, label);
  const auto check = [&](bool holds, const char* why) {
    if (!holds) r.fail(why);
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
