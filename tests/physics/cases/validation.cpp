#include "validation.hpp"

#include <iterator>
#include <utility>

#include "cases.hpp"
#include "figures.hpp"
#include "refinement.hpp"

namespace endowire::test {

namespace {

Checks together(std::vector<Checks> parts) {
  Checks all;
  for (Checks& part : parts)
    all.insert(all.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  return all;
}

void add_statics(std::vector<Section>& sections) {
  sections.push_back({"V1 Tip-loaded cantilever",
                      "Clamped at the hand, a dead force P normal to the unloaded wire at the tip, α = P "
                      "L²/EI. The closed form is the "
                      "elastica, by shooting. Angle and place of the tip.",
                      {tip_loaded_figure()},
                      with_order(tip_loaded_cantilever, kRods)});
  sections.push_back({"V2 Cantilever under its own weight",
                      "The same without the force, under a weight w per length, γ = w L³/EI.",
                      {self_weight_figure()},
                      with_order(self_weight_cantilever, kRods)});
  sections.push_back({"V3 Roll-up",
                      "A straight wire rolled up by an end moment. At M = 2πEI/L all n joints turn by 2π/n: "
                      "the closed form of the "
                      "chain itself. At three quarters of a turn the arc of a circle: that of the continuum.",
                      {roll_up_figure()},
                      with_order(roll_up, kRods)});
  sections.push_back({"V4 Euler column",
                      "Clamped at one end, free at the other, compressed. The load at which the "
                      "factorisation begins to count "
                      "negative eigenvalues; higher modes follow at 9 and 25 times.",
                      {column_figure()},
                      with_order(euler_column, kRods)});
  sections.push_back({"V5 Column after buckling",
                      "Pinned ends, on the buckled branch, by the angle of its ends; k = sin(angle/2), K and "
                      "E complete elliptic "
                      "integrals.",
                      {buckled_column_figure()},
                      with_order(buckled_column, kRods)});
  sections.push_back({"V6 Michell's ring",
                      "A straight wire closed to a ring and twisted: an open chain whose first and last rods "
                      "lie on each other, "
                      "clamped. The twist at which the factorisation counts negative eigenvalues; modes of n "
                      "waves round the ring "
                      "follow at √(n² − 1).",
                      {michell_ring_figure()},
                      with_order(michell_ring, kRods)});
  sections.push_back({"V7 Twisted rod under tension",
                      "Onset: both ends clamped, tension T dead, ends turned against each other; of finite "
                      "length by its own "
                      "equation, of endless length by extrapolation from 50 and 100 √(EI/T). Localised: the "
                      "ends held where the "
                      "closed form has them (under dead loads it is no minimum); tension, moment and shape "
                      "are the answer. Four turns "
                      "and the straight ends need 400 rods.",
                      {localised_rod_figure()},
                      together({twisted_rod(kRods), with_order(localised_rod, kLocalisedRods)})});
}

void add_contact(std::vector<Section>& sections) {
  sections.push_back({"V8 Torque whip",
                      "A wire of rest curvature κ0 in a curve κt, turned at the hand: α is the angle between "
                      "the two planes, "
                      "Λ = L √(EI κ0 κt/GJ). On a given curve only the spins are free; in a tight tube "
                      "(clearance 5 µm, no friction) all of "
                      "a simulation takes part. From Λ = π/2 the tip snaps.",
                      {whip_figure(), whip_in_a_tube_figure()},
                      together({whip_on_a_given_curve(kRods), whip_in_a_tube()})});
  sections.push_back({"V9 Helix in a cylinder",
                      "A weightless wire, compressed, on the wall of a straight cylinder with clearance r; "
                      "the tip runs round it "
                      "freely. Without friction it finds its pitch p. With friction (μ = 0.5) it is pushed "
                      "on until all of it slides, "
                      "and locks up towards x = 4EI/(μ r F₀).",
                      {helix_figure(), locking_helix_figure()},
                      together({helix_in_a_cylinder(), locking_helix()})});
  sections.push_back({"V10 Capstan",
                      "A limp wire on the inside of a bend of total angle Θ, drawn back by the hand against "
                      "a dead force at its tip.",
                      {capstan_figure()},
                      capstan()});
  sections.push_back(
      {"V11 Insertion into a bend",
       "A straight wire, EI = 100 N·mm², pushed without friction into a bend of R = 20 mm. With clearance → "
       "0 each length that enters "
       "costs EI/2R². With clearance c, and once the tip is far from the sheath, what is added lies on the "
       "outer wall: EI/2(R + c)², "
       "reached in a torus, as half a turn is too short. On the way there the hand feels more; how much is "
       "known from "
       "elsewhere to the whole percent only. At any time its work is the energy that the wire gains.",
       {torus_figure()},
       together({insertion_into_a_bend(), insertion_into_a_torus()})});
  sections.push_back({"V12 Pre-curved tip at a wall",
                      "A tip of rest curvature κ0 and length L from the clamp, held by a plane wall at "
                      "offset c; small angles.",
                      {curved_tip_figure()},
                      curved_tip_at_a_wall()});
  sections.push_back({"V13 Three-point bend",
                      "The bench test by which the moduli of real 0.035\" wires were measured, on the shafts "
                      "of the wires of the library that were.",
                      {three_point_bend_figure()},
                      with_order(three_point_bend, kRods)});
}

void add_fields_and_invariance(std::vector<Section>& sections) {
  sections.push_back(
      {"V14 Coaxial instruments",
       "A wire and a catheter around it, EI = 10 and 30 N·mm², on one centreline, each with "
       "its own frames and rest curvature; clamped at the hands, without friction on each other. "
       "Turned against each other by α they pull back: "
       "c = B₁B₂/(B₁ + B₂) κ̄₁κ̄₂ (1/C₁ + 1/C₂), B in bending, C in torsion. From L√c = ½π the hands "
       "cannot turn them by 180°: the tip snaps round. A problem of statics: the simulator itself "
       "moves one instrument in a vessel.",
       {coaxial_figure()},
       together({with_order(coaxial_instruments, kRods), coaxial_stiff_in_torsion(), coaxial_snap()})});
  sections.push_back({"V15 Distance field",
                      "Analytic fields at 2000 places; those of meshes at all of 20 000 places that lie "
                      "within 1 mm of the wall, "
                      "against the round shape that the facets stand for. Facets lie inside it by up to "
                      "their sagitta R(1 − cos π/n).",
                      {facets_figure()},
                      together({analytic_fields(), faceted_vessels()})});
  sections.push_back({"V16 Order, balance, invariance",
                      "Errors fall with the square of the rod length: the column *order* above, from half as "
                      "many rods. A wire with a "
                      "curved tip pushed 70 mm through a bent tube must come to the same forces and shape "
                      "wherever the world stands, at "
                      "any step without friction, to first order in the step with it. Forces and moments "
                      "balance; the residual is that "
                      "of the solver less its floor of 10⁻⁹ N and N·mm. Work lost without friction is "
                      "numerical: negative where "
                      "rods that enter store a little less than the same rods as they leave.",
                      {refinement_figure(), step_size_figure()},
                      together({internal_balance(), balance_at_rest(), work_in_and_out(), rigid_motion(),
                                step_size_without_friction(), step_size_with_friction(),
                                rod_length_in_contact(), remeshing()})});
}

}  // namespace

std::vector<Section> validation() {
  std::vector<Section> sections;
  add_statics(sections);
  add_contact(sections);
  add_fields_and_invariance(sections);
  return sections;
}

}  // namespace endowire::test
