#include "compared.hpp"

#include <filesystem>

namespace endowire::paper {

std::vector<Case> generated_cases() {
  std::vector<Case> cases;
  cases.push_back({"wide", "aortic arch, 0.035\" wire pushed 450 mm", shipped_scene("generated_entry.toml")});
  cases.push_back({"branching", "aortic arch, 0.035\" wire steered into the left carotid",
                   shipped_scene("generated_left_carotid.toml")});
  cases.push_back({"tortuous", "carotid siphon, 0.014\" wire pushed 140 mm and turned",
                   push_into("carotid_siphon", 140.0, 3.0)});
  cases.push_back({"narrow", "left coronary artery, 0.014\" wire pushed 80 mm and turned",
                   push_into("coronary", 80.0, 3.0)});
  return cases;
}

std::vector<Case> real_cases() {
  std::vector<Case> cases;
  if (!std::filesystem::exists(ENDOWIRE_SOURCE_DIR "/../shared/vessels/femoral_to_neuro/lumen_mm.stl"))
    return cases;
  cases.push_back(
      {"real, wide", "a patient's aorta, 0.035\" wire pushed 450 mm", shipped_scene("femoral_entry.toml")});
  cases.push_back({"real, branching", "the same, steered into the left carotid",
                   shipped_scene("femoral_to_left_carotid.toml")});
  return cases;
}

Compared compared(const Case& subject) {
  Compared result;
  result.subject = &subject;
  result.reference = play(subject.procedure, fixed_rods(0.5));
  for (const Kind& kind : kinds()) result.runs.push_back(play(subject.procedure, kind.rods()));
  return result;
}

}  // namespace endowire::paper
