#pragma once

#include <array>

#include "endowire/vessel/anatomy/parameters.hpp"

namespace endowire::vessel::anatomy {

/// Above the pelvis, in every anatomy with a femoral access.
inline constexpr Parameter infrarenal_diameter{
    "infrarenal_diameter_mm",
    "mm",
    17.0,
    13.0,
    21.0,
    false,
    Trait::calibre,
    "aorta below the renal arteries",
    "Kim2022: 17.5 +- 2.1; Jasper2014: 13.8 (men); Joh2013: 19.0 (men)"};

/// Of the access, where vessels end in the groins.
inline constexpr Parameter sheath_depth{"sheath_depth_mm",
                                        "mm",
                                        40,
                                        10,
                                        60,
                                        false,
                                        Trait::own,
                                        "of the access in the right external iliac, from its end",
                                        "estimate: a sheath of 110 mm from the groin"};

/// Of the pelvis, in every anatomy with a femoral access; see iliac.hpp.
inline constexpr std::array iliac_parameters{
    Parameter{"aortic_bifurcation_deg", "deg", 50, 25, 61, false, Trait::own,
              "between the common iliac arteries",
              "Bargeron1986: 35 +- 11, 10 to 61; default: estimate, wider in life than in casts"},
    Parameter{"common_iliac_diameter_mm", "mm", 10.5, 8.0, 13.0, false, Trait::calibre,
              "common iliac arteries", "Kim2022: 10.9 +- 1.7; Joh2013: 12.2 (men); Mirza2022: 9.0"},
    Parameter{"common_iliac_length_mm", "mm", 54, 36, 75, false, Trait::stature,
              "from the aortic bifurcation", "Katara2023: 55 +- 12 (men), 44 +- 11 (women), left"},
    Parameter{"external_iliac_diameter_mm", "mm", 7.8, 6.0, 10.0, false, Trait::calibre,
              "external iliac arteries", "Mirza2022: 7.5; Lorbeer2018: 10.3 is the 95th percentile"},
    Parameter{"external_iliac_length_mm", "mm", 88, 66, 110, false, Trait::stature, "external iliac arteries",
              "Katara2023: 88 +- 11 (men, left)"},
    Parameter{"internal_iliac_diameter_mm", "mm", 5.6, 4.0, 7.5, false, Trait::calibre,
              "internal iliac arteries", "Lorbeer2018: 7.5 is the 95th percentile; default: estimate"},
    Parameter{"internal_iliac_length_mm", "mm", 40, 22, 60, false, Trait::stature,
              "internal iliac arteries, as far as they are undivided", "Katara2023: 41 +- 10 (men, left)"},
    Parameter{"aortic_carina_radius_mm", "mm", 1.5, 0.8, 2.5, false, Trait::own, "of the aortic bifurcation",
              "estimate, unreported: a third to a half of the branch's radius"},
    Parameter{"iliac_carina_radius_mm", "mm", 1.2, 0.8, 2.0, false, Trait::own,
              "where the internal iliac arteries leave",
              "estimate, unreported: a third to a half of the branch's radius"},
};

/// Branches are narrower than what they leave.
inline constexpr std::array iliac_order{
    Narrower{"common_iliac_diameter_mm", "infrarenal_diameter_mm", 0.85},
    Narrower{"external_iliac_diameter_mm", "common_iliac_diameter_mm", 0.95},
    Narrower{"internal_iliac_diameter_mm", "common_iliac_diameter_mm", 0.8},
};

}  // namespace endowire::vessel::anatomy
