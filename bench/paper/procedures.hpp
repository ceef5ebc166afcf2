#pragma once

#include <string>
#include <vector>

#include "procedure.hpp"

namespace endowire::paper {

/// A tube that bends by 180° on a circle; the closed form of its wall, no mesh.
struct Bend {
  double radius_mm = 10.0;  ///< of the axis
  double lumen_mm = 3.0;    ///< diameter

  /// The longest straight rod that fits into it round the bend, both ends on the outer wall and the middle on the inner one.
  [[nodiscard]] double longest_rod_mm() const;
};

/// A 0.014" wire is pushed through a bend until 30 mm of it lie beyond.
[[nodiscard]] Procedure push_through(const Bend& bend);
/// The same through a tube of triangles, 24 around.
[[nodiscard]] Procedure push_through_mesh(const Bend& bend);

/// A 0.014" wire of the stiffness of a soft microwire; a straight tip, so that nothing but the bend bends it.
[[nodiscard]] rod::Instrument straight_microwire();
/// The same with a tip of 8 mm that is curved by 50°, and a shaft that stiffens.
[[nodiscard]] rod::Instrument curved_microwire();

/// The procedure with the wire turned by so much at its beginning.
[[nodiscard]] Procedure turned(Procedure procedure, double turn_deg);

/// One of scenes/*.toml that ship, or a path.
[[nodiscard]] Procedure shipped_scene(const std::string& file);
/// A curved microwire is pushed into a generated vessel, turned by some degrees with every millimetre.
[[nodiscard]] Procedure push_into(const std::string& anatomy, double advance_mm, double turn_deg_per_mm);

}  // namespace endowire::paper
