#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/anatomy_measures.hpp"
#include "support/mesh_facts.hpp"

namespace endowire::test {

// What holds for every generated vessel.

inline const std::array<const char*, 5> generator_names{"aortic_arch", "iliofemoral", "renal", "coronary",
                                                        "carotid_siphon"};

/// Manifold, one piece, outward, a border per vessel end and no slivers.
inline void expect_sound_mesh(const vessel::GeneratedVessel& made, bool closed) {
  const MeshFacts facts = facts_of(made.mesh);
  std::size_t ends = 0;
  for (const vessel::Landmark& mark : made.landmarks) {
    const std::string& name = mark.name;
    ends += name.ends_with(" end") || name == "aortic root" || name == "annulus" ? 1U : 0U;
  }
  EXPECT_EQ(facts.bad_edges, 0U);
  EXPECT_EQ(facts.pinched, 0U);
  EXPECT_EQ(facts.components, 1U);
  EXPECT_EQ(facts.borders, closed ? 0 : ends);
  EXPECT_EQ(facts.euler, 2 - static_cast<long>(facts.borders));  // a sphere with a hole per end: no handles
  EXPECT_GT(facts.least_angle_deg, 15.0);
  EXPECT_GT(facts.first_percent_angle_deg, 35.0);
  EXPECT_GT(signed_volume_mm3(made.mesh), 0.0);
  vessel::anatomy::Plan plan;
  plan.branches = made.branches;
  const vessel::anatomy::LumenShape shape = shape_of(plan);
  for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
    const Eigen::Vector3d middle =
        (made.mesh.corner(t, 0) + made.mesh.corner(t, 1) + made.mesh.corner(t, 2)) / 3.0;
    const Eigen::Vector3d out = shape.at(middle).gradient;
    ASSERT_GT(made.mesh.area_normal(t).normalized().dot(out), 0.5) << "turned over at " << middle.transpose();
  }
}

/// Every number that it was made with is found again: calibres on the triangles, lengths and angles on the axes, all
/// within 5 % (small angles within 1°; an opening, of the turn that leaves it); the radii of carinas, where walls are
/// taken as planes, within a quarter.
inline void expect_parameters_measured_back(const std::string& generator, const MeasuredVessel& measured) {
  const Measures measures = measures_of(generator);
  for (const auto& [name, value] : measured.made().parameters) {
    ASSERT_TRUE(measures.contains(name)) << name << " is not measured";
    const std::optional<double> found = measures.at(name)(measured);
    if (!found) continue;
    const bool carina = name.find("carina") != std::string::npos;
    const double slack = name.ends_with("_deg") ? 1.0 : name.ends_with("_mm") ? 0.05 : 0.0;
    const double whole = name.ends_with("_opening_deg") ? 180.0 - value : std::abs(value);
    EXPECT_NEAR(*found, value, std::max((carina ? 0.25 : 0.05) * whole, slack)) << name;
  }
}

/// Along every axis curvature and calibre change by little in little, and the vessel is nowhere bent more tightly
/// than it is wide.
inline void expect_smooth_axes(const vessel::GeneratedVessel& made) {
  constexpr double h = 0.05;
  for (const vessel::anatomy::Branch& branch : made.branches) {
    double largest = 0.0;
    double largest_change = 0.0;
    double largest_bend = 0.0;
    for (double s = 0.0; s + h <= branch.axis.length_mm(); s += h) {
      const vessel::anatomy::AxisPoint a = branch.axis.at(s);
      const vessel::anatomy::AxisPoint b = branch.axis.at(s + h);
      largest = std::max(largest, a.curvature_per_mm.norm());
      largest_change = std::max(largest_change, (a.curvature_per_mm - b.curvature_per_mm).norm());
      largest_bend = std::max(largest_bend, std::abs(a.radius_bend_per_mm - b.radius_bend_per_mm));
      EXPECT_LT(a.curvature_per_mm.norm() * a.radius_mm, 0.9) << branch.name << " at " << s;
    }
    EXPECT_LT(largest_change, 0.06 * std::max(largest, 0.02))
        << branch.name;  // in a twentieth of a millimetre
    EXPECT_LT(largest_bend, 0.02) << branch.name;
  }
}

}  // namespace endowire::test
