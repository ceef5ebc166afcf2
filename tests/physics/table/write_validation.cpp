// write_validation FILE: runs the cases of physics and writes their table; when one misses its tolerance it writes nothing and
// exits with 1.
#include <fstream>
#include <iostream>

#include "cases.hpp"
#include "support/validation_table.hpp"

int main(int argc, char** argv) {
  using namespace endowire::test;
  if (argc != 2) {
    std::cerr << "usage: write_validation FILE\n";
    return 2;
  }
  const Checks checks = all_checks();
  bool all_hold = true;
  for (const Check& c : checks) {
    if (c.holds()) continue;
    all_hold = false;
    std::cerr << c.test << " " << c.quantity << ": error " << c.error() << ", allowed " << c.tolerance
              << "\n";
  }
  if (!all_hold) return 1;
  std::ofstream file(argv[1], std::ios::binary);
  file << validation_table(checks);
  if (!file.flush()) {
    std::cerr << argv[1] << ": cannot be written\n";
    return 2;
  }
  return 0;
}
