#include "includes.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace endowire::tests {

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

const std::map<std::string, Names>& layers_below() {
  static const std::map<std::string, Names> below{
      {"base", {}},
      {"math", {"base"}},
      {"vessel", {"base", "math"}},
      {"rod", {"base", "math"}},
      {"solve", {"base", "math"}},
      {"contact", {"base", "math", "vessel", "rod", "solve"}},
      {"sim", {"base", "math", "vessel", "rod", "solve", "contact"}},
      {"imaging", {"base", "math", "vessel", "rod", "solve", "contact", "sim"}},
      {"batch", {"base", "math", "vessel", "rod", "solve", "contact", "sim"}},
      {"io", {"base", "math", "vessel", "rod", "solve", "contact", "sim", "imaging"}},
  };
  return below;
}

/// Names of the standard library have neither a folder nor an ending.
bool standard_or_eigen(const std::string& name) {
  return name.find_first_of("/.") == std::string::npos || name.rfind("Eigen/", 0) == 0;
}

bool one_tbb(const std::string& name) {
  return name.rfind("oneapi/tbb/", 0) == 0;
}

/// What is wrong with `#include "name"` or <name> in a file of `layer`; empty when nothing is.
std::string fault(const std::string& layer, const std::string& name, bool quoted) {
  std::smatch match;
  static const std::regex ours("^endowire/([a-z0-9_]+)/.+");
  if (std::regex_match(name, match, ours)) {
    const std::string target = match[1];
    if (layer == "apps") return "";
    if (layer == "judge") return "the judge shares no code with the simulator, but includes " + name;
    if (layers_below().count(target) == 0) return "unknown layer in " + name;
    if (target == layer || layers_below().at(layer).count(target) > 0) return "";
    return layer + " must not include " + target + " (" + name + ")";
  }
  if (layer == "apps" || layer == "judge") return "";
  if (quoted) return "name it from the source root, \"endowire/...\", not \"" + name + "\"";
  if (layer == "batch" && one_tbb(name)) return "";
  if (layer != "io" && !standard_or_eigen(name))
    return layer + " may use the standard library and Eigen alone, not <" + name + ">";
  return "";
}

void read_file(const fs::path& path, const fs::path& root, const std::string& layer, LayeringReport& report) {
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::ifstream file(path);
  std::string line;
  ++report.files;
  for (int number = 1; std::getline(file, line); ++number) {
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    ++report.includes;
    const std::string what = fault(layer, match[2], match[1] == "\"");
    if (!what.empty()) {
      report.violations.push_back(fs::relative(path, root).string() + ":" + std::to_string(number) + ": " +
                                  what);
    }
  }
}

void read_folder(const fs::path& folder, const fs::path& root, const std::string& layer,
                 LayeringReport& report) {
  if (!fs::is_directory(folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".hpp" || ending == ".cpp" || ending == ".h") read_file(entry.path(), root, layer, report);
  }
}

}  // namespace

LayeringReport read_includes(const fs::path& root) {
  LayeringReport report;
  for (const auto& entry : fs::directory_iterator(root / "src" / "endowire")) {
    const std::string layer = entry.path().filename().string();
    if (layers_below().count(layer) == 0) {
      report.violations.push_back("src/endowire/" + layer + ": not a layer");
      continue;
    }
    read_folder(entry.path(), root, layer, report);
  }
  read_folder(root / "apps", root, "apps", report);
  read_folder(root / "tools" / "check_crossings", root, "judge", report);
  std::sort(report.violations.begin(), report.violations.end());
  return report;
}

}  // namespace endowire::tests
