#include <iterator>

#include "cases.hpp"

namespace endowire::test {

Checks all_checks() {
  Checks all;
  for (Checks part :
       {tip_loaded_cantilever(kRods), self_weight_cantilever(kRods), roll_up(kRods), euler_column(kRods),
        buckled_column(kRods), michell_ring(kRods), twisted_rod(kRods), localised_rod(kLocalisedRods),
        whip_on_a_given_curve(kRods), whip_in_a_tube(), helix_in_a_cylinder(), locking_helix(), capstan(),
        insertion_into_a_bend(), insertion_into_a_torus(), curved_tip_at_a_wall(), three_point_bend(kRods)}) {
    all.insert(all.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  }
  return all;
}

}  // namespace endowire::test
