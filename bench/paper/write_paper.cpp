// write_paper FOLDER: tries the claims of the paper and writes FOLDER/paper.md with its figures in FOLDER/images/paper.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bends_section.hpp"
#include "compared.hpp"
#include "detection_section.hpp"
#include "endowire/base/error.hpp"
#include "long_wire_section.hpp"
#include "rods_section.hpp"
#include "sensitivity_section.hpp"
#include "vessels_section.hpp"

namespace {

namespace fs = std::filesystem;
using namespace endowire;
using paper::Section;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "an unknown processor";
}

std::string introduction() {
  return fmt::format(
      R"(# The paper's claims, tried

The method is that of Wang, Wu, Wei and Ma, *A robust and fast approach to simulating the behavior of guidewire in
vascular interventional radiology*, Comput. Med. Imaging Graph., 2015 (doi 10.1016/j.compmedimag.2014.10.006). Its
claims are tried here on our implementation of it, which differs in what the paper leaves open (`docs/decisions/`):
what holds, what holds partly and what does not. None of this says anything about the authors' own program.

Written by `make paper`; do not edit. Every number comes from that run. A verdict follows from the rule behind it.
Times are processor time of one thread on {}, {}; they depend on the machine and on what else it does, so compare
ratios. All else is the same from run to run.

)",
      processor(), ENDOWIRE_COMPILER);
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw base::InputError(path.string() + ": cannot be written");
}

/// The sections one by one, told on the way.
std::vector<Section> sections() {
  std::vector<Section> all;
  const auto add = [&](const char* name, Section section) {
    all.push_back(std::move(section));
    fmt::print("{}\n", name);
    std::fflush(stdout);
  };
  add("bends", paper::bends_section());
  const std::vector<paper::Case> cases = paper::generated_cases();
  std::vector<paper::Compared> compared;
  for (const paper::Case& one : cases) compared.push_back(paper::compared(one));
  add("rods", paper::rods_section(compared));
  add("detections", paper::detection_section(cases));
  add("sensitivity", paper::sensitivity_section({&compared[1], &compared[2]}));
  add("vessels", paper::vessels_section(compared, paper::real_cases()));
  add("long wire", paper::long_wire_section());
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: write_paper FOLDER\n");
    return 2;
  }
  try {
    const fs::path folder = argv[1];
    const fs::path pictures = folder / "images" / "paper";
    fs::create_directories(pictures);
    std::string text = introduction();
    for (const Section& section : sections()) {
      text += section.markdown;
      for (const paper::Figure& figure : section.figures) write(pictures / figure.file, figure.svg);
    }
    write(folder / "paper.md", text);
  } catch (const base::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
