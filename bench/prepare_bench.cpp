// What it takes to prepare a large vessel, from the file's bytes to field and centrelines: time on one core, and memory.
// The limits it is held against: 500,000 triangles and vessels of 0.5 mm in 20 s and 500 MB.
//
//   bench_prepare [FILE.stl]      a generated tree of 221 vessels, else a file; one process prepares one vessel
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "endowire/vessel/centreline.hpp"
#include "endowire/vessel/hash.hpp"
#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/scale.hpp"
#include "endowire/vessel/stl.hpp"
#include "support/branching_tree.hpp"
#include "support/shared_vessels.hpp"

namespace {

using namespace endowire;

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Times one stage after the other.
class Stages {
 public:
  void end(const char* name) {
    const double now = cpu_s();
    fmt::print("  {:<22} {:>6.2f} s   peak so far {:>4.0f} MB\n", name, now - last_, peak_mb());
    last_ = now;
  }
  /// What passed since then is no part of any stage.
  void skip() {
    const double now = cpu_s();
    begin_ += now - last_;
    last_ = now;
  }
  [[nodiscard]] double total_s() const { return last_ - begin_; }

 private:
  double begin_ = cpu_s();
  double last_ = begin_;
};

/// Tells whether two builds prepare the same bits.
std::uint64_t hash_of(std::span<const std::byte> bytes) {
  vessel::ContentHash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  return hash.value();
}

void prepare(std::vector<std::byte> bytes, const std::string& name) {
  Stages stages;
  vessel::TriangleMesh soup = vessel::parse_stl(bytes, name);
  bytes = {};
  stages.end("reading");
  const vessel::UnitChoice unit = vessel::choose_unit(soup, {}, name);
  stages.end("unit");
  const vessel::RepairedMesh mesh = vessel::repair(vessel::in_millimetres(std::move(soup), unit.unit), name);
  stages.end("repair");
  vessel::FieldFacts facts;
  std::uint64_t field_hash = 0;
  {
    const vessel::MeshField field = vessel::MeshField::build(mesh);
    facts = field.facts();
    stages.end("distance field");
    field_hash = hash_of(field.serialise());
    stages.skip();
  }
  const vessel::CentrelineTree tree = vessel::extract_centrelines(mesh);
  stages.end("centrelines");
  fmt::print("{}: {} triangles, {} branches, {} self-intersections\n", name, mesh.mesh.triangles.size(),
             tree.branches().size(), mesh.report.self_intersections.count);
  fmt::print(
      "  field {:.1f} MB, spacing {:.3f} to {:.3f} mm, error {:.4f} (median) {:.4f} (99 %) {:.4f} mm "
      "(largest), {}\n",
      static_cast<double>(facts.bytes) / 1e6, facts.finest_spacing_mm, facts.coarsest_spacing_mm,
      facts.error_p50_mm, facts.error_p99_mm, facts.error_max_mm,
      facts.refinement_complete ? "complete" : "stopped");
  fmt::print("  hash of the field {:016x}, of the centrelines {:016x}\n", field_hash,
             hash_of(tree.serialise(0)));
  fmt::print("  lumen {:.2f} mm (5 %) to {:.2f} mm (95 % of the wall)\n",
             facts.lumen_diameter_percentiles_mm[0], facts.lumen_diameter_percentiles_mm[4]);
  fmt::print("  in all {:.1f} s on one core (limit 20), {:.0f} MB (limit 500)\n", stages.total_s(),
             peak_mb());
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1) {
    prepare(test::read_bytes(arguments[1]), arguments[1]);
    return 0;
  }
  // Made by a process of its own, whose memory is not the preparation's.
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("endowire-bench-tree-{}.stl", ::getpid());
  const pid_t maker = ::fork();
  if (maker == 0) {
    constexpr double spacing_mm = 0.23;
    const std::vector<std::byte> bytes =
        vessel::write_binary_stl(test::surface_of(test::branching_tree({}), spacing_mm));
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(maker, &status, 0);
  prepare(test::read_bytes(file.string()), "tree");
  std::filesystem::remove(file);
  return 0;
}
