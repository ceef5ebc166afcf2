#pragma once

#include <optional>
#include <string>

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::vessel {

/// How wide and how long a vessel may be: from a coronary fragment's twigs to a chamber of the heart, and to a body.
inline constexpr double min_lumen_mm = 0.2;
inline constexpr double max_lumen_mm = 80.0;
inline constexpr double min_extent_mm = 5.0;
inline constexpr double max_extent_mm = 3000.0;

/// The unit of a mesh file, and why.
struct UnitChoice {
  LengthUnit unit = LengthUnit::millimetre;
  bool inferred = false;
  double lumen_mm = 0.0;               ///< median width between walls; of a vessel wall its thickness
  double extent_mm = 0.0;              ///< diagonal of the box around it
  std::optional<LengthUnit> second;    ///< another unit that is nearly as plausible
  std::optional<LengthUnit> likelier;  ///< a unit that is more plausible by far than the one declared
  double likelier_lumen_mm = 0.0;      ///< the width that the lumen would have in it

  /// "mm, inferred: the lumen is then 14.2 mm wide, the vessel 654 mm long"
  [[nodiscard]] std::string text() const;
  /// "; in cm the lumen would be 20 mm wide, which is likelier: say unit = "cm" if it is so"; empty when there is no such unit
  [[nodiscard]] std::string likelier_text() const;
};

/// The unit in which a vessel is as wide and as long as vessels are.
///
///   cost(u) = (ln D u/D₀)²/σ_D² + (ln L u/L₀)²/σ_L² + c_u,   least among the units that give a likely vessel
///
/// Symbols  D  median width between walls; L  diagonal of the box, both in units of the file
///          u  millimetres in the unit; D₀ = 6 mm, L₀ = 200 mm, σ_D = 1, σ_L = 0.65: estimates, that hold coronary and
///             cerebral arteries (D 1 … 4, L 60 … 150 mm) and the aorta (D 10 … 30, L 100 … 700 mm) alike
///          c_u  0; for centimetres 5: files in them are rare
/// @param soup      triangles in units of the file, vertices shared or not, facing anywhere
/// @param declared  the unit that the user or the file names: held against what is possible
/// @throws base::InputError when the vessel is impossible in the unit declared, or in all; it names the factor that would
///                          make it one
[[nodiscard]] UnitChoice choose_unit(const TriangleMesh& soup, std::optional<LengthUnit> declared,
                                     const std::string& file_label);

/// The mesh with its vertices in millimetres.
[[nodiscard]] TriangleMesh in_millimetres(TriangleMesh mesh, LengthUnit unit);

}  // namespace endowire::vessel
