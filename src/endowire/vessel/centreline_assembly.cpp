#include "endowire/vessel/centreline_assembly.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;
using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

class Assembly {
 public:
  explicit Assembly(const std::vector<PlacedLine>& lines)
      : lines_(lines), children_(lines.size()), first_branch_(lines.size(), -1), cuts_(lines.size()) {
    for (std::size_t l = 0; l < lines_.size(); ++l)
      if (lines_[l].parent >= 0) children_[at(lines_[l].parent)].push_back(static_cast<Index>(l));
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      std::stable_sort(children_[l].begin(), children_[l].end(), [&](Index a, Index b) {
        if (lines_[at(a)].leaves_at != lines_[at(b)].leaves_at)
          return lines_[at(a)].leaves_at < lines_[at(b)].leaves_at;
        return end_radius_mm(lines_[at(a)].fit) > end_radius_mm(lines_[at(b)].fit);
      });
      for (Index child : children_[l]) {
        const std::size_t place = lines_[at(child)].leaves_at;
        if (cuts_[l].empty() || cuts_[l].back() != place) cuts_[l].push_back(place);
      }
    }
  }

  CentrelineTree build() {
    int vessel = 0;
    for (std::size_t l = 0; l < lines_.size(); ++l)
      if (lines_[l].parent < 0) add_vessel(static_cast<Index>(l), std::to_string(++vessel), -1);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      if (lines_[l].parent < 0) add_ends(static_cast<Index>(l));
    return {std::move(branches_), std::move(points_), std::move(bifurcations_), std::move(ends_),
            "centrelines"};
  }

 private:
  static double end_radius_mm(const FittedLine& fit) {
    const double arc_mm = fit.points.back().arc_mm - fit.end_cap_mm;
    const auto there = std::find_if(fit.points.begin(), fit.points.end(),
                                    [&](const CentrelinePoint& p) { return p.arc_mm >= arc_mm - 1e-9; });
    return there == fit.points.end() ? fit.points.back().radius_mm : there->radius_mm;
  }

  /// The stretches of a vessel, each followed by what leaves it.
  void add_vessel(Index index, const std::string& name, Index parent_branch) {
    const PlacedLine& line = lines_[at(index)];
    const std::size_t last = line.fit.points.size() - 1;
    first_branch_[at(index)] = static_cast<Index>(branches_.size());
    std::vector<std::size_t> places{0};
    places.insert(places.end(), cuts_[at(index)].begin(), cuts_[at(index)].end());
    places.push_back(last);
    Index parent = parent_branch;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      add_branch(index, places[k], places[k + 1], parent);
      CentrelineBranch& branch = branches_.back();
      branch.vessel = name;
      branch.name = places.size() > 2 ? name + ":" + std::to_string(k + 1) : name;
      parent = static_cast<Index>(branches_.size() - 1);
    }
    int number = 0;
    for (Index child : children_[at(index)]) {
      const std::size_t place = lines_[at(child)].leaves_at;
      const auto stretch = std::find(places.begin(), places.end(), place) - places.begin();
      add_vessel(child, name + "." + std::to_string(++number),
                 first_branch_[at(index)] + static_cast<Index>(stretch) - 1);
    }
  }

  void add_branch(Index index, std::size_t from, std::size_t to, Index parent) {
    const PlacedLine& line = lines_[at(index)];
    const std::vector<CentrelinePoint>& all = line.fit.points;
    CentrelineBranch branch;
    const double begin_mm = all[from].arc_mm;
    branch.first_point = points_.size();
    branch.points = to - from + 1;
    branch.length_mm = all[to].arc_mm - begin_mm;
    const double chord_mm = (all[to].position_mm - all[from].position_mm).norm();
    branch.tortuosity = chord_mm > 0.0 ? std::max(1.0, branch.length_mm / chord_mm) : 1.0;
    branch.ostium_arc_mm = std::clamp(line.fit.ostium_arc_mm - begin_mm, 0.0, branch.length_mm);
    const double start_cap_mm = from == 0 ? line.fit.start_cap_mm : 0.0;
    const double end_cap_mm = to + 1 == all.size() ? line.fit.end_cap_mm : 0.0;
    branch.cap_mm = std::max(start_cap_mm, end_cap_mm);
    for (std::size_t i = from; i <= to; ++i) {
      points_.push_back(all[i]);
      points_.back().arc_mm -= begin_mm;
    }
    measure(branch, std::max(branch.ostium_arc_mm, start_cap_mm), branch.length_mm - end_cap_mm);
    const auto id = static_cast<Index>(branches_.size());
    if (parent >= 0) {
      branch.parent = parent;
      CentrelineBranch& before = branches_[at(parent)];
      branch.from_root_mm = before.from_root_mm + before.length_mm;
      if (before.to_bifurcation < 0) {
        before.to_bifurcation = static_cast<Index>(bifurcations_.size());
        bifurcations_.push_back({all[from].position_mm, all[from].radius_mm, parent, {}});
      }
      branch.from_bifurcation = before.to_bifurcation;
      before.children.push_back(id);
      bifurcations_[at(before.to_bifurcation)].children.push_back(id);
    }
    branches_.push_back(std::move(branch));
  }

  /// Radii between two arcs, where the lumen is the branch's own; of the whole branch where nothing is.
  void measure(CentrelineBranch& branch, double from_mm, double to_mm) const {
    const CentrelinePoint* p = points_.data() + branch.first_point;
    const auto own = [&](std::size_t i) {
      return (p[i].arc_mm >= from_mm - 1e-9 && p[i].arc_mm <= to_mm + 1e-9) || from_mm >= to_mm;
    };
    double sum = 0.0;
    double weights = 0.0;
    branch.min_radius_mm = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < branch.points; ++i) {
      if (!own(i)) continue;
      const double before = i == 0 ? 0.0 : p[i].arc_mm - p[i - 1].arc_mm;
      const double after = i + 1 == branch.points ? 0.0 : p[i + 1].arc_mm - p[i].arc_mm;
      sum += (before + after) * p[i].radius_mm;
      weights += before + after;
      branch.min_radius_mm = std::min(branch.min_radius_mm, p[i].radius_mm);
      branch.max_radius_mm = std::max(branch.max_radius_mm, p[i].radius_mm);
    }
    if (weights == 0.0) {
      branch.min_radius_mm = branch.max_radius_mm = sum = p[branch.points - 1].radius_mm;
      weights = 1.0;
    }
    branch.mean_radius_mm = sum / weights;
  }

  /// The ends of a vessel and of those that leave it, the root first.
  void add_ends(Index index) {
    const PlacedLine& line = lines_[at(index)];
    if (line.parent < 0 && line.root_is_end) {
      CentrelineEnd root;
      root.kind = line.root_opening > 0 ? CentrelineEndKind::opening : CentrelineEndKind::cap;
      root.opening = line.root_opening;
      root.branch = first_branch_[at(index)];
      root.root = true;
      root.position_mm = line.fit.points.front().position_mm;
      root.direction = -line.fit.points.front().tangent;
      const auto there =
          std::find_if(line.fit.points.begin(), line.fit.points.end(),
                       [&](const CentrelinePoint& p) { return p.arc_mm >= line.fit.start_cap_mm - 1e-9; });
      root.radius_mm = there->radius_mm;
      ends_.push_back(root);
    }
    CentrelineEnd end;
    end.kind = line.end;
    end.opening = line.opening;
    end.branch = first_branch_[at(index)] + static_cast<Index>(cuts_[at(index)].size());
    end.position_mm = line.fit.points.back().position_mm;
    end.direction = line.fit.points.back().tangent;
    end.radius_mm = end_radius_mm(line.fit);
    if (line.rejoins >= 0) rejoin(line, end);
    ends_.push_back(end);
    for (Index child : children_[at(index)]) add_ends(child);
  }

  void rejoin(const PlacedLine& line, CentrelineEnd& end) const {
    const auto first = at(first_branch_[at(line.rejoins)]);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = first; b < branches_.size() && branches_[b].vessel == branches_[first].vessel; ++b) {
      for (std::size_t i = 0; i < branches_[b].points; ++i) {
        const CentrelinePoint& p = points_[branches_[b].first_point + i];
        const double distance = (p.position_mm - line.rejoins_mm).norm();
        if (distance >= least) continue;
        least = distance;
        end.rejoins = static_cast<Index>(b);
        end.rejoins_arc_mm = p.arc_mm;
      }
    }
  }

  const std::vector<PlacedLine>& lines_;
  std::vector<std::vector<Index>> children_;  ///< of each line, in the order they leave it
  std::vector<Index> first_branch_;
  std::vector<std::vector<std::size_t>> cuts_;
  std::vector<CentrelineBranch> branches_;
  std::vector<CentrelinePoint> points_;
  std::vector<CentrelineBifurcation> bifurcations_;
  std::vector<CentrelineEnd> ends_;
};

}  // namespace

CentrelineTree assemble_tree(const std::vector<PlacedLine>& lines) {
  return Assembly(lines).build();
}

}  // namespace endowire::vessel
