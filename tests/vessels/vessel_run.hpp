#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "endowire/io/vessel_file.hpp"
#include "endowire/sim/simulation.hpp"

namespace endowire::test {

/// A real vessel with its field, prepared once per program.
struct Vessel {
  std::string path;
  vessel::RepairedMesh repaired;
  std::shared_ptr<const vessel::MeshField> field;

  /// At the centre of an opening, into the vessel.
  [[nodiscard]] sim::Access through_opening(int number) const;
};

/// The shared vessel of this name; null when it is not there.
[[nodiscard]] const Vessel* shared_vessel(const std::string& name);

/// A vessel from a mesh, its field prepared and its triangles written into a folder for the judge.
[[nodiscard]] Vessel made_vessel(const vessel::TriangleMesh& mesh, const std::filesystem::path& folder);

/// The wire of instruments/hydrophilic_035_angled.toml.
[[nodiscard]] rod::Instrument hydrophilic_wire();

/// A patient on the back in the frame of the femoral vessels: weight is −z. Commands of up to 1.5 mm and 10° are
/// one step.
[[nodiscard]] sim::SimulationSpec lying_patient();

/// Figures of one run; what the simulator says, and what the judge says.
struct RunFigures {
  int steps = 0;     ///< commands
  int substeps = 0;  ///< what they were divided into to keep the limits of a step
  int recorded = 0;  ///< shapes outside the sheath, those on the way of a snap included
  int converged = 0, snaps = 0;
  int split = 0;     ///< halvings of sub-steps
  int on_edges = 0;  ///< commands in which walls were not brought to rest
  double detections = 0.0;
  double calm_detections = 0.0;    ///< in commands without a snap,
  int calm_substeps = 0;           ///< and their sub-steps
  std::vector<double> iterations;  ///< a value a step
  double most_inserted_mm = 0.0, max_deflection_mm = 0.0, max_push_n = 0.0;
  std::string events;         ///< kinds with their counts
  std::string first_failure;  ///< empty: every step converged
  std::vector<double>
      times;               ///< of the shapes recorded, in steps; a fraction is a shape on the way of a snap
  nlohmann::json verdict;  ///< of the judge; counts recorded shapes, from 1

  [[nodiscard]] std::string text() const;
  /// The crossings that the judge names, with their steps.
  [[nodiscard]] std::string crossings_text() const;
};

/// The hand: the next command, knowing the simulation.
using Hand = std::function<sim::Command(const sim::Simulation&)>;

/// Plays `steps` commands, records every shape into a folder and has the judge look at it.
[[nodiscard]] RunFigures play(const Vessel& vessel, const sim::Access& access, int steps, const Hand& next,
                              const std::filesystem::path& folder,
                              const rod::Instrument& wire = hydrophilic_wire(),
                              const sim::SimulationSpec& spec = lying_patient());

/// The judge's verdict over a recording: check_crossings, a program of its own.
[[nodiscard]] nlohmann::json judge(const std::filesystem::path& series, const std::string& vessel_path);

/// Every step converged, at most 2 % of the sub-steps halved, at most 1.05 detections a step without a snap, no crossing found by the judge.
void expect_all_that_must_hold(const RunFigures& run);

}  // namespace endowire::test
