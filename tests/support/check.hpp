#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace endowire::test {

enum class ErrorKind { relative, absolute };

/// One number of the simulator beside its closed form: a line of docs/validation.md, and what a test asserts.
struct Check {
  std::string test;      ///< "V1"
  std::string quantity;  ///< what is compared, with its parameter and unit
  std::string formula;   ///< closed form
  double reference = 0.0;
  double ours = 0.0;
  double tolerance = 0.0;
  ErrorKind kind = ErrorKind::relative;
  std::string source;
  /// Of the error as rods get shorter, measured by twice as long ones; no number where that says nothing.
  double order = std::numeric_limits<double>::quiet_NaN();

  /// Infinite when the solver did not converge: a case reports that as a value that is not finite.
  [[nodiscard]] double error() const {
    const double difference = ours - reference;
    const double e = kind == ErrorKind::relative ? difference / reference : difference;
    return std::isfinite(e) ? e : HUGE_VAL;
  }
  [[nodiscard]] bool holds() const { return std::abs(error()) <= tolerance; }
};

using Checks = std::vector<Check>;

}  // namespace endowire::test
