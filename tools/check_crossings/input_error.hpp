#pragma once

#include <stdexcept>

namespace crossings {

/// A file that cannot be judged: one line, exit 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace crossings
