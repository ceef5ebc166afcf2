#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "endowire/io/vessel_file.hpp"
#include "endowire/vessel/vessel_ends.hpp"

namespace endowire::cli {

/// What a user says of a vessel file.
struct VesselInput {
  std::string file;
  std::string unit;       ///< empty: inferred
  std::string threshold;  ///< LOW or LOW:HIGH; empty: found
  std::string label;      ///< empty: the only one
  std::string smooth;     ///< empty: as the image asks for
  std::string keep = "largest";
};

/// The file and everything that can be said of it as options of a command.
void add_vessel_options(CLI::App& command, VesselInput& input);

/// @throws base::InputError one line about the option or the file
[[nodiscard]] io::VesselMesh read_vessel(const VesselInput& input);

/// What the file is, how it was read and repaired: unit, image, triangles, size, remarks.
void print_vessel(const io::VesselMesh& mesh);

/// Openings and closed ends with their numbers.
void print_ends(const std::vector<vessel::VesselEnd>& ends);

}  // namespace endowire::cli
