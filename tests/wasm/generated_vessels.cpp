// Makes every anatomy, the usual one and one drawn from a seed, and prints what its triangles hash to.
//
//   generated_vessels              prints
//   generated_vessels FILE         compares with what another build printed into FILE; exit 1 when they differ
//
// Built by the native compiler and by Emscripten: a seed means the same person everywhere, to the last bit.
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <string>

#include "endowire/vessel/generate.hpp"

namespace {

using namespace endowire;

std::string all_hashes() {
  std::string text;
  for (const vessel::Generator& generator : vessel::generators())
    for (const bool drawn : {false, true}) {
      vessel::GenerateRequest request;
      request.name = generator.name;
      if (drawn) request.seed = 7;
      char hash[17] = {};
      std::snprintf(hash, sizeof hash, "%016" PRIx64, vessel::content_hash(vessel::generate(request).mesh));
      text += generator.name + (drawn ? " 7 " : " - ") + hash + "\n";
    }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string here = all_hashes();
  if (argc < 2) {
    std::fputs(here.c_str(), stdout);
    return 0;
  }
  std::ifstream file(argv[1]);
  const std::string there{std::istreambuf_iterator<char>(file), {}};
  std::printf("generated vessels %s\n", there == here ? "are the same to the last bit" : "differ");
  if (there != here) std::printf("here:\n%sthere:\n%s", here.c_str(), there.c_str());
  return there == here ? 0 : 1;
}
