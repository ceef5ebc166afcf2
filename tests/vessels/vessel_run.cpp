#include "vessel_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "endowire/io/instrument_file.hpp"
#include "endowire/io/statistics.hpp"
#include "endowire/io/vtp.hpp"
#include "endowire/vessel/stl.hpp"
#include "support/shared_vessels.hpp"

namespace endowire::test {

sim::Access Vessel::through_opening(int number) const {
  const vessel::Opening& opening = repaired.openings.at(static_cast<std::size_t>(number - 1));
  return {opening.centre_mm, -opening.direction};
}

const Vessel* shared_vessel(const std::string& name) {
  static std::map<std::string, Vessel> known;
  const std::string path = shared_vessel_path(name);
  if (!std::filesystem::exists(path)) return nullptr;
  const auto [place, fresh] = known.try_emplace(name);
  if (fresh) {
    const io::VesselMesh mesh = io::read_vessel_file(path, vessel::LengthUnit::millimetre);
    const std::filesystem::path cache = std::filesystem::temp_directory_path() / "endowire-test-cache";
    place->second = {path, mesh.repaired, io::prepare_field(mesh, cache).field};
  }
  return &place->second;
}

Vessel made_vessel(const vessel::TriangleMesh& mesh, const std::filesystem::path& folder) {
  Vessel made;
  made.path = (folder / "vessel.stl").string();
  const std::vector<std::byte> bytes = vessel::write_binary_stl(mesh);
  std::ofstream(made.path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  made.repaired = vessel::repair(mesh, "made");
  made.field = std::make_shared<const vessel::MeshField>(vessel::MeshField::build(made.repaired));
  return made;
}

rod::Instrument hydrophilic_wire() {
  return io::read_instrument_file(ENDOWIRE_SOURCE_DIR "/instruments/hydrophilic_035_angled.toml").instrument;
}

sim::SimulationSpec lying_patient() {
  sim::SimulationSpec spec;
  spec.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  spec.max_advance_mm = 1.5;
  return spec;
}

nlohmann::json judge(const std::filesystem::path& series, const std::string& vessel_path) {
  const std::string command = std::string("'") + ENDOWIRE_CHECK_CROSSINGS + "' '" + series.string() + "' '" +
                              vessel_path + "' --json";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return nullptr;
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), n);
  ::pclose(pipe);
  return nlohmann::json::parse(text, nullptr, false);
}

namespace {

/// A command beyond the limits of a step is taken in equal parts, each a step of its own.
int substeps_of(const sim::Command& command, const sim::SimulationSpec& spec) {
  const double degrees = std::abs(command.torque_rad) * 180.0 / std::numbers::pi;
  return static_cast<int>(std::max({1.0, std::ceil(std::abs(command.advance_mm) / spec.max_advance_mm - 1e-9),
                                    std::ceil(degrees / spec.max_torque_deg - 1e-9)}));
}

}  // namespace

RunFigures play(const Vessel& vessel, const sim::Access& access, int steps, const Hand& next,
                const std::filesystem::path& folder, const rod::Instrument& wire,
                const sim::SimulationSpec& spec) {
  sim::Simulation simulation(vessel.field, wire, access, spec);
  RunFigures figures;
  std::map<std::string, int> kinds;
  std::vector<io::SeriesEntry> series;
  sim::Snapshot snapshot;
  const auto record = [&](double time_s) {
    if (snapshot.points.empty()) return;  // in the sheath
    const std::string name = "wire_" + std::to_string(++figures.recorded) + ".vtp";
    io::write_wire_vtp(folder / name, snapshot, access);
    series.push_back({time_s, name});
    figures.times.push_back(time_s);
  };
  for (int i = 1; i <= steps; ++i) {
    const sim::Command command = next(simulation);
    const sim::StepReport& r = simulation.step(command);
    ++figures.steps;
    figures.substeps += substeps_of(command, spec);
    figures.converged += r.converged;
    figures.split += r.splits;
    figures.on_edges += r.walls_at_rest ? 0 : 1;
    figures.snaps += r.snapped;
    figures.detections += r.detections;
    if (!r.snapped) {
      figures.calm_detections += r.detections;
      figures.calm_substeps += substeps_of(command, spec);
    }
    figures.iterations.push_back(r.newton_iterations);
    figures.most_inserted_mm = std::max(figures.most_inserted_mm, r.inserted_length_mm);
    figures.max_deflection_mm = std::max(figures.max_deflection_mm, r.max_wall_deflection_mm);
    figures.max_push_n = std::max(figures.max_push_n, std::abs(r.push_force_n));
    for (const sim::Event& event : r.events) ++kinds[std::string(io::name_of(event.kind))];
    if (!r.converged && figures.first_failure.empty()) {
      std::ostringstream text;
      text << "step " << i << " at " << r.inserted_length_mm << " mm: " << io::name_of(r.solve.termination);
      figures.first_failure = text.str();
    }
    for (int k = 0; k < simulation.waypoints(); ++k) {
      simulation.waypoint(k, snapshot);
      record(i - 1 + (k + 1.0) / (simulation.waypoints() + 1.0));
    }
    simulation.snapshot(snapshot);
    record(i);
  }
  io::write_pvd(folder / "wire.pvd", series);
  figures.verdict = judge(folder / "wire.pvd", vessel.path);
  for (const auto& [kind, count] : kinds) figures.events += kind + " " + std::to_string(count) + ", ";
  return figures;
}

std::string RunFigures::text() const {
  std::ostringstream out;
  double sum = 0.0;
  for (const double n : iterations) sum += n;
  out << steps << " steps, " << converged << " converged, " << split << " halvings, " << on_edges
      << " on edges, " << detections / std::max(1, substeps) << " detections a step, "
      << calm_detections / std::max(1, calm_substeps) << " without a snap, iterations "
      << sum / std::max(1, steps) << " mean " << io::percentile(iterations, 0.99) << " p99 "
      << io::percentile(iterations, 1.0) << " max, " << snaps << " snaps, up to " << most_inserted_mm
      << " mm inserted, deflection " << max_deflection_mm << " mm, push " << max_push_n << " N; " << events
      << "\n  judge: ";
  if (verdict.is_object()) {
    out << verdict.value("crossings", -1) << " crossings, deepest " << verdict["deepest"].dump();
  } else {
    out << "no verdict";
  }
  if (!first_failure.empty()) out << "\n  " << first_failure;
  return out.str();
}

std::string RunFigures::crossings_text() const {
  std::ostringstream out;
  for (const nlohmann::json& e : verdict["examples"]) {
    const std::size_t shape = e["step"].get<std::size_t>();
    out << "\n  " << e["kind"].get<std::string>() << " at step " << times.at(shape - 1) << ", arc "
        << e["arc_mm"] << " mm, depth " << e["depth_mm"] << " mm, way " << e["length_mm"] << " mm, "
        << e["position_mm"].dump();
  }
  return out.str();
}

void expect_all_that_must_hold(const RunFigures& run) {
  EXPECT_EQ(run.converged, run.steps) << run.first_failure;
  EXPECT_LE(run.split, 0.02 * run.substeps);
  EXPECT_LE(run.on_edges, 0.02 * run.substeps) << "walls swing";
  EXPECT_LE(run.calm_detections, 1.05 * run.calm_substeps);
  ASSERT_TRUE(run.verdict.is_object()) << "check_crossings gave no verdict";
  EXPECT_EQ(run.verdict["steps"], run.recorded);
  EXPECT_EQ(run.verdict["crossings"], 0) << run.crossings_text();
}

}  // namespace endowire::test
