#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "endowire/vessel/closure.hpp"
#include "endowire/vessel/field.hpp"
#include "endowire/vessel/repair.hpp"

namespace endowire::vessel {

/// How a distance field is prepared. The defaults serve every vessel seen so far.
struct FieldParameters {
  double band_outside_mm =
      2.5;               ///< the field is exact this deep into the wall; at least the deepest wire [mm]
  double near_mm = 1.0;  ///< error_target_mm holds this far into the lumen: the radius of an instrument [mm]
  double near_outside_mm = 0.3;        ///< and this far into the wall: the deflection of an elastic wall [mm]
  double error_target_mm = 0.03;       ///< cells are split while a test point near the wall errs by more [mm]
  double error_slope = 0.05;           ///< allowed error per distance further in; twice that further out [-]
  double min_spacing_mm = 0.1;         ///< finest sample spacing; sharper edges miss error_target_mm [mm]
  double virtual_tube_mm = 60.0;       ///< length of the tube behind an opening [mm]
  std::size_t max_bytes = 60'000'000;  ///< refinement, worst cell first, stops here; error_mm() then tells
};

/// What a prepared field is, for reports.
struct FieldFacts {
  std::size_t bricks = 0;
  std::size_t bytes = 0;
  double finest_spacing_mm = 0.0;
  double coarsest_spacing_mm = 0.0;
  double error_max_mm = 0.0;  ///< largest, 99th percentile and median error against the exact distance ...
  double error_p99_mm = 0.0;  ///< ... at `error_points` random points in that neighbourhood
  double error_p50_mm = 0.0;
  std::size_t error_points = 0;
  bool refinement_complete = false;                       ///< false: max_bytes or min_spacing_mm stopped it
  std::array<double, 5> lumen_diameter_percentiles_mm{};  ///< 5, 25, 50, 75, 95 % of the wall's area
};

/// A sparse signed distance field of a triangle mesh.
///
/// An octree over the bounding box ends in bricks of 4×4×4 cells whose 5×5×5 nodes hold exact distances
/// (nearest point on triangle, pseudonormal sign) in 16 bits over the brick's range. Between nodes φ is the
/// tricubic Catmull–Rom interpolant, at a brick's border with a quadratically extrapolated neighbour, so that
/// value and gradient are one C¹ function inside a brick, continuous between bricks of one spacing, and
/// continuous to the stated error between bricks of different spacing. A brick is split where the lumen is
/// narrow and, worst first, where test points in its cells miss the exact distance.
///
/// Accuracy  error_mm() is the largest error measured against the exact distance between near_outside_mm in
/// the wall
///           and near_mm in the lumen. Further in it is held to error_slope per millimetre, further out, down
///           to band_outside_mm, to twice that. Deeper, the distance is a plane estimate per cell: negative
///           and bounded, its gradient towards the wall. At a concave edge the interpolant lies below the
///           true distance, at a carina above it: corners are rounded by at most the stated error.
class MeshField final : public Field {
 public:
  static constexpr int cells = 4;          ///< per edge of a brick
  static constexpr int nodes = cells + 1;  ///< per edge of a brick
  static constexpr std::size_t samples_per_brick = std::size_t{nodes} * nodes * nodes;

  /// Prepares the field. The result depends on the set of triangles, not on their order.
  [[nodiscard]] static MeshField build(const RepairedMesh& repaired, const FieldParameters& parameters = {});

  /// Identifies mesh, parameters and version of the algorithm: the name of a cached field.
  [[nodiscard]] static std::uint64_t key(const RepairedMesh& repaired,
                                         const FieldParameters& parameters = {});

  /// The prepared field as bytes: versioned, keyed, with a checksum; same bits on every little-endian
  /// machine.
  [[nodiscard]] std::vector<std::byte> serialise() const;

  /// A field from bytes that `serialise` wrote.
  /// @param expected_key  what `key` gives for the mesh at hand
  /// @param label         name of the cache file for messages
  /// @throws InputError   when the bytes are foreign, damaged, of another version or of another mesh
  [[nodiscard]] static MeshField deserialise(std::span<const std::byte> bytes, std::uint64_t expected_key,
                                             const std::string& label);

  [[nodiscard]] WallDistance at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double lumen_radius_mm(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double tissue_to_next_lumen_mm(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] int exit_at(const Eigen::Vector3d& point_mm) const override;
  [[nodiscard]] double error_mm() const override { return facts_.error_max_mm; }

  [[nodiscard]] const FieldFacts& facts() const { return facts_; }
  [[nodiscard]] const std::vector<VirtualTube>& virtual_tubes() const { return tubes_; }
  /// Spacing of the samples around a point; infinity where there is no brick.
  [[nodiscard]] double spacing_mm(const Eigen::Vector3d& point_mm) const;

 private:
  friend class MeshFieldBuilder;

  /// ≥ 0: a group of eight children; else -1 - 2·brick or -2 - 2·far cell.
  using Reference = std::int32_t;

  struct Brick {
    float low_mm;                              ///< distance of sample value 0
    float step_mm;                             ///< distance per unit of sample value
    float tissue_mm;                           ///< to another lumen
    std::array<std::uint16_t, 8> radius_code;  ///< lumen radius at the corners, logarithmic
  };
  struct FarCell {
    float distance_mm;              ///< at its centre, negative
    std::array<float, 3> gradient;  ///< towards the nearest wall
    float radius_mm;
    float tissue_mm;
  };
  struct Place {
    Reference reference;
    bool inside;               ///< the box
    Eigen::Vector3d fraction;  ///< of the cell, from its lowest corner; within 0 … 1 inside the box
    double per_mm;             ///< cells
  };

  MeshField() = default;
  [[nodiscard]] Reference reference_at(const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] inline Place find(const Eigen::Vector3d& point_mm) const;
  /// @param place  as find() gives it, or of a cell that is being built; stencils clamp it to the cell
  [[nodiscard]] WallDistance interpolate(std::size_t brick, const Place& place) const;
  [[nodiscard]] Eigen::AlignedBox3d box_mm() const;
  void validate(const std::string& label) const;

  /// Radii between 0.01 and 655 mm in steps of 0.02 %.
  static std::uint16_t encode_radius(double radius_mm);
  static double decode_radius_mm(double code);

  static bool is_far(Reference r) { return ((-1 - r) & 1) != 0; }
  static std::size_t index_of(Reference r) { return static_cast<std::size_t>((-1 - r) >> 1); }

  std::uint64_t key_ = 0;
  Eigen::Vector3d origin_mm_ = Eigen::Vector3d::Zero();
  double root_mm_ = 0.0;  ///< edge of a root cell
  double band_mm_ = 0.0;
  std::array<std::int32_t, 3> roots_along_{};
  std::int32_t levels_ = 0;  ///< halvings from a root cell to the finest brick
  std::vector<Reference> roots_;
  std::vector<std::array<Reference, 8>> children_;
  std::vector<Brick> bricks_;
  std::vector<std::uint16_t> samples_;
  std::vector<FarCell> far_;
  std::vector<VirtualTube> tubes_;
  FieldFacts facts_;
};

}  // namespace endowire::vessel
