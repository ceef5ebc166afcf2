#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "endowire/vessel/mesh.hpp"
#include "endowire/vessel/mesh_report.hpp"

namespace endowire::vessel {

/// Turns one triangle over.
void flip(TriangleMesh& mesh, std::size_t triangle);

/// The pieces of a mesh, connected over any edge, numbered in the order of their first triangle.
struct Pieces {
  std::vector<std::int32_t> of_triangle;
  std::size_t count = 0;
};
[[nodiscard]] Pieces pieces_of(const TriangleMesh& mesh);

/// Makes neighbours over manifold edges agree, each patch after the larger area of the file's orientation.
/// @throws base::InputError naming the file and a place when a patch has one side only (a Möbius strip): nothing tells
///                          inside from outside there
void orient_patches(TriangleMesh& mesh, MeshReport& report, const std::string& file_label);

/// Turns the pieces, each closed by fans over its boundary loops, outward; inward where a piece lies in another.
/// @return  of each piece, how many others enclose it; 0 for all where there are more than 64
[[nodiscard]] std::vector<int> orient_pieces(TriangleMesh& mesh, const Pieces& pieces, MeshReport& report);

}  // namespace endowire::vessel
