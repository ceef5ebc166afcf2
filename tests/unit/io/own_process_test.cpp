#include "endowire/io/own_process.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <vector>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

constexpr std::size_t plenty = std::size_t{1} << 30;

std::string refusal(const std::function<std::string()>& work) {
  return test::message_of<base::InputError>([&] { static_cast<void>(in_own_process(work, plenty, "f")); });
}

TEST(OwnProcess, GivesBackWhatTheWorkReturnsAndNothingElse) {
  int changed = 0;
  const std::string large(3'000'000, 'x');
  EXPECT_EQ(in_own_process(
                [&] {
                  ++changed;
                  return large;
                },
                plenty, "f"),
            large);
  EXPECT_EQ(changed, 0);
  EXPECT_EQ(in_own_process([] { return std::string(); }, plenty, "f"), "");
}

TEST(OwnProcess, ErrorsComeBackAndCrashesBecomeErrors) {
  EXPECT_EQ(refusal([]() -> std::string { throw base::InputError("f: is odd"); }), "f: is odd");
  EXPECT_EQ(refusal([]() -> std::string {
              static_cast<void>(std::raise(SIGKILL));
              return "";
            }),
            "f: is damaged: its reader broke off");
}

TEST(OwnProcess, EndsWithTheWorkWhateverIsThrownThere) {
  const pid_t parent = ::getpid();
  const auto throws = [&](auto thrown) {
    const std::string said = refusal([thrown]() -> std::string { throw thrown; });
    if (::getpid() != parent) ::_exit(7);  // a second copy of this program came out of the call
    EXPECT_EQ(said, "f: is damaged: its reader broke off");
  };
  throws(std::runtime_error("odd"));
  throws(42);
  throws(std::length_error("as vectors throw"));
}

TEST(OwnProcess, WorkThatWaitsIsEndedAfterTheTimeLimit) {
  EXPECT_EQ(process_time_limit, std::chrono::minutes(10));
  const std::string said = test::message_of<base::InputError>([] {
    static_cast<void>(in_own_process(
        []() -> std::string {
          for (;;) ::pause();
        },
        plenty, "f", std::chrono::milliseconds(50)));
  });
  EXPECT_EQ(said, "f: takes more than 0.05 s to read; must be a smaller surface");
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

TEST(OwnProcess, AnAnswerWithoutEndIsCutOff) {
  const std::string said = test::message_of<base::InputError>(
      [] { static_cast<void>(in_own_process([] { return std::string(3'000'000, 'x'); }, 2'000'000, "f")); });
  EXPECT_NE(said.find("f: is damaged"), std::string::npos) << said;
}

// The sanitizers reserve more address space than any limit.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(OwnProcess, MemoryIsLimited) {
  EXPECT_EQ(refusal([]() -> std::string {
              const std::vector<char> much(std::size_t{8} << 30, 'x');
              return std::string(much.begin(), much.begin() + 1);
            }),
            "f: is damaged, or asks for more memory than its length allows");
}
#endif

}  // namespace
}  // namespace endowire::io
