#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <vector>

namespace endowire::cli {

// Exit codes, the same for every subcommand.
inline constexpr int exit_success = 0;
inline constexpr int exit_bad_input = 2;      ///< one line on stderr, nothing else
inline constexpr int exit_not_converged = 3;  ///< the results are written; one line on stderr says where
inline constexpr int exit_not_reproduced =
    4;  ///< a replay gave other states; written, one line on stderr says where

/// Each adds its subcommand and returns what runs it, once the command line is parsed.
[[nodiscard]] std::function<int()> add_generate(CLI::App& app);
[[nodiscard]] std::function<int()> add_inspect(CLI::App& app);
[[nodiscard]] std::function<int()> add_instruments(CLI::App& app);
[[nodiscard]] std::function<int()> add_prepare(CLI::App& app);
[[nodiscard]] std::function<int()> add_simulate(CLI::App& app);
[[nodiscard]] std::function<int()> add_replay(CLI::App& app);

/// Where instruments are looked for: $ENDOWIRE_INSTRUMENTS, beside the program, its share folder, the source
/// tree.
[[nodiscard]] std::vector<std::filesystem::path> instrument_folders();

/// The folder that this program lies in; empty when the system does not tell.
[[nodiscard]] std::filesystem::path program_folder();

}  // namespace endowire::cli
