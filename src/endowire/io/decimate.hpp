#pragma once

#include <cstddef>

#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// A mesh of at most so many triangles that looks like this one: for the eye, not for contact.
///
/// By edge collapses of least quadric error (VTK). A mesh that is small enough comes back as it is. A build without
/// VTK cannot make it smaller and gives an empty mesh: no vessel is better than a page that no browser opens.
[[nodiscard]] vessel::TriangleMesh decimated(const vessel::TriangleMesh& mesh, std::size_t max_triangles);

}  // namespace endowire::io
