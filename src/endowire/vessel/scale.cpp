#include "endowire/vessel/scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/vessel/bvh.hpp"
#include "endowire/vessel/mesh_text.hpp"

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

constexpr std::size_t max_samples = 1500;  // of a median that is wanted to some per cent
constexpr double usual_lumen_mm = 6.0;
constexpr double usual_extent_mm = 200.0;
constexpr double extent_spread = 0.65;  // of the logarithm; that of the lumen is 1
/// A difference of cost below which the runner-up is named: odds of one in ten.
constexpr double nearly_as_good = 4.6;

/// A vessel that is possible yet as odd as this is not inferred: its unit has to be declared.
constexpr double max_inferred_lumen_mm = 45.0;  // half the wall of a vessel tree is never that of a chamber
constexpr double max_inferred_cost = 30.0;

constexpr std::array<LengthUnit, 3> units{LengthUnit::millimetre, LengthUnit::metre, LengthUnit::centimetre};

double rarity(LengthUnit unit) {
  return unit == LengthUnit::centimetre ? 5.0 : 0.0;
}

/// Width and length in units of the file.
struct Measures {
  double lumen = 0.0;
  double extent = 0.0;

  [[nodiscard]] double cost(double factor) const {
    const double d = std::log(lumen * factor / usual_lumen_mm);
    const double l = std::log(extent * factor / usual_extent_mm) / extent_spread;
    return d * d + l * l;
  }
  [[nodiscard]] bool possible(double factor) const {
    return lumen * factor >= min_lumen_mm && lumen * factor <= max_lumen_mm &&
           extent * factor >= min_extent_mm && extent * factor <= max_extent_mm;
  }
  [[nodiscard]] bool likely(double factor) const {
    return possible(factor) && lumen * factor <= max_inferred_lumen_mm && cost(factor) <= max_inferred_cost;
  }
};

Measures measure(const TriangleMesh& soup) {
  Measures measures;
  measures.extent = bounds_mm(soup).diagonal().norm();
  const TriangleBvh bvh(soup);
  const double away = 1e-7 * measures.extent;
  double total = 0.0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) total += soup.area_normal(t).norm();
  const double step = total / static_cast<double>(max_samples);
  std::vector<double> widths;
  double sum = 0.0;
  double next = 0.5 * step;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Vector3d normal = soup.area_normal(t);
    sum += normal.norm();
    if (!(next < sum)) continue;
    while (next < sum) next += step;
    const Vector3d centre = (soup.corner(t, 0) + soup.corner(t, 1) + soup.corner(t, 2)) / 3.0;
    const Vector3d along = normal.stableNormalized();
    // Which side is the lumen is not known yet; the nearer wall is before it more often than not.
    double width = std::numeric_limits<double>::infinity();
    for (const double side : {-1.0, 1.0}) {
      const TriangleBvh::Hit hit =
          bvh.cast(centre, side * along, away, std::numeric_limits<double>::infinity());
      if (hit.triangle >= 0) width = std::min(width, hit.distance_mm);
    }
    if (std::isfinite(width)) widths.push_back(width);
  }
  if (widths.empty()) return measures;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  measures.lumen = *middle;
  return measures;
}

struct Scale {
  double millimetres;
  const char* saved_in;
  const char* unit;  ///< what to write; null: no unit that can be named
};
constexpr std::array<Scale, 5> scales{{{1.0, "millimetres", "mm"},
                                       {1000.0, "metres", "m"},
                                       {10.0, "centimetres", "cm"},
                                       {25.4, "inches", nullptr},
                                       {0.001, "micrometres", nullptr}}};

[[noreturn]] void refuse(const Measures& measures, LengthUnit read_in, const std::string& file_label) {
  const double factor = millimetres_in(read_in);
  std::string message = file_label + ": in " + std::string(name_of(read_in)) + " the lumen is " +
                        rounded(measures.lumen * factor) + " mm wide and the vessel " +
                        rounded(measures.extent * factor) + " mm long; must be " + rounded(min_lumen_mm) +
                        " … " + rounded(max_lumen_mm) + " mm and " + rounded(min_extent_mm) + " … " +
                        rounded(max_extent_mm) + " mm";
  const Scale* best = nullptr;
  for (const Scale& scale : scales)
    if (scale.millimetres != factor && measures.possible(scale.millimetres) &&
        (best == nullptr || measures.cost(scale.millimetres) < measures.cost(best->millimetres)))
      best = &scale;
  if (best != nullptr) {
    message += "; " + rounded(best->millimetres / factor) + " times as large it would be: was it saved in " +
               best->saved_in + "?";
    message += best->unit != nullptr ? std::string(" then unit = \"") + best->unit + "\""
                                     : " then scale it to mm first";
  }
  throw base::InputError(message);
}

}  // namespace

std::string UnitChoice::text() const {
  std::string text(name_of(unit));
  if (!inferred) return text + ", as declared" + likelier_text();
  text += ", inferred: the lumen is then " + rounded(lumen_mm) + " mm wide, the vessel " +
          rounded(extent_mm) + " mm long";
  if (second) text += " (" + std::string(name_of(*second)) + " would be possible too: say which)";
  return text;
}

std::string UnitChoice::likelier_text() const {
  if (!likelier) return {};
  return "; the lumen is then " + rounded(lumen_mm) + " mm wide, in " + std::string(name_of(*likelier)) +
         " it would be " + rounded(likelier_lumen_mm) + " mm, which is likelier: if so, unit = \"" +
         std::string(name_of(*likelier)) + "\"";
}

UnitChoice choose_unit(const TriangleMesh& soup, std::optional<LengthUnit> declared,
                       const std::string& file_label) {
  const Measures measures = measure(soup);
  if (!(measures.lumen > 0.0))
    throw base::InputError(file_label + ": no wall lies across from any other, from " +
                           place_text(bounds_mm(soup).min()) + " to " + place_text(bounds_mm(soup).max()) +
                           "; must be the surface of a lumen");
  UnitChoice choice;
  choice.inferred = !declared;
  if (declared) {
    if (!measures.possible(millimetres_in(*declared))) refuse(measures, *declared, file_label);
    choice.unit = *declared;
    double least = measures.cost(millimetres_in(*declared)) - nearly_as_good;
    for (const LengthUnit other : units) {
      const double factor = millimetres_in(other);
      const double cost = measures.cost(factor) + rarity(other);
      if (other == *declared || !measures.likely(factor) || cost >= least) continue;
      least = cost;
      choice.likelier = other;
      choice.likelier_lumen_mm = measures.lumen * factor;
    }
  } else {
    std::array<double, units.size()> costs{};
    std::size_t best = 0;
    for (std::size_t k = 0; k < units.size(); ++k) {
      const double factor = millimetres_in(units[k]);
      costs[k] = measures.likely(factor) ? measures.cost(factor) + rarity(units[k])
                                         : std::numeric_limits<double>::infinity();
      if (costs[k] < costs[best]) best = k;
    }
    if (!std::isfinite(costs[best])) refuse(measures, LengthUnit::millimetre, file_label);
    choice.unit = units[best];
    for (std::size_t k = 0; k < units.size(); ++k)
      if (k != best && costs[k] < costs[best] + nearly_as_good) choice.second = units[k];
  }
  choice.lumen_mm = measures.lumen * millimetres_in(choice.unit);
  choice.extent_mm = measures.extent * millimetres_in(choice.unit);
  return choice;
}

TriangleMesh in_millimetres(TriangleMesh mesh, LengthUnit unit) {
  const double factor = millimetres_in(unit);
  if (factor != 1.0)
    for (Vector3d& v : mesh.vertices_mm) v *= factor;
  return mesh;
}

}  // namespace endowire::vessel
