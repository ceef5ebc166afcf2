#include "endowire/vessel/anatomy/aortic_arch.hpp"
#include "endowire/vessel/anatomy/iliac_parameters.hpp"

// Diameters are of the lumen. A range is mean ± 2 standard deviations of the source where it gives them, narrower
// where the text says so; two sources that disagree give the range between them.

namespace endowire::vessel::anatomy {

std::span<const Parameter> aortic_arch_parameters() {
  using enum Trait;
  static constexpr std::array own_table{
      // The arch.
      Parameter{
          "arch_type", "-", 1, 1, 3, true, own,
          "how far the brachiocephalic ostium lies below the top of the arch: (type - 1/2) carotid diameters",
          "Madhwal2008"},
      Parameter{"bovine", "-", 0, 0, 1, true, own, "1: the left carotid leaves the brachiocephalic trunk",
                "Layton2006"},
      Parameter{
          "arch_radius_mm", "mm", 34, 27, 42, false, stature,
          "radius of the arch's axis, half its width from axis to axis",
          "ArchApex2017: 84 mm (men) and 73 mm (women) across; from outer walls that is 28, from axes 39 mm"},
      Parameter{"arch_plane_deg", "deg", 62, 50, 75, false, own,
                "angle of the arch's plane to the coronal plane", "Shin2008: mean 62.2; range: estimate"},
      Parameter{"brachiocephalic_take_off_deg", "deg", 65, 30, 90, false, own,
                "angle of the trunk with the flow in the arch; 10 less for each type above I unless given",
                "Shin2008: mean 65.3; range: estimate, from a type III arch to upright"},
      Parameter{"left_carotid_take_off_deg", "deg", 75, 40, 95, false, own, "the same of the left carotid",
                "Shin2008: mean 46.9; estimate: nearer to its course to the head"},
      Parameter{"left_subclavian_take_off_deg", "deg", 112, 60, 125, false, own,
                "the same of the left subclavian",
                "Shin2008: mean 63.8 from the other side, 116; range: estimate"},
      Parameter{"brachiocephalic_to_carotid_mm", "mm", 15, 10.5, 22, false, own,
                "between the two ostia, along the arch's axis", "Chiu2013: 12.0 +- 5.6; Girsowicz2017: 21.8"},
      Parameter{"carotid_to_subclavian_mm", "mm", 15, 11, 24, false, own,
                "between the two ostia, along the arch's axis", "Chiu2013: 18.7 +- 5.6; Girsowicz2017: 14.3"},
      // The aorta.
      Parameter{"ascending_diameter_mm", "mm", 30.9, 22.7, 39.1, false, calibre, "ascending aorta",
                "Hager2002: 30.9 +- 4.1"},
      Parameter{"arch_diameter_mm", "mm", 27.7, 20.3, 35.1, false, calibre,
                "arch, where the left carotid leaves", "Hager2002: 27.7 +- 3.7"},
      Parameter{"isthmus_diameter_mm", "mm", 24.7, 16.7, 32.7, false, calibre,
                "isthmus, 25 mm behind the left subclavian", "Hager2002: 24.7 +- 4.0"},
      Parameter{"diaphragm_diameter_mm", "mm", 24.3, 17.3, 31.3, false, calibre, "aorta at the diaphragm",
                "Hager2002: 24.3 +- 3.5"},
      infrarenal_diameter,
      Parameter{"ascending_length_mm", "mm", 62.6, 45, 85, false, stature,
                "sinotubular junction to brachiocephalic ostium", "Chiu2013: 62.6 +- 11.4"},
      Parameter{"descending_thoracic_length_mm", "mm", 205, 175, 250, false, stature,
                "left subclavian ostium to diaphragm", "Vegas2018: 200 to 300; ArsMedica2016: 184 to 194"},
      Parameter{"abdominal_length_mm", "mm", 115, 95, 140, false, stature, "diaphragm to bifurcation",
                "Yahel1998: a third of the aorta behind the left subclavian"},
      // The vessels of the arch.
      Parameter{"brachiocephalic_diameter_mm", "mm", 12.5, 8.6, 16.4, false, calibre, "brachiocephalic trunk",
                "Yan2017: 12.50 +- 1.95"},
      Parameter{"brachiocephalic_length_mm", "mm", 32.5, 25, 45, false, stature,
                "from its ostium to its division", "Shin2008: mean 32.5; range: estimate"},
      Parameter{"common_carotid_diameter_mm", "mm", 6.3, 4.5, 8.4, false, calibre, "common carotids",
                "Krejza2006: 6.10 +- 0.80 (women), 6.52 +- 0.98 (men)"},
      Parameter{"common_carotid_length_mm", "mm", 124, 96, 152, false, stature,
                "left one, from its ostium; the right 12 mm more from the arch",
                "Choudhry2016: 124 +- 14 (left), 136 +- 12 (right)"},
      Parameter{"internal_carotid_diameter_mm", "mm", 4.9, 3.4, 6.8, false, calibre, "internal carotids",
                "Krejza2006: 4.66 +- 0.78 (women), 5.11 +- 0.87 (men)"},
      Parameter{
          "carotid_length_mm", "mm", 175, 168, 208, false, stature,
          "left carotid from its ostium to the end of the model, common and internal; the right ends as high",
          "Choudhry2016: 208 +- 19 to the skull base; shorter: estimate, for a smaller model"},
      Parameter{"subclavian_diameter_mm", "mm", 8.8, 6.0, 11.5, false, calibre, "subclavian arteries",
                "Yan2017: 10.41 +- 2.20 at the left ostium; narrower behind it: estimate"},
      Parameter{"subclavian_length_mm", "mm", 80, 60, 100, false, stature, "how far they reach to the side",
                "estimate: to the edge of the first rib"},
      // How round the edges are, and where a wire enters.
      Parameter{"ostium_carina_radius_mm", "mm", 1.6, 1.0, 2.5, false, own,
                "of the acute lip of an ostium of the arch",
                "estimate, unreported: a third to a half of the branch's radius"},
      Parameter{"trunk_carina_radius_mm", "mm", 1.2, 0.8, 2.0, false, own,
                "of the division of the brachiocephalic trunk",
                "estimate, unreported: narrower than at the ostia"},
      sheath_depth,
  };
  static constexpr auto table = joined(own_table, iliac_parameters);
  return table;
}

}  // namespace endowire::vessel::anatomy
