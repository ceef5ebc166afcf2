// A step allocates nothing after warm-up: operator new is replaced in this test binary, and counts.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "endowire/sim/event_watch.hpp"
#include "support/hand_made_trees.hpp"
#include "support/simulations.hpp"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}

void* counted(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(align, (size + align - 1) / align * align)) return p;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted(size, alignment);
}
// The pair without exceptions too, or a sanitizer sees its own `new` meet our `delete`.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* p, const std::nothrow_t& /*tag*/) noexcept {
  std::free(p);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete[](void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

namespace endowire::sim {
namespace {

// Proves that the counter counts: a test of a counter that stands still would always pass.
TEST(Allocations, AreCounted) {
  const long before = allocations;
  std::vector<double> v(100);
  v[3] = 1.0;
  EXPECT_EQ(allocations - before, 1);
}

// The wire goes in, out and round after a first insertion has warmed everything up. Breaks with one vector that grows.
TEST(Allocations, AStepAllocatesNothingAfterWarmUp) {
  Simulation simulation(test::bent_tube(), test::curved_tip_wire(), test::origin_access(), {});
  test::run(simulation, 60, {1.0, 0.05});
  test::run(simulation, 30, {-1.0, 0.0});
  const long before = allocations;
  long largest = 0;
  bool converged = true;
  double inserted = 0.0;
  for (int i = 0; i < 90; ++i) {
    const long at_start = allocations;
    const StepReport& report = simulation.step({i < 60 ? 1.0 : -1.0, 0.05});
    largest = std::max(largest, allocations - at_start);
    converged = converged && report.converged;
    inserted = std::max(inserted, report.inserted_length_mm);
  }
  EXPECT_EQ(allocations - before, 0) << "largest number in one step: " << largest;
  EXPECT_TRUE(converged);
  EXPECT_GT(inserted, 85.0) << "the wire did not go further than in the warm-up: nothing new was reached";
}

// Breaks with a table of the watch that grows, or an event list that is made anew.
TEST(Allocations, TheWatchOfEventsAllocatesNothingOnceItsMemoryIsReserved) {
  Simulation simulation(test::bent_tube(1.0), test::curved_tip_wire(), test::origin_access(), {});
  EventWatch watch(std::make_shared<const vessel::CentrelineTree>(test::bent_tube_tree()));
  watch.reserve(100, 100.0);
  Snapshot snapshot;
  test::run(simulation, 60, {1.0, 0.05});
  simulation.snapshot(snapshot);
  std::size_t told = 0;
  long by_the_watch = 0;
  for (int i = 0; i < 120; ++i) {
    const Command command{i < 50 ? -1.0 : 1.0, 0.05};
    const StepReport& report = simulation.step(command);
    simulation.snapshot(snapshot);
    const long before = allocations;
    told += watch.after(command, report, snapshot).size();
    by_the_watch += allocations - before;
  }
  EXPECT_EQ(by_the_watch, 0);
  EXPECT_GT(told, 0U);
}

}  // namespace
}  // namespace endowire::sim
