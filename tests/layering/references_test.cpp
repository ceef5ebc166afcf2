#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace endowire::tests {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::set<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern); it != std::sregex_iterator();
       ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

TEST(References, EverySourceThatAHeaderNamesIsInTheBibliography) {
  const fs::path root = ENDOWIRE_SOURCE_DIR;
  const std::set<std::string> known =
      all_matches(text_of(root / "docs" / "references.bib"), std::regex(R"(@[a-z]+\{([A-Za-z0-9]+),)"));
  ASSERT_GT(known.size(), 10U);
  int cited = 0;
  for (const char* folder : {"src", "tools", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".hpp" && ending != ".cpp") continue;
      for (const std::string& key :
           all_matches(text_of(entry.path()), std::regex(R"(\b([A-Z][A-Za-z]+(?:17|18|19|20)\d\d)\b)"))) {
        ++cited;
        EXPECT_EQ(known.count(key), 1U) << entry.path() << " names [" << key << "]";
      }
    }
  }
  EXPECT_GT(cited, 5);
}

}  // namespace
}  // namespace endowire::tests
