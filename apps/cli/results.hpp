#pragma once

#include <filesystem>

#include "procedure.hpp"

namespace endowire::cli {

/// Largest memory of this process so far.
[[nodiscard]] double peak_memory_mb();

/// Judges, draws and sums up what was played, and writes it: the last files of a run.
/// @param triangles  the mesh as a file, for the judge
/// @param peak_mb    memory of the simulation itself; drawing and judging come after it
void write_results(const Procedure& procedure, const std::filesystem::path& triangles, double peak_mb,
                   const RunOptions& options, io::RunOutput& output, Progress& progress);

}  // namespace endowire::cli
