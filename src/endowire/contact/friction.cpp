#include "endowire/contact/friction.hpp"

namespace endowire::contact {

double friction_energy_mj(const FrictionLaw& law, const Eigen::Vector2d& slip_mm) {
  const double slip = slip_mm.norm();
  if (law.stiffness_n_per_mm * slip <= law.limit_n) return 0.5 * law.stiffness_n_per_mm * slip * slip;
  return law.limit_n * (slip - 0.5 * law.limit_n / law.stiffness_n_per_mm);
}

FrictionResponse friction_response(const FrictionLaw& law, const Eigen::Vector2d& slip_mm) {
  FrictionResponse r;
  const double slip = slip_mm.norm();
  r.energy_mj = friction_energy_mj(law, slip_mm);
  if (law.stiffness_n_per_mm * slip <= law.limit_n) {
    r.force_n = law.stiffness_n_per_mm * slip_mm;
    r.stiffness_n_per_mm = law.stiffness_n_per_mm * Eigen::Matrix2d::Identity();
  } else {
    const Eigen::Vector2d direction = slip_mm / slip;
    r.force_n = law.limit_n * direction;
    r.stiffness_n_per_mm =
        law.limit_n / slip * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  }
  return r;
}

Eigen::Vector2d friction_anchor(const FrictionLaw& law, const Eigen::Vector2d& slip_mm) {
  const double slip = slip_mm.norm();
  if (law.stiffness_n_per_mm * slip <= law.limit_n) return slip_mm;
  return slip_mm * (law.limit_n / (law.stiffness_n_per_mm * slip));
}

}  // namespace endowire::contact
