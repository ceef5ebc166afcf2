#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "endowire/rod/instrument.hpp"
#include "endowire/sim/scene.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::bench {

/// A procedure whose steps are timed.
struct Scenario {
  std::string name;
  std::string what;             ///< one line, for people
  std::filesystem::path scene;  ///< empty: 260 cm of wire in a coil
  double step_mm = 0.0;         ///< longest advance of a step; 0: as the scene says
  double rod_mm = 0.0;          ///< uniform rods of this length; 0: as the scene says
  int least_rods = 0;           ///< steps with fewer rods are played, not counted
  int least_steps = 0;          ///< played again until so many steps are timed
  bool judged = false;          ///< the independent judge looks at it too
  std::string group;            ///< "procedures", "long", "peers"
};

/// What ships, those left out whose vessel is not there.
[[nodiscard]] std::vector<Scenario> scenarios();

/// Everything that a run needs, and what it took to get it.
struct Prepared {
  std::shared_ptr<const vessel::Field> field;
  rod::Instrument instrument;
  sim::Access access;
  sim::SimulationSpec spec;
  std::vector<sim::Command> commands;
  std::size_t triangles = 0;
  std::size_t field_bytes = 0;
  double field_s = 0.0;    ///< preparing the distance field
  double prepare_s = 0.0;  ///< all: read, repair, field, centrelines
};

/// @param cache_folder  of fields; empty: prepared now, and that is timed
/// @throws base::InputError  as reading a scene does
[[nodiscard]] Prepared prepare(const Scenario& scenario, const std::filesystem::path& cache_folder);

}  // namespace endowire::bench
