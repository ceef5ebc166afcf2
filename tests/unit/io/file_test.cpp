#include "endowire/io/file.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;

TEST(File, LargerThanTheCapIsRefusedUnread) {
  const TemporaryFolder folder;
  test::write_text(folder / "a", "12345");
  EXPECT_EQ(read_file(folder / "a", 5), "12345");
  EXPECT_EQ(message_of<base::InputError>([&] { static_cast<void>(read_file(folder / "a", 4)); }),
            (folder / "a").string() + ": is 5 bytes long; must be <= 4 bytes");
}

TEST(File, EndlessDevicesAreCappedToo) {
  EXPECT_EQ(message_of<base::InputError>([] { static_cast<void>(read_file("/dev/zero", 1 << 21)); }),
            "/dev/zero: is longer than 2097152 bytes, the most that is read");
}

TEST(File, AtomicWriteReplacesAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "old");
  write_file_atomically(folder / "a", "new");
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  std::filesystem::create_directories((folder / "taken") / "x");
  EXPECT_EQ(message_of<base::InputError>([&] {
              write_file_atomically(folder / "taken", "x");
            }).rfind((folder / "taken").string() + ": cannot be written", 0),
            0U);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  EXPECT_EQ(entries, 2U);
}

TEST(File, MessagesStayOnOneLine) {
  EXPECT_EQ(one_line("a\r\nb\tc"), "a b c");
}

}  // namespace
}  // namespace endowire::io
