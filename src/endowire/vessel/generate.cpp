#include "endowire/vessel/generate.hpp"

#include <array>
#include <cmath>

#include "endowire/base/error.hpp"
#include "endowire/vessel/anatomy/aortic_arch.hpp"
#include "endowire/vessel/anatomy/carotid_siphon.hpp"
#include "endowire/vessel/anatomy/coronary.hpp"
#include "endowire/vessel/anatomy/iliofemoral.hpp"
#include "endowire/vessel/anatomy/renal.hpp"

namespace endowire::vessel {
namespace {

using anatomy::Plan;
using anatomy::Settings;
using anatomy::Values;

/// Draws of a seed until one is possible. One in two was the worst of 200 seeds.
constexpr std::uint64_t most_attempts = 50;

/// How one anatomy is made from numbers.
struct Recipe {
  const char* name;
  const char* meaning;
  std::span<const anatomy::Parameter> (*parameters)();
  void (*adjust)(Values& values, const Settings& given);
  std::string (*conflict)(const Values& values);
  Plan (*plan)(const Values& values);
};

void nothing(Values& /*values*/, const Settings& /*given*/) {}

constexpr std::array recipes{
    Recipe{"aortic_arch",
           "right groin to neck: iliac arteries, aorta, arch of type I, II or III and its vessels",
           anatomy::aortic_arch_parameters, anatomy::adjust_aortic_arch, anatomy::aortic_arch_conflict,
           anatomy::aortic_arch},
    Recipe{"iliofemoral", "both groins: infrarenal aorta, iliac and femoral arteries, for crossing over",
           anatomy::iliofemoral_parameters, nothing, anatomy::iliofemoral_conflict, anatomy::iliofemoral},
    Recipe{"renal", "right groin to the kidneys: iliac arteries, abdominal aorta, renal arteries",
           anatomy::renal_parameters, nothing, anatomy::renal_conflict, anatomy::renal},
    Recipe{"coronary", "aortic root and coronary arteries", anatomy::coronary_parameters, nothing,
           anatomy::coronary_conflict, anatomy::coronary},
    Recipe{"carotid_siphon",
           "internal carotid artery from the neck through the siphon to the cerebral arteries",
           anatomy::carotid_siphon_parameters, nothing, anatomy::carotid_siphon_conflict,
           anatomy::carotid_siphon},
};

const Recipe& recipe_of(const std::string& name, const std::string& field) {
  std::string known;
  for (const Recipe& recipe : recipes) {
    if (name == recipe.name) return recipe;
    known += std::string(known.empty() ? "" : ", ") + '"' + recipe.name + '"';
  }
  throw base::InputError(field + " is \"" + name + "\"; must be one of " + known);
}

/// Why these numbers give no vessel, as a whole message; empty when they give `plan`.
std::string try_plan(const Recipe& recipe, const Values& values, const std::string& prefix, Plan& plan) {
  if (const std::string conflict = recipe.conflict(values); !conflict.empty()) return prefix + conflict;
  plan = recipe.plan(values);
  const std::string fault = fault_of(plan);
  if (fault.empty()) return {};
  return prefix.substr(0, prefix.find_last_not_of(". ") + 1) + ": they " + fault;
}

Values values_of(const Recipe& recipe, const GenerateRequest& request, Plan& plan) {
  const std::string& prefix = request.settings_prefix;
  std::string why;
  for (std::uint64_t attempt = 0; attempt < (request.seed ? most_attempts : 1); ++attempt) {
    Values values = request.seed
                        ? drawn(recipe.parameters(), request.settings, prefix, *request.seed, attempt)
                        : complete(recipe.parameters(), request.settings, prefix);
    recipe.adjust(values, request.settings);
    why = try_plan(recipe, values, prefix, plan);
    if (why.empty()) return values;
  }
  throw base::InputError(why);
}

void describe(GeneratedVessel& vessel, const Plan& plan, const Values& values) {
  const auto landmark = [&](const anatomy::NamedPlace& place) {
    const anatomy::Branch& branch = plan.branches[place.branch];
    const anatomy::AxisPoint at = branch.axis.at(place.arc_mm);
    vessel.landmarks.push_back(
        {place.name, branch.name, place.arc_mm - branch.ostium_arc_mm, at.position_mm, at.radius_mm});
  };
  landmark(plan.access);
  for (const anatomy::NamedPlace& place : plan.landmarks) landmark(place);
  const anatomy::AxisPoint access = plan.branches[plan.access.branch].axis.at(plan.access.arc_mm);
  vessel.access_position_mm = access.position_mm;
  vessel.access_direction = plan.access_backward ? Eigen::Vector3d(-access.tangent) : access.tangent;
  vessel.route_mm = std::abs(plan.access.arc_mm - plan.route_end_arc_mm);
  vessel.branches = plan.branches;
  for (std::size_t i = 0; i < values.numbers().size(); ++i)
    vessel.parameters.push_back({values.table()[i].name, values.numbers()[i]});
}

Generator generator_of(const Recipe& recipe) {
  return {recipe.name, recipe.meaning, recipe.parameters()};
}

}  // namespace

std::vector<Generator> generators() {
  std::vector<Generator> all;
  all.reserve(recipes.size());
  for (const Recipe& recipe : recipes) all.push_back(generator_of(recipe));
  return all;
}

Generator generator_named(const std::string& name, const std::string& field) {
  return generator_of(recipe_of(name, field));
}

GeneratedVessel generate(const GenerateRequest& request) {
  const Recipe& recipe = recipe_of(request.name, request.generator_field);
  Plan plan;
  const Values values = values_of(recipe, request, plan);
  apply_lesions(plan, request.lesions, request.stenosis_field, request.aneurysm_field);
  // Without its lesions the plan had no fault, and a stenosis brings nothing nearer.
  if (const std::string fault = request.lesions.empty() ? "" : fault_of(plan); !fault.empty())
    throw base::InputError(request.aneurysm_field + ": they " + fault);
  std::optional<TriangleMesh> mesh = mesh_of(plan, request.open_ends);
  if (!mesh)
    throw base::InputError(
        request.generator_field +
        ": this vessel touches itself, or its wall turns too sharply; must be wider bends, or "
        "lesions that are longer or change the diameter less");
  GeneratedVessel vessel;
  describe(vessel, plan, values);
  vessel.mesh = std::move(*mesh);
  return vessel;
}

}  // namespace endowire::vessel
