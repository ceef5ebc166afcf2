#pragma once

#include <vector>

#include "endowire/vessel/anatomy/rim.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel::anatomy {

/// Cuts a closed mesh at the rims' planes and drops what lies beyond: a border along each rim.
/// @param beyond_mm  how far behind its rim a vessel goes on at most, before the half ball that closes it
[[nodiscard]] TriangleMesh cut_at(const TriangleMesh& mesh, const std::vector<Rim>& rims, double beyond_mm);

}  // namespace endowire::vessel::anatomy
