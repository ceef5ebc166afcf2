#pragma once

#include <optional>

#include "support/measured_vessel.hpp"

namespace endowire::test {

// How every parameter of every anatomy is measured back.

/// Nothing where the vessel has no such thing.
using Measure = std::function<std::optional<double>(const MeasuredVessel&)>;
using Measures = std::map<std::string, Measure>;

inline Measure diameter_at(const char* mark) {
  return [mark](const MeasuredVessel& v) { return v.diameter(mark); };
}
inline Measure between_marks(const char* from, const char* to) {
  return [from, to](const MeasuredVessel& v) { return v.between(from, to); };
}
inline Measure length_of(const char* branch) {
  return [branch](const MeasuredVessel& v) { return v.length(branch); };
}
inline Measure take_off_of(const char* branch) {
  return [branch](const MeasuredVessel& v) { return v.take_off_deg(branch); };
}
inline Measure carina_of(const char* branch, const char* parameter) {
  return [branch, parameter](const MeasuredVessel& v) {
    return v.carina_radius_mm(branch, v.parameter(parameter));
  };
}
/// Where a branch leaves its parent, as arc length on the parent's axis, against a landmark there.
inline Measure from_parent(const char* branch, const char* mark) {
  return [branch, mark](const MeasuredVessel& v) {
    return std::abs(v.branch(branch).parent_arc_mm - v.arc(mark));
  };
}

inline double iliac_angle_deg(const MeasuredVessel& v) {
  const vessel::anatomy::Axis& right = v.made().branches[0].axis;
  const vessel::anatomy::AxisPoint on_right = right.at(v.arc("right common iliac"));
  Eigen::Vector3d mirrored = on_right.position_mm;
  mirrored.x() = -mirrored.x();
  const vessel::anatomy::Axis& left = v.branch("left iliac artery").axis;
  return MeasuredVessel::angle_deg(on_right.tangent, left.at(left.nearest_arc_mm(mirrored)).tangent);
}

inline double iliac_length_mm(const MeasuredVessel& v) {
  return v.branch("right internal iliac artery").parent_arc_mm - v.arc("aortic bifurcation");
}

inline Measures pelvis_measures() {
  return {{"aortic_bifurcation_deg", iliac_angle_deg},
          {"common_iliac_diameter_mm", diameter_at("right common iliac")},
          {"common_iliac_length_mm", iliac_length_mm},
          {"external_iliac_diameter_mm", diameter_at("right external iliac")},
          {"internal_iliac_diameter_mm", diameter_at("left internal iliac")},
          {"internal_iliac_length_mm", length_of("left internal iliac artery")},
          {"aortic_carina_radius_mm", carina_of("left iliac artery", "aortic_carina_radius_mm")},
          {"iliac_carina_radius_mm", carina_of("right internal iliac artery", "iliac_carina_radius_mm")}};
}

inline Measures arch_measures() {
  Measures m = pelvis_measures();
  const char* const trunk = "brachiocephalic to right carotid artery";
  const char* const carotid = "left carotid artery";
  const char* const subclavian = "left subclavian artery";
  m["arch_type"] = [=](const MeasuredVessel& v) {
    double top = -1e9;
    for (double s = v.arc("ascending aorta"); s < v.arc("isthmus"); s += 0.1) {
      const vessel::anatomy::AxisPoint p = v.made().branches[0].axis.at(s);
      top = std::max(top, p.position_mm.z() + v.mark("arch").lumen_radius_mm);
    }
    const double drop = top - v.mark("brachiocephalic ostium").position_mm.z();
    return std::ceil(drop / (2.0 * v.mark("right common carotid").lumen_radius_mm));
  };
  m["bovine"] = [=](const MeasuredVessel& v) { return v.branch(carotid).parent == 0 ? 0.0 : 1.0; };
  m["arch_radius_mm"] = [](const MeasuredVessel& v) {
    const vessel::anatomy::Axis& axis = v.made().branches[0].axis;
    double top = v.arc("arch");
    for (double s = v.arc("ascending aorta"); s < v.arc("isthmus"); s += 0.5)
      if (axis.at(s).position_mm.z() > axis.at(top).position_mm.z()) top = s;
    double sum = 0.0;
    for (const double aside : {-16.0, -8.0, 0.0, 8.0, 16.0})
      sum += axis.at(top + aside).curvature_per_mm.norm() / 5.0;
    return 1.0 / sum;
  };
  m["arch_plane_deg"] = [](const MeasuredVessel& v) {
    const Eigen::Vector3d along = v.made().branches[0].axis.at(v.arc("arch")).tangent;
    return std::atan2(along.y(), along.x()) * 180.0 / std::numbers::pi;
  };
  m["brachiocephalic_take_off_deg"] = take_off_of(trunk);
  m["left_carotid_take_off_deg"] =
      [=](const MeasuredVessel& v) -> std::optional<double> {  // of the arch; a bovine one leaves the trunk
    if (v.branch(carotid).parent != 0) return std::nullopt;
    return v.take_off_deg(carotid);
  };
  m["left_subclavian_take_off_deg"] = take_off_of(subclavian);
  m["brachiocephalic_to_carotid_mm"] = from_parent(trunk, "arch");
  m["carotid_to_subclavian_mm"] = from_parent(subclavian, "arch");
  m["ascending_diameter_mm"] = diameter_at("ascending aorta");
  m["arch_diameter_mm"] = diameter_at("arch");
  m["isthmus_diameter_mm"] = diameter_at("isthmus");
  m["diaphragm_diameter_mm"] = diameter_at("diaphragm");
  m["infrarenal_diameter_mm"] = diameter_at("infrarenal aorta");
  m["ascending_length_mm"] = from_parent(trunk, "sinotubular junction");
  m["descending_thoracic_length_mm"] = from_parent(subclavian, "diaphragm");
  m["abdominal_length_mm"] = between_marks("diaphragm", "aortic bifurcation");
  m["brachiocephalic_diameter_mm"] = diameter_at("brachiocephalic trunk");
  m["brachiocephalic_length_mm"] = between_marks("brachiocephalic ostium", "brachiocephalic division");
  m["common_carotid_diameter_mm"] = diameter_at("right common carotid");
  m["common_carotid_length_mm"] =
      [=](const MeasuredVessel& v) {  // where the calibre is half way between both
        const vessel::anatomy::Branch& b = v.branch(carotid);
        const double half = 0.5 * (v.mark("left common carotid").lumen_radius_mm +
                                   v.mark("left internal carotid").lumen_radius_mm);
        double s = v.arc("left common carotid");
        while (b.axis.at(s).radius_mm > half) s += 0.1;
        return s - b.ostium_arc_mm;
      };
  m["internal_carotid_diameter_mm"] = diameter_at("left internal carotid");
  m["carotid_length_mm"] = length_of(carotid);
  m["subclavian_diameter_mm"] = diameter_at("left subclavian");
  m["subclavian_length_mm"] = [](const MeasuredVessel& v) {
    return std::abs(v.mark("left subclavian end").position_mm.x() -
                    v.mark("left subclavian ostium").position_mm.x());
  };
  m["external_iliac_length_mm"] = [](const MeasuredVessel& v) {
    return v.arc("right external iliac end") - v.branch("right internal iliac artery").parent_arc_mm;
  };
  m["ostium_carina_radius_mm"] = carina_of(subclavian, "ostium_carina_radius_mm");
  m["trunk_carina_radius_mm"] = carina_of("right subclavian artery", "trunk_carina_radius_mm");
  m["sheath_depth_mm"] = between_marks("access", "right external iliac end");
  return m;
}

inline Measures iliofemoral_measures() {
  Measures m = pelvis_measures();
  m["infrarenal_diameter_mm"] = diameter_at("infrarenal aorta");
  m["infrarenal_length_mm"] = between_marks("aortic end", "aortic bifurcation");
  m["external_iliac_length_mm"] = from_parent("right internal iliac artery", "right groin");
  m["common_femoral_diameter_mm"] = diameter_at("right common femoral");
  m["common_femoral_length_mm"] = between_marks("left groin", "left femoral division");
  m["superficial_femoral_diameter_mm"] = diameter_at("left superficial femoral");
  m["superficial_femoral_length_mm"] =
      between_marks("right femoral division", "right superficial femoral end");
  m["deep_femoral_diameter_mm"] = diameter_at("right deep femoral");
  m["deep_femoral_length_mm"] = length_of("left deep femoral artery");
  m["femoral_carina_radius_mm"] = carina_of("right deep femoral artery", "femoral_carina_radius_mm");
  return m;
}

/// How far to the front a branch leaves, in the plane across its parent.
inline double forward_deg(const MeasuredVessel& v, const std::string& name) {
  const vessel::anatomy::Branch& b = v.branch(name);
  const Eigen::Vector3d axis = v.parent_of(b).axis.at(b.parent_arc_mm).tangent;
  Eigen::Vector3d d = b.axis.at(0.0).tangent;
  d -= d.dot(axis) * axis;
  return std::atan2(-d.y(), std::abs(d.x())) * 180.0 / std::numbers::pi;
}

inline Measures renal_measures() {
  Measures m = pelvis_measures();
  m["suprarenal_diameter_mm"] = diameter_at("suprarenal aorta");
  m["infrarenal_diameter_mm"] = diameter_at("infrarenal aorta");
  m["infrarenal_length_mm"] = from_parent("left renal artery", "aortic bifurcation");
  m["right_renal_higher_mm"] = [](const MeasuredVessel& v) {
    return v.branch("left renal artery").parent_arc_mm - v.branch("right renal artery").parent_arc_mm;
  };
  m["right_renal_diameter_mm"] = diameter_at("right renal");
  m["left_renal_diameter_mm"] = diameter_at("left renal");
  m["right_renal_length_mm"] = between_marks("right renal ostium", "right renal division");
  m["left_renal_length_mm"] = between_marks("left renal ostium", "left renal division");
  m["right_renal_axial_deg"] = [](const MeasuredVessel& v) { return forward_deg(v, "right renal artery"); };
  m["left_renal_axial_deg"] = [](const MeasuredVessel& v) { return forward_deg(v, "left renal artery"); };
  m["renal_take_off_deg"] = take_off_of("left renal artery");
  m["renal_carina_radius_mm"] = carina_of("left renal artery", "renal_carina_radius_mm");
  m["hilar_carina_radius_mm"] = carina_of("left posterior renal branch", "hilar_carina_radius_mm");
  m["external_iliac_length_mm"] = from_parent("right internal iliac artery", "right external iliac end");
  m["sheath_depth_mm"] = between_marks("access", "right external iliac end");
  return m;
}

inline Measures coronary_measures() {
  const char* const left = "left main to anterior descending artery";
  return {{"right", [=](const MeasuredVessel& v) { return v.mark("access").branch == left ? 0.0 : 1.0; }},
          {"ascending_diameter_mm", diameter_at("ascending aorta")},
          {"ostium_height_mm", [=](const MeasuredVessel& v) { return v.branch(left).parent_arc_mm; }},
          {"left_main_diameter_mm", diameter_at("left main")},
          {"left_main_length_mm", between_marks("left main ostium", "left main division")},
          {"left_main_division_deg", take_off_of("circumflex artery")},
          {"anterior_descending_diameter_mm", diameter_at("anterior descending")},
          {"distal_descending_diameter_mm",
           [=](const MeasuredVessel& v) {
             const vessel::anatomy::Axis& axis = v.branch(left).axis;
             return 2.0 * v.inscribed_mm(axis.at(axis.length_mm() - 0.5).position_mm);
           }},
          {"anterior_descending_length_mm", between_marks("left main division", "anterior descending end")},
          {"circumflex_diameter_mm", diameter_at("circumflex")},
          {"circumflex_length_mm", length_of("circumflex artery")},
          {"right_coronary_diameter_mm", diameter_at("right coronary")},
          {"posterior_descending_diameter_mm", diameter_at("posterior descending")},
          {"posterior_descending_length_mm", between_marks("crux", "posterior descending end")},
          {"ostium_carina_radius_mm", carina_of(left, "ostium_carina_radius_mm")},
          {"carina_radius_mm", carina_of("circumflex artery", "carina_radius_mm")},
          {"guide_depth_mm", [](const MeasuredVessel& v) { return v.mark("access").arc_mm; }}};
}

inline Measures siphon_measures() {
  // Arc over angle in the middle half of a bend.
  const auto bend_radius = [](const MeasuredVessel& v, double from, double to) {
    const vessel::anatomy::Axis& axis = v.made().branches[0].axis;
    const double a = 0.75 * from + 0.25 * to;
    const double b = 0.25 * from + 0.75 * to;
    return (b - a) /
           (MeasuredVessel::angle_deg(axis.at(a).tangent, axis.at(b).tangent) * std::numbers::pi / 180.0);
  };
  return {{"cervical_length_mm", between_marks("cervical end", "skull base")},
          {"petrous_length_mm", between_marks("petrous begin", "petrous exit")},
          {"cavernous_length_mm", between_marks("cavernous begin", "cavernous exit")},
          {"posterior_bend_radius_mm",
           [=](const MeasuredVessel& v) {
             return bend_radius(v, v.arc("posterior bend begin"), v.arc("cavernous begin"));
           }},
          {"anterior_bend_radius_mm",
           [=](const MeasuredVessel& v) {
             return bend_radius(v, v.arc("cavernous exit"), v.arc("supraclinoid begin"));
           }},
          {"anterior_bend_opening_deg",
           [](const MeasuredVessel& v) {
             const vessel::anatomy::Axis& axis = v.made().branches[0].axis;
             // Signed: the limbs open upwards.
             const Eigen::Vector3d in = axis.at(v.arc("cavernous exit") - 4.0).tangent;
             const Eigen::Vector3d out = -axis.at(v.arc("supraclinoid begin") + 4.0).tangent;
             const double angle = MeasuredVessel::angle_deg(in, out);
             return out.z() < in.z() ? angle : -angle;
           }},
          {"cervical_diameter_mm", diameter_at("cervical carotid")},
          {"cavernous_diameter_mm", diameter_at("cavernous carotid")},
          {"terminal_diameter_mm", diameter_at("terminal carotid")},
          {"middle_cerebral_diameter_mm", diameter_at("middle cerebral")},
          {"middle_cerebral_length_mm",
           [](const MeasuredVessel& v) {
             return v.made().branches[0].axis.length_mm() -
                    v.branch("anterior cerebral artery").parent_arc_mm;
           }},
          {"anterior_cerebral_diameter_mm",
           [](const MeasuredVessel& v) {
             const vessel::anatomy::Axis& axis = v.branch("anterior cerebral artery").axis;
             return 2.0 * v.inscribed_mm(axis.at(0.8 * axis.length_mm()).position_mm);
           }},
          {"anterior_cerebral_length_mm", length_of("anterior cerebral artery")},
          {"ophthalmic_diameter_mm",
           [](const MeasuredVessel& v) {
             const vessel::anatomy::Axis& axis = v.branch("ophthalmic artery").axis;
             return 2.0 * v.inscribed_mm(axis.at(0.8 * axis.length_mm()).position_mm);
           }},
          {"terminal_carina_radius_mm", carina_of("anterior cerebral artery", "terminal_carina_radius_mm")},
          {"ophthalmic_carina_radius_mm", carina_of("ophthalmic artery", "ophthalmic_carina_radius_mm")},
          {"sheath_depth_mm", between_marks("cervical end", "access")}};
}

inline Measures measures_of(const std::string& generator) {
  if (generator == "aortic_arch") return arch_measures();
  if (generator == "iliofemoral") return iliofemoral_measures();
  if (generator == "renal") return renal_measures();
  if (generator == "coronary") return coronary_measures();
  return siphon_measures();
}

}  // namespace endowire::test
