#include "endowire/io/markup.hpp"

#include <gtest/gtest.h>

namespace endowire::io {
namespace {

TEST(EscapedMarkup, NothingInATextIsReadAsMarkup) {
  EXPECT_EQ(escaped_markup("<a b=\"1\">&amp;</a>"), "&lt;a b=&quot;1&quot;&gt;&amp;amp;&lt;/a&gt;");
  EXPECT_EQ(escaped_markup("Zürich, 0.035\" wire"), "Zürich, 0.035&quot; wire");
  EXPECT_EQ(escaped_markup(""), "");
}

TEST(EscapedMarkup, ControlCharactersWhichXmlForbidsAreSpaces) {
  EXPECT_EQ(escaped_markup(std::string_view("a\nb\0c\x1b", 6)), "a b c ");
}

}  // namespace
}  // namespace endowire::io
