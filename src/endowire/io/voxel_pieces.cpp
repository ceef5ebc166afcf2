#include "endowire/io/voxel_pieces.hpp"

#include <algorithm>

namespace endowire::io {

std::size_t fill_piece(const std::array<std::int64_t, 3>& size, std::vector<std::uint8_t>& marks,
                       std::size_t seed, std::uint8_t to) {
  const auto nx = static_cast<std::size_t>(size[0]);
  const std::size_t nxy = nx * static_cast<std::size_t>(size[1]);
  const std::size_t count = marks.size();
  const std::uint8_t from = marks[seed];
  std::vector<std::uint32_t> front{static_cast<std::uint32_t>(seed)};  // max_voxels fits
  marks[seed] = to;
  std::size_t filled = 0;
  const auto visit = [&](std::size_t voxel) {
    if (marks[voxel] != from) return;
    marks[voxel] = to;
    front.push_back(static_cast<std::uint32_t>(voxel));
  };
  while (!front.empty()) {
    const std::size_t voxel = front.back();
    front.pop_back();
    ++filled;
    const std::size_t x = voxel % nx;
    const std::size_t y = voxel % nxy / nx;
    if (x > 0) visit(voxel - 1);
    if (x + 1 < nx) visit(voxel + 1);
    if (y > 0) visit(voxel - nx);
    if (y + 1 < nxy / nx) visit(voxel + nx);
    if (voxel >= nxy) visit(voxel - nxy);
    if (voxel + nxy < count) visit(voxel + nxy);
  }
  return filled;
}

std::vector<VoxelPiece> voxel_pieces(const std::array<std::int64_t, 3>& size,
                                     std::vector<std::uint8_t>& marks) {
  std::vector<VoxelPiece> pieces;
  for (std::size_t voxel = 0; voxel < marks.size(); ++voxel)
    if (marks[voxel] == 1) pieces.push_back({voxel, fill_piece(size, marks, voxel, 2)});
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const VoxelPiece& a, const VoxelPiece& b) { return a.voxels > b.voxels; });
  return pieces;
}

}  // namespace endowire::io
