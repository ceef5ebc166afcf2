#pragma once

namespace endowire::test {

/// V15: the field of a mesh beside that of the round shape it stands for, near the wall.
struct Facets {
  double sagitta_mm = 0.0;   ///< depth of its facets under the round shape
  double stated_mm = 0.0;    ///< error of interpolation, as the field says
  double error_mm = 0.0;     ///< largest, by comparison
  double slope_error = 0.0;  ///< mean of ||∇φ| − 1|
};
/// A tube of 3 mm radius and so many facets round.
[[nodiscard]] Facets facets_of_a_tube(int around);

}  // namespace endowire::test
