#pragma once

#include <filesystem>
#include <vector>

namespace endowire::io {

/// Where instruments are looked for, in this order: $ENDOWIRE_INSTRUMENTS, `instruments` in the folder of the program,
/// `../share/endowire/instruments` seen from there, `instruments` of the source tree.
/// @param program_folder  of the program or module that asks; empty when the system does not tell
/// @param source_tree     for what was built and not installed; empty: none
[[nodiscard]] std::vector<std::filesystem::path> instrument_folders(
    const std::filesystem::path& program_folder, const std::filesystem::path& source_tree);

}  // namespace endowire::io
