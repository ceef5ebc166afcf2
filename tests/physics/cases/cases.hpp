#pragma once

#include "support/check.hpp"

/// The physics that the simulator is held against, each case a function that runs it and returns our numbers beside the closed
/// form. Tests assert them; the program write_validation prints them to docs/validation.md.
namespace endowire::test {

/// Rods of the cases of statics.
inline constexpr int kRods = 100;
/// Those of V7's localised shape, which has four turns and long straight ends.
inline constexpr int kLocalisedRods = 400;

[[nodiscard]] Checks tip_loaded_cantilever(int rods);   // V1
[[nodiscard]] Checks self_weight_cantilever(int rods);  // V2
[[nodiscard]] Checks roll_up(int rods);                 // V3
[[nodiscard]] Checks euler_column(int rods);            // V4
[[nodiscard]] Checks buckled_column(int rods);          // V5
[[nodiscard]] Checks michell_ring(int rods);            // V6
[[nodiscard]] Checks twisted_rod(int rods);             // V7
[[nodiscard]] Checks localised_rod(int rods);           // V7
[[nodiscard]] Checks whip_on_a_given_curve(int rods);   // V8
[[nodiscard]] Checks whip_in_a_tube();                  // V8
[[nodiscard]] Checks helix_in_a_cylinder();             // V9
[[nodiscard]] Checks locking_helix();                   // V9
[[nodiscard]] Checks capstan();                         // V10
[[nodiscard]] Checks insertion_into_a_bend();           // V11
[[nodiscard]] Checks insertion_into_a_torus();          // V11
[[nodiscard]] Checks curved_tip_at_a_wall();            // V12
[[nodiscard]] Checks three_point_bend(int rods);        // V13
[[nodiscard]] Checks coaxial_instruments(int rods);     // V14
[[nodiscard]] Checks coaxial_stiff_in_torsion();        // V14
[[nodiscard]] Checks coaxial_snap();                    // V14
[[nodiscard]] Checks analytic_fields();                 // V15
[[nodiscard]] Checks faceted_vessels();                 // V15
[[nodiscard]] Checks internal_balance();                // V16
[[nodiscard]] Checks balance_at_rest();                 // V16
[[nodiscard]] Checks work_in_and_out();                 // V16
[[nodiscard]] Checks rigid_motion();                    // V16
[[nodiscard]] Checks step_size_without_friction();      // V16
[[nodiscard]] Checks step_size_with_friction();         // V16
[[nodiscard]] Checks rod_length_in_contact();           // V16
[[nodiscard]] Checks remeshing();                       // V16

}  // namespace endowire::test
