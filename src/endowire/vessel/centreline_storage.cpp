#include <cmath>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/storage.hpp"

namespace endowire::vessel {
namespace {

using Index = std::int32_t;

constexpr StorageKind prepared_tree{0x4552544552495745ULL, 1, "prepared centreline tree"};  // "EWIRETRE"
constexpr std::size_t max_name = 4096;  // bytes; a name grows by a number per generation

void put(StorageWriter& w, const std::string& text) {
  w.values(std::vector<char>(text.begin(), text.end()));
}

std::string get_text(StorageReader& r) {
  const std::vector<char> text = r.values<char>();
  if (text.size() > max_name) r.fail("a name is absurdly long");
  return {text.begin(), text.end()};
}

void put(StorageWriter& w, const CentrelineBranch& b) {
  put(w, b.name);
  put(w, b.vessel);
  for (Index v : {b.parent, b.from_bifurcation, b.to_bifurcation}) w.value(v);
  w.values(b.children);
  for (std::size_t v : {b.first_point, b.points}) w.value(static_cast<std::uint64_t>(v));
  for (double v : {b.from_root_mm, b.length_mm, b.tortuosity, b.ostium_arc_mm, b.cap_mm, b.min_radius_mm,
                   b.mean_radius_mm, b.max_radius_mm})
    w.value(v);
}

CentrelineBranch get_branch(StorageReader& r) {
  CentrelineBranch b;
  b.name = get_text(r);
  b.vessel = get_text(r);
  for (Index* v : {&b.parent, &b.from_bifurcation, &b.to_bifurcation}) *v = r.value<Index>();
  b.children = r.values<Index>();
  b.first_point = static_cast<std::size_t>(r.value<std::uint64_t>());
  b.points = static_cast<std::size_t>(r.value<std::uint64_t>());
  for (double* v : {&b.from_root_mm, &b.length_mm, &b.tortuosity, &b.ostium_arc_mm, &b.cap_mm,
                    &b.min_radius_mm, &b.mean_radius_mm, &b.max_radius_mm})
    *v = r.value<double>();
  return b;
}

void put(StorageWriter& w, const CentrelinePoint& p) {
  w.vector(p.position_mm);
  w.value(p.radius_mm);
  w.value(p.arc_mm);
  w.vector(p.tangent);
  w.vector(p.curvature_per_mm);
}

CentrelinePoint get_point(StorageReader& r) {
  CentrelinePoint p;
  p.position_mm = r.vector();
  p.radius_mm = r.value<double>();
  p.arc_mm = r.value<double>();
  p.tangent = r.vector();
  p.curvature_per_mm = r.vector();
  return p;
}

void put(StorageWriter& w, const CentrelineEnd& e) {
  w.value(static_cast<std::uint8_t>(e.kind));
  w.value(static_cast<std::uint8_t>(e.root ? 1 : 0));
  w.value(static_cast<std::int32_t>(e.opening));
  w.value(e.branch);
  w.vector(e.position_mm);
  w.vector(e.direction);
  w.value(e.radius_mm);
  w.value(e.rejoins);
  w.value(e.rejoins_arc_mm);
}

CentrelineEnd get_end(StorageReader& r) {
  CentrelineEnd e;
  const auto kind = r.value<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(CentrelineEndKind::cut)) r.fail("an end is of no known kind");
  e.kind = static_cast<CentrelineEndKind>(kind);
  e.root = r.value<std::uint8_t>() != 0;
  e.opening = r.value<std::int32_t>();
  e.branch = r.value<Index>();
  e.position_mm = r.vector();
  e.direction = r.vector();
  e.radius_mm = r.value<double>();
  e.rejoins = r.value<Index>();
  e.rejoins_arc_mm = r.value<double>();
  return e;
}

void put(StorageWriter& w, const CentrelineBifurcation& b) {
  w.vector(b.position_mm);
  w.value(b.radius_mm);
  w.value(b.parent);
  w.values(b.children);
}

CentrelineBifurcation get_bifurcation(StorageReader& r) {
  CentrelineBifurcation b;
  b.position_mm = r.vector();
  b.radius_mm = r.value<double>();
  b.parent = r.value<Index>();
  b.children = r.values<Index>();
  return b;
}

/// Arrays of records, their count first; an element takes at least `bytes`.
template <typename T, typename Get>
std::vector<T> get_all(StorageReader& r, std::size_t bytes, Get get) {
  const std::size_t count = r.size_of_array(bytes);
  std::vector<T> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) all.push_back(get(r));
  return all;
}

template <typename T>
void put_all(StorageWriter& w, const std::vector<T>& all) {
  w.value(static_cast<std::uint64_t>(all.size()));
  for (const T& one : all) put(w, one);
}

}  // namespace

std::vector<std::byte> CentrelineTree::serialise(std::uint64_t key) const {
  StorageWriter w(prepared_tree, key,
                  points_.size() * sizeof(CentrelinePoint) + branches_.size() * 256 + 1024);
  put_all(w, branches_);
  put_all(w, points_);
  put_all(w, bifurcations_);
  put_all(w, ends_);
  return w.seal();
}

CentrelineTree CentrelineTree::deserialise(std::span<const std::byte> bytes, std::uint64_t expected_key,
                                           const std::string& label) {
  StorageReader r(bytes, prepared_tree, expected_key, label);
  auto branches = get_all<CentrelineBranch>(r, 100, get_branch);
  auto points = get_all<CentrelinePoint>(r, 88, get_point);
  auto bifurcations = get_all<CentrelineBifurcation>(r, 44, get_bifurcation);
  auto ends = get_all<CentrelineEnd>(r, 78, get_end);
  r.expect_end();
  return {std::move(branches), std::move(points), std::move(bifurcations), std::move(ends), label};
}

/// Every query can rely on this: parents before children, points in a row, lengths that grow, numbers finite.
void CentrelineTree::validate(const std::string& label) const {
  const auto check = [&](bool holds, const char* why) {
    if (!holds) StorageReader::fail(prepared_tree, label, why);
  };
  const auto count = static_cast<Index>(branches_.size());
  const auto forks = static_cast<Index>(bifurcations_.size());
  check(points_.size() < (std::size_t{1} << 31) && branches_.size() < (std::size_t{1} << 31),
        "it is absurdly large");
  std::size_t next_point = 0;
  for (Index b = 0; b < count; ++b) {
    const CentrelineBranch& branch = branches_[static_cast<std::size_t>(b)];
    check(branch.parent >= -1 && branch.parent < b, "a branch stands before its parent");
    check(branch.first_point == next_point && branch.points >= 2 &&
              branch.points <= points_.size() - next_point,
          "its points do not match its branches");
    next_point += branch.points;
    check(branch.from_bifurcation >= -1 && branch.from_bifurcation < forks && branch.to_bifurcation >= -1 &&
              branch.to_bifurcation < forks,
          "a branch refers to nothing");
    for (Index child : branch.children)
      check(child > b && child < count && branches_[static_cast<std::size_t>(child)].parent == b,
            "a branch is not its child's parent");
    check(std::isfinite(branch.from_root_mm + branch.length_mm + branch.tortuosity + branch.ostium_arc_mm +
                        branch.cap_mm + branch.min_radius_mm + branch.mean_radius_mm + branch.max_radius_mm),
          "a branch is not finite");
    for (std::size_t i = 0; i < branch.points; ++i) {
      const CentrelinePoint& p = points_[branch.first_point + i];
      check(p.position_mm.allFinite() && p.tangent.allFinite() && p.curvature_per_mm.allFinite() &&
                std::isfinite(p.radius_mm + p.arc_mm),
            "a point is not finite");
      check(i == 0 ? p.arc_mm == 0.0 : p.arc_mm > points_[branch.first_point + i - 1].arc_mm,
            "the arc of a branch does not grow");
    }
    check(std::abs(points_[next_point - 1].arc_mm - branch.length_mm) <= 1e-9 * (1.0 + branch.length_mm),
          "a branch is not as long as its points");
  }
  check(next_point == points_.size(), "its points do not match its branches");
  for (const CentrelineBifurcation& f : bifurcations_) {
    check(f.position_mm.allFinite() && std::isfinite(f.radius_mm), "a bifurcation is not finite");
    check(f.parent >= 0 && f.parent < count, "a bifurcation refers to nothing");
    for (Index child : f.children) check(child >= 0 && child < count, "a bifurcation refers to nothing");
  }
  for (const CentrelineEnd& e : ends_) {
    check(e.branch >= 0 && e.branch < count && e.rejoins >= -1 && e.rejoins < count,
          "an end refers to nothing");
    check(
        e.position_mm.allFinite() && e.direction.allFinite() && std::isfinite(e.radius_mm + e.rejoins_arc_mm),
        "an end is not finite");
  }
}

}  // namespace endowire::vessel
