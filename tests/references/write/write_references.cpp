// write_references [NAME ...]: plays the scenes in all variations and writes tests/references/recorded/NAME.json; `make references`.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "endowire/io/file.hpp"
#include "reference.hpp"

int main(int argc, char** argv) {
  using namespace endowire;
  const std::vector<std::string> names(argv + 1, argv + argc);
  for (const test::ReferenceScene& scene : test::reference_scenes()) {
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end()) continue;
    if (scene.real_vessel && !std::filesystem::exists(std::string(ENDOWIRE_SHARED_DIR) + "/vessels")) {
      fmt::print("{}: left as it is, its vessel is not there\n", scene.name);
      continue;
    }
    const std::vector<test::KeptMoment> kept = test::keep(scene);
    io::write_file_atomically(test::recorded_file(scene), test::to_json(scene, kept).dump(1) + "\n");
    fmt::print("{}\n", scene.name);
    for (const test::KeptMoment& one : kept) {
      const auto text = [](const std::optional<test::Bounds>& bounds) {
        return bounds ? fmt::format("{:.4f} mm {:.5f} N", bounds->shape_mm, bounds->push_n)
                      : std::string("unstable");
      };
      fmt::print("  step {:>4} {:>3} rods, push {:.4f} N; bounds {:<22} other rods {}\n", one.moment.step,
                 one.moment.rods, one.moment.push_n, text(one.same_rods), text(one.other_rods));
    }
  }
  return 0;
}
