#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/mesh_output.hpp"
#include "vessel_input.hpp"

namespace endowire::cli {

namespace {

struct Options {
  VesselInput vessel;
  std::string out;
};

int run(const Options& options) {
  io::check_mesh_output(options.out);
  const io::VesselMesh mesh = read_vessel(options.vessel);
  io::write_mesh(options.out, mesh.repaired.mesh);
  print_vessel(mesh);
  for (const vessel::Opening& opening : mesh.repaired.openings)
    fmt::print("  {:<22} diameter {:.2f} mm at ({:.1f}, {:.1f}, {:.1f})\n",
               fmt::format("opening {}", opening.number), opening.diameter_mm, opening.centre_mm.x(),
               opening.centre_mm.y(), opening.centre_mm.z());
  fmt::print("  {:<22} {}, in mm, facing outward\n", "written", io::one_line(options.out));
  return exit_success;
}

}  // namespace

std::function<int()> add_prepare(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "prepare", "makes the repaired surface of a lumen, in mm, from any surface or image volume");
  add_vessel_options(*command, options->vessel);
  command->add_option("-o,--out", options->out, "file to write: .vtp or .stl")->required();
  return [options] { return run(*options); };
}

}  // namespace endowire::cli
