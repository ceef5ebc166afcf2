// Steps as a haptic loop takes them, 0.02 mm each: every one converges, gives forces that are numbers, and asks the system for nothing.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "support/simulations.hpp"

namespace endowire::sim {
namespace {

TEST(SmallSteps, ConvergeAndGiveFiniteForcesEveryOne) {
  Simulation simulation(test::bent_tube(1.0), test::curved_tip_wire(), test::origin_access(), {});
  double most_n = 0.0;
  double asked_mm = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const Command command{i < 4000 ? 0.02 : -0.02, i % 1000 < 500 ? 0.001 : -0.001};
    asked_mm += command.advance_mm;
    const StepReport& report = simulation.step(command);
    ASSERT_TRUE(report.converged) << "step " << i << ", " << report.inserted_length_mm << " mm inserted";
    ASSERT_EQ(report.splits, 0) << i;
    for (const double force :
         {report.push_force_n, report.torque_n_mm, report.tip_force_n, report.max_force_5mm_n})
      ASSERT_TRUE(std::isfinite(force)) << i;
    most_n = std::max(most_n, report.push_force_n);
  }
  EXPECT_NEAR(simulation.state().inserted_mm, asked_mm, 0.05);
  EXPECT_GT(most_n, 0.01) << "no wall was touched: nothing was tried";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

enum class Then { nothing, ask_the_system };

/// Exit status of a child that warms up and then steps where the kernel kills it at its first system call but exit.
int status_of_sealed_child(Then then) {
  const pid_t child = ::fork();
  if (child == 0) {
    Simulation simulation(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {});
    for (int i = 0; i < 60; ++i) simulation.step({1.0, 0.05});
    for (int i = 0; i < 30; ++i) simulation.step({-1.0, 0.0});
    if (::prctl(PR_SET_SECCOMP, 1 /* SECCOMP_MODE_STRICT */) != 0) ::_exit(77);
    bool converged = true;
    for (int i = 0; i < 1500; ++i) converged = simulation.step({0.02, 0.001}).converged && converged;
    for (int i = 0; i < 60; ++i)
      converged = simulation.step({i < 30 ? 1.0 : -1.0, 0.05}).converged && converged;
    if (then == Then::ask_the_system) ::syscall(SYS_getppid);
    ::syscall(SYS_exit, converged ? 0 : 1);  // _exit ends all threads, which is another call and not allowed
  }
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

// Breaks with a lock that is contended, a page that is mapped, a clock that is asked, a line that is printed: with whatever
// may take a thread off its core in the middle of a tick.
TEST(SmallSteps, MakeNoSystemCall) {
  const int status = status_of_sealed_child(Then::nothing);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "this kernel has no seccomp";
  EXPECT_FALSE(WIFSIGNALED(status)) << "a step called the system";
  EXPECT_EQ(WEXITSTATUS(status), 0) << "a step did not converge";
  const int caught = status_of_sealed_child(Then::ask_the_system);
  EXPECT_TRUE(WIFSIGNALED(caught) && WTERMSIG(caught) == SIGKILL)
      << "the seal does not hold: the test shows nothing";
}

#endif

}  // namespace
}  // namespace endowire::sim
