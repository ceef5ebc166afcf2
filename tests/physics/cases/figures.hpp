#pragma once

#include "support/figure.hpp"

/// Pictures of the cases: runs of the simulator, drawn over the closed forms that they are held against.
namespace endowire::test {

[[nodiscard]] Figure tip_loaded_figure();        // V1
[[nodiscard]] Figure self_weight_figure();       // V2
[[nodiscard]] Figure roll_up_figure();           // V3
[[nodiscard]] Figure column_figure();            // V4
[[nodiscard]] Figure buckled_column_figure();    // V5
[[nodiscard]] Figure michell_ring_figure();      // V6
[[nodiscard]] Figure localised_rod_figure();     // V7
[[nodiscard]] Figure whip_figure();              // V8
[[nodiscard]] Figure whip_in_a_tube_figure();    // V8
[[nodiscard]] Figure helix_figure();             // V9
[[nodiscard]] Figure locking_helix_figure();     // V9
[[nodiscard]] Figure capstan_figure();           // V10
[[nodiscard]] Figure torus_figure();             // V11
[[nodiscard]] Figure curved_tip_figure();        // V12
[[nodiscard]] Figure three_point_bend_figure();  // V13
[[nodiscard]] Figure coaxial_figure();           // V14
[[nodiscard]] Figure facets_figure();            // V15
[[nodiscard]] Figure refinement_figure();        // V16
[[nodiscard]] Figure step_size_figure();         // V16

}  // namespace endowire::test
