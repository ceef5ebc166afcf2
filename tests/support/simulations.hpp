#pragma once

#include <gtest/gtest.h>

#include "endowire/sim/simulation.hpp"
#include "support/tubes.hpp"
#include "support/wires.hpp"

namespace endowire::test {

/// Commands one after the other; every one has to converge.
inline void run(sim::Simulation& simulation, int steps, const sim::Command& command) {
  for (int i = 0; i < steps; ++i) {
    const sim::StepReport& report = simulation.step(command);
    ASSERT_TRUE(report.converged) << "step " << i << " of " << steps << " at " << report.inserted_length_mm
                                  << " mm, termination " << static_cast<int>(report.solve.termination);
  }
}

}  // namespace endowire::test
