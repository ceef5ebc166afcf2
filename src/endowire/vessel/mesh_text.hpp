#pragma once

#include <Eigen/Core>
#include <string>

namespace endowire::vessel {

/// Three significant digits.
[[nodiscard]] std::string rounded(double value);

/// "(12.3, -4.5, 678.9) mm", for messages.
[[nodiscard]] std::string place_text(const Eigen::Vector3d& place_mm);

}  // namespace endowire::vessel
