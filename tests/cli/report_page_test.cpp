// The page of a report in a real browser, without a screen.

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

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

/// A browser without a screen gives animation frames when it likes: timers stand in for them.
const char* const frames = R"(<script>
  window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16);
  window.cancelAnimationFrame = clearTimeout;
</script>)";

/// Does what a user does and writes down what the page makes of it: where the tip is drawn after each movement.
const char* const user = R"(<script>
(async () => {
  const root = document.documentElement.dataset;
  root.errors = "";
  window.addEventListener("error", event => { root.errors += event.message + ";"; });
  const seen = [];
  const look = () => new Promise(done => setTimeout(() => {
    const tip = document.querySelector(".labels .tip");
    seen.push(tip ? tip.style.left + " " + tip.style.top : "nowhere");
    done();
  }, 200));
  await look();
  const view = document.getElementById("view"), box = view.getBoundingClientRect();
  const pointer = (kind, x, y, more) => view.dispatchEvent(new PointerEvent(kind,
    { pointerId: 1, clientX: box.left + x, clientY: box.top + y, buttons: 1, bubbles: true, ...more }));
  view.setPointerCapture = () => {};
  pointer("pointerdown", 50, 90);
  pointer("pointermove", 120, 150);
  await look();
  pointer("pointermove", 150, 150, { shiftKey: true });
  pointer("pointerup", 150, 150);
  await look();
  view.dispatchEvent(new WheelEvent("wheel", { deltaY: -300, clientX: box.left + 80, clientY: box.top + 80 }));
  await look();
  root.seen = seen.join(",");
  for (const name of ["side", "tip", "front"]) document.querySelector(`[data-view=${name}]`).click();
  document.querySelector("[data-axis=time_s]").click();
  const scrub = document.getElementById("scrub"), when = document.getElementById("when");
  scrub.value = 4;
  scrub.dispatchEvent(new Event("input"));
  root.scrubbed = when.textContent;
  for (let i = 0; i < 2; i++)
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
  root.stepped = when.textContent;
  document.getElementById("theme").click();
  document.getElementById("play").click();
})();
</script>)";

class ReportPage : public ::testing::Test {
 protected:
  void SetUp() override {
    program_ = browser();
    if (program_.empty()) GTEST_SKIP() << "no browser here (chromium, chromium-browser, google-chrome)";
    test::write_text(folder_ / "v.stl", test::tube_stl(4.0, 60.0));
    test::write_text(folder_ / "s.toml", test::tube_scene);
    const Outcome outcome = run_endowire(
        folder_, {"simulate", "s.toml", "--out", "out", "--cache", test::test_cache(), "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  TemporaryFolder folder_;
  std::string program_;
};

TEST_F(ReportPage, AnswersToTheUsersHands) {
  std::string page = test::read_text(folder_ / "out/report.html");
  page.insert(page.find("</body>"), user);
  page.insert(page.find("<body>"), frames);
  test::write_text(folder_ / "used.html", page);
  const std::string dom = page_in(program_, folder_, "used.html", "1000,800");
  EXPECT_EQ(root_attribute(dom, "data-errors"), "");
  EXPECT_NE(root_attribute(dom, "data-scrubbed").find("step 5"), std::string::npos) << dom.substr(0, 400);
  EXPECT_NE(root_attribute(dom, "data-stepped").find("step 7"), std::string::npos) << "two keys further";
  if (root_attribute(dom, "data-picture") == "none") GTEST_SKIP() << program_ << " offers no WebGL 2 here";
  const std::string seen = root_attribute(dom, "data-seen");
  std::vector<std::string> places;
  std::stringstream list(seen);
  for (std::string place; std::getline(list, place, ',');) places.push_back(place);
  ASSERT_EQ(places.size(), 4U) << seen;
  for (std::size_t i = 1; i < places.size(); ++i)
    EXPECT_NE(places[i], places[i - 1]) << (i == 1 ? "turned" : i == 2 ? "moved" : "zoomed") << ": " << seen;
}

TEST_F(ReportPage, IsDrawnByABrowserAtTwoSizes) {
  for (const char* size : {"1400,900", "390,844"}) {
    const std::string dom = page_in(program_, folder_, "out/report.html#check&step=12&theme=light", size);
    ASSERT_EQ(root_attribute(dom, "data-ready"), "true") << "the scripts did not run to their end";
    if (root_attribute(dom, "data-picture") == "none") GTEST_SKIP() << program_ << " offers no WebGL 2 here";
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
