#pragma once

#include <array>
#include <string_view>

namespace endowire::bench {

/// What a part may take: measured on a 2-core AVX-512 machine for one Newton iteration of an inextensible rod with twist, four unknowns a
/// joint, with vectorised derivatives and a blocked band solver. An iteration is to cost at most twice their sum.
struct Limit {
  std::string_view part;  ///< a benchmark of bench_parts
  int joints;
  double us;
};

inline constexpr std::array<Limit, 9> limits{{{"kinematics", 100, 0.6},
                                              {"kinematics", 300, 1.7},
                                              {"kinematics", 1000, 5.8},
                                              {"joint_derivatives", 100, 9.0},
                                              {"joint_derivatives", 300, 26.0},
                                              {"joint_derivatives", 1000, 86.0},
                                              {"band_factorise_and_solve", 100, 4.6},
                                              {"band_factorise_and_solve", 300, 14.0},
                                              {"band_factorise_and_solve", 1000, 47.0}}};

/// A lookup of distance and gradient in a sparse field of bricks. [µs]
inline constexpr double lookup_us = 0.017;

}  // namespace endowire::bench
