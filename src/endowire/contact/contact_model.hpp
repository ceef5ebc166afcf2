#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "endowire/contact/friction.hpp"
#include "endowire/contact/local_wall.hpp"
#include "endowire/math/band_ldlt.hpp"
#include "endowire/solve/newton.hpp"

namespace endowire::contact {

/// A joint that moves along a line only, by its first unknown: the one at the sheath.
struct GuidedJoint {
  int joint = -1;                                        ///< −1: there is none
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< motion per unit of that unknown
};

/// Lays a gradient by the position of a point of a rod and by the rod's spin onto the unknowns.
/// @param fraction  0 at joint `rod` … 1 at joint `rod + 1`
void scatter_gradient(int rod, double fraction, const Eigen::Vector4d& g, const GuidedJoint& guided,
                      std::vector<double>& gradient);

/// C at a motion.
struct ModelPart {
  double energy_mj = 0.0;
  bool changed =
      false;  ///< some contact is open or closed, sticks, slides or slides another way than last evaluated or assumed
};

/// One sample with its walls and its friction, as the linear motion of its rod sees them.
struct LinearContact {
  struct Wall {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< gradient of the height
    double depth_mm = 0.0;                             ///< before the motion, > 0 in the wall
    double zero_mm = 0.0;                              ///< depth at which the line for its law has no force
    double stiffness_n_per_mm = 0.0;                   ///< slope of that line
    bool closed = false;                               ///< as last evaluated; at first, as is to be assumed
  };
  int rod = 0;
  double fraction = 0.0;  ///< 0 at joint `rod` … 1 at joint `rod + 1`
  double radius_mm = 0.0;
  int walls = 0;
  std::array<Wall, kMaxWalls> wall;
  Eigen::Vector3d axial = Eigen::Vector3d::Zero();
  Eigen::Vector3d around = Eigen::Vector3d::Zero();
  Eigen::Vector2d slip_mm = Eigen::Vector2d::Zero();  ///< before the motion
  FrictionLaw friction;                               ///< no friction when its limit is 0
  bool stuck = false;                                 ///< as last evaluated
  Eigen::Vector2d slid_mm = Eigen::Vector2d::Zero();  ///< slip as last evaluated
};

/// Motion of the sample of a contact.
/// @param step  the motion in the unknowns
[[nodiscard]] Eigen::Vector3d motion_of(const LinearContact& contact, const std::vector<double>& step,
                                        const GuidedJoint& guided);

/// All contacts of a wire as functions of a linear motion v, ω of its joints and rods:
///
///   C(v, ω) = Σ_walls ½ k ⟨δ − δ₀ − n·u⟩² + Σ_samples ψ(τ + (a·u, b·u + r ω)),   u = (1 − f) v_rod + f v_rod+1
///
/// ⟨x⟩ = max(x, 0). A wall is a spring that only pushes, a line that touches or cuts its law; ψ is the law of friction itself; the geometry is linear.
/// Both are convex. A Newton iteration minimises the quadratic model of the rod plus C, so that contacts open and close, stick
/// and slide within it: the contact forces are corrected as the joints move, with no new detection.
/// Symbols  n normal, δ depth, k, δ₀ slope and zero of that line, τ slip of the surface, a, b axes along and round the wire, r radius of the wire [mm]
/// Source   the convex subproblem of sequential convex programming; semismooth Newton on it: [Hintermueller2002]
/// Units    unknowns come in blocks of four, x, y, z [mm] and a turn [rad]
class ContactModel {
 public:
  void reserve(std::size_t samples) { contacts_.reserve(samples); }
  void clear() { contacts_.clear(); }
  LinearContact& add() { return contacts_.emplace_back(); }
  [[nodiscard]] bool empty() const { return contacts_.empty(); }

  /// Adds gradient and Hessian of C at a motion.
  /// @param step     the motion in the unknowns
  ModelPart add_derivatives(const std::vector<double>& step, solve::ContactHessian kind,
                            const GuidedJoint& guided, math::BandMatrix& hessian,
                            std::vector<double>& gradient);
  [[nodiscard]] const std::vector<LinearContact>& contacts() const { return contacts_; }
  [[nodiscard]] LinearContact& contact(std::size_t i) { return contacts_[i]; }

 private:
  std::vector<LinearContact> contacts_;
};

}  // namespace endowire::contact
