#include "endowire/vessel/anatomy/lesion.hpp"

#include <algorithm>
#include <cmath>

#include "endowire/base/error.hpp"
#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/sketch.hpp"

namespace endowire::vessel::anatomy {
namespace {

void check(const std::string& field, const char* name, double number, double low, double high) {
  if (number >= low && number <= high) return;
  throw base::InputError(field + "." + name + " is " + text_of(number) + "; must be between " + text_of(low) +
                         " and " + text_of(high));
}

std::size_t branch_of(const Plan& plan, const std::string& name, const std::string& field) {
  std::string known;
  for (std::size_t i = 0; i < plan.branches.size(); ++i) {
    if (plan.branches[i].name == name) return i;
    known += std::string(known.empty() ? "" : ", ") + '"' + plan.branches[i].name + '"';
  }
  throw base::InputError(field + ".branch is \"" + name + "\"; must be one of " + known);
}

void apply(Plan& plan, const LesionRequest& request, const std::string& field) {
  const std::size_t index = branch_of(plan, request.branch, field);
  const Branch& branch = plan.branches[index];
  const bool stenosis = request.kind == LesionRequest::Kind::stenosis;
  const double room = branch.axis.length_mm() - branch.ostium_arc_mm;
  check(field, "percent", request.percent, stenosis ? stenosis_least_percent : aneurysm_least_percent,
        stenosis ? stenosis_most_percent : aneurysm_most_percent);
  check(field, "length_mm", request.length_mm, lesion_least_mm, std::min(lesion_most_mm, room));
  // The shoulders end before the vessel does, so that its end keeps its calibre.
  check(field, "arc_mm", request.arc_mm, 0.5 * request.length_mm, room - 0.5 * request.length_mm);
  const double arc = branch.ostium_arc_mm + request.arc_mm;
  const double radius = branch.axis.at(arc).radius_mm;
  if (stenosis)
    check(field, "percent", request.percent, stenosis_least_percent,
          std::min(stenosis_most_percent, std::floor(100.0 * (1.0 - least_radius_mm / radius))));
  const double gentlest_mm = lesion_length_mm(0.01 * request.percent * radius, lesion_steepest);
  check(field, "length_mm", request.length_mm, 0.1 * std::ceil(10.0 * gentlest_mm), lesion_most_mm);
  const double factor = 1.0 + (stenosis ? -0.01 : 0.01) * request.percent;
  add_lesion(plan, index, {arc, request.length_mm, factor});
}

}  // namespace

void apply_lesions(Plan& plan, const std::vector<LesionRequest>& lesions, const std::string& stenosis_field,
                   const std::string& aneurysm_field) {
  int stenoses = 0;
  int aneurysms = 0;
  for (const LesionRequest& lesion : lesions) {
    const bool stenosis = lesion.kind == LesionRequest::Kind::stenosis;
    const int number = stenosis ? stenoses++ : aneurysms++;
    apply(plan, lesion, (stenosis ? stenosis_field : aneurysm_field) + "[" + std::to_string(number) + "]");
  }
}

}  // namespace endowire::vessel::anatomy
