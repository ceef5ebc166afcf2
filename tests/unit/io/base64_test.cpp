#include "endowire/io/base64.hpp"

#include <gtest/gtest.h>

namespace endowire::io {
namespace {

TEST(Base64, MatchesRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Base64, TakesValuesAsTheirBytes) {
  EXPECT_EQ(base64(std::vector<float>{1.0F}), base64(std::string_view("\0\0\x80\x3f", 4)));
  EXPECT_EQ(base64(std::vector<double>{}), "");
}

}  // namespace
}  // namespace endowire::io
