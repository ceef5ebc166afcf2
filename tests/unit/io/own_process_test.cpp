#include "endowire/io/own_process.hpp"

#include <gtest/gtest.h>

#include <csignal>
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
