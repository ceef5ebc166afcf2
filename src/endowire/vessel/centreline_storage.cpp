#include <cmath>
#include <concepts>

#include "endowire/vessel/centreline_tree.hpp"
#include "endowire/vessel/storage.hpp"

namespace endowire::vessel {
namespace {

using Index = std::int32_t;

constexpr StorageKind prepared_tree{0x4552544552495745ULL, 1, "prepared centreline tree"};  // "EWIRETRE"
constexpr std::size_t max_name = 4096;  // bytes; a name grows by a number per generation

template <class T, class Record>
concept Of = std::same_as<std::remove_const_t<T>, Record>;

// The members of each record, in the order of the file: `file` writes them or reads them.

void members(auto& file, Of<CentrelineBranch> auto& b) {
  file(b.name, b.vessel, b.parent, b.from_bifurcation, b.to_bifurcation, b.children, b.first_point, b.points,
       b.from_root_mm, b.length_mm, b.tortuosity, b.ostium_arc_mm, b.cap_mm, b.min_radius_mm,
       b.mean_radius_mm, b.max_radius_mm);
}

void members(auto& file, Of<CentrelinePoint> auto& p) {
  file(p.position_mm, p.radius_mm, p.arc_mm, p.tangent, p.curvature_per_mm);
}

void members(auto& file, Of<CentrelineBifurcation> auto& b) {
  file(b.position_mm, b.radius_mm, b.parent, b.children);
}

void members(auto& file, Of<CentrelineEnd> auto& e) {
  file(e.kind, e.root, e.opening, e.branch, e.position_mm, e.direction, e.radius_mm, e.rejoins,
       e.rejoins_arc_mm);
}

class Writing {
 public:
  explicit Writing(StorageWriter& w) : w_(w) {}
  template <class... Members>
  void operator()(const Members&... all) {
    (put(all), ...);
  }

 private:
  void put(double v) { w_.value(v); }
  void put(Index v) { w_.value(v); }
  void put(std::size_t v) { w_.value(static_cast<std::uint64_t>(v)); }
  void put(bool v) { w_.value(static_cast<std::uint8_t>(v ? 1 : 0)); }
  void put(CentrelineEndKind v) { w_.value(static_cast<std::uint8_t>(v)); }
  void put(const Eigen::Vector3d& v) { w_.vector(v); }
  void put(const std::vector<Index>& v) { w_.values(v); }
  void put(const std::string& v) { w_.values(std::vector<char>(v.begin(), v.end())); }

  StorageWriter& w_;
};

class Reading {
 public:
  explicit Reading(StorageReader& r) : r_(r) {}
  template <class... Members>
  void operator()(Members&... all) {
    (get(all), ...);
  }

 private:
  void get(double& v) { v = r_.value<double>(); }
  void get(Index& v) { v = r_.value<Index>(); }
  void get(std::size_t& v) { v = static_cast<std::size_t>(r_.value<std::uint64_t>()); }
  void get(bool& v) { v = r_.value<std::uint8_t>() != 0; }
  void get(CentrelineEndKind& v) {
    const auto kind = r_.value<std::uint8_t>();
    if (kind > static_cast<std::uint8_t>(CentrelineEndKind::cut)) r_.fail("an end is of no known kind");
    v = static_cast<CentrelineEndKind>(kind);
  }
  void get(Eigen::Vector3d& v) { v = r_.vector(); }
  void get(std::vector<Index>& v) { v = r_.values<Index>(); }
  void get(std::string& v) {
    const std::vector<char> text = r_.values<char>();
    if (text.size() > max_name) r_.fail("a name is absurdly long");
    v.assign(text.begin(), text.end());
  }

  StorageReader& r_;
};

/// Arrays of records, their count first; an element takes at least `bytes`.
template <typename T>
std::vector<T> get_all(StorageReader& r, std::size_t bytes) {
  std::vector<T> all(r.size_of_array(bytes));
  Reading reading(r);
  for (T& one : all) members(reading, one);
  return all;
}

template <typename T>
void put_all(StorageWriter& w, const std::vector<T>& all) {
  w.value(static_cast<std::uint64_t>(all.size()));
  Writing writing(w);
  for (const T& one : all) members(writing, one);
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
  auto branches = get_all<CentrelineBranch>(r, 100);
  auto points = get_all<CentrelinePoint>(r, 88);
  auto bifurcations = get_all<CentrelineBifurcation>(r, 44);
  auto ends = get_all<CentrelineEnd>(r, 78);
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
