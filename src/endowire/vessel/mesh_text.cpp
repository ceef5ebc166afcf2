#include "endowire/vessel/mesh_text.hpp"

#include <cstdio>

namespace endowire::vessel {

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string place_text(const Eigen::Vector3d& place_mm) {
  char text[128];
  std::snprintf(text, sizeof text, "(%.1f, %.1f, %.1f) mm", place_mm.x(), place_mm.y(), place_mm.z());
  return text;
}

}  // namespace endowire::vessel
