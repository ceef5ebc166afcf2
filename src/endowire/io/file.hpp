#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace endowire::io {

/// The whole file as bytes.
/// @throws base::InputError when it is missing, a folder, unreadable, empty or larger than `max_bytes`.
[[nodiscard]] std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes);

/// Writes beside the target under a temporary name and renames, so that nobody ever sees half a file.
/// @throws base::InputError when the place cannot be written to, or the disk is full.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Hash of the bytes (vessel/hash.hpp): tells files apart by content, no defence against forgery.
[[nodiscard]] std::uint64_t content_hash(std::string_view bytes);

/// Sixteen hexadecimal digits: JSON numbers cannot hold 64 bits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

/// A message made to fit on one line: every run of control characters becomes a space.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace endowire::io
