// The page of a report in a real browser, without a screen.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "program.hpp"
#include "vessels.hpp"

namespace endowire {
namespace {

using test::Outcome;
using test::run_endowire;
using test::TemporaryFolder;

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " > /dev/null 2>&1").c_str()) == 0) return name;
  return {};
}

/// The page as the browser has it after its scripts ran.
std::string page_in(const std::string& program, const TemporaryFolder& folder, const std::string& page,
                    const std::string& size) {
  const std::string command =
      "timeout 120 " + program + " --headless --no-sandbox --use-gl=angle --use-angle=swiftshader" +
      " --enable-unsafe-swiftshader --no-first-run --disable-background-networking "
      "--disable-component-update" +
      " --user-data-dir=" + test::quoted((folder / "profile").string()) + " --window-size=" + size +
      " --virtual-time-budget=5000 --dump-dom " + test::quoted("file://" + (folder / page).string()) + " > " +
      test::quoted((folder / "dom.html").string()) + " 2> /dev/null";
  return std::system(command.c_str()) == 0 ? test::read_text(folder / "dom.html") : std::string();
}

/// The value of an attribute of the root element; empty without one.
std::string root_attribute(const std::string& dom, const std::string& name) {
  std::smatch found;
  const std::string head = dom.substr(0, 400);
  return std::regex_search(head, found, std::regex("<html[^>]*" + name + "=\"([^\"]*)\"")) ? found[1].str()
                                                                                           : "";
}

TEST(ReportPage, IsDrawnByABrowserAtTwoSizes) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no browser here (chromium, chromium-browser, google-chrome)";
  const TemporaryFolder folder;
  test::write_text(folder / "v.stl", test::tube_stl(4.0, 60.0));
  test::write_text(folder / "s.toml", test::tube_scene);
  ASSERT_EQ(
      run_endowire(folder, {"simulate", "s.toml", "--out", "out", "--cache", test::test_cache(), "--quiet"})
          .code,
      0);
  for (const char* size : {"1400,900", "390,844"}) {
    const std::string dom = page_in(program, folder, "out/report.html#check&step=12&theme=light", size);
    ASSERT_EQ(root_attribute(dom, "data-ready"), "true") << "the scripts did not run to their end";
    if (root_attribute(dom, "data-view") == "none") GTEST_SKIP() << program << " offers no WebGL 2 here";
    EXPECT_GT(std::stol("0" + root_attribute(dom, "data-drawn")), 2'000)
        << size << ": pixels of vessel and wire";
    EXPECT_NE(dom.find("<h1 id=\"title\">s</h1>"), std::string::npos);
    EXPECT_NE(dom.find("step 12"), std::string::npos);
    const std::regex line("class=\"main\" d=\"M[0-9. ]+L");
    EXPECT_EQ(std::distance(std::sregex_iterator(dom.begin(), dom.end(), line), std::sregex_iterator()), 3)
        << size;
    EXPECT_EQ(dom.find("NaN"), std::string::npos) << size;
  }
}

}  // namespace
}  // namespace endowire
