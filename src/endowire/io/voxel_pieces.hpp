#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace endowire::io {

/// A set of voxels that are joined by faces.
struct VoxelPiece {
  std::size_t seed = 0;  ///< its first voxel
  std::size_t voxels = 0;
};

/// The pieces of what is 1, the largest first; of equals the one that begins first. Afterwards all of it is 2.
[[nodiscard]] std::vector<VoxelPiece> voxel_pieces(const std::array<std::int64_t, 3>& size,
                                                   std::vector<std::uint8_t>& marks);

/// Turns the piece around a voxel, all that has its mark, into another mark.
/// @return  how many voxels
std::size_t fill_piece(const std::array<std::int64_t, 3>& size, std::vector<std::uint8_t>& marks,
                       std::size_t seed, std::uint8_t to);

}  // namespace endowire::io
