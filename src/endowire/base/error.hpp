#pragma once

#include <stdexcept>
#include <string>

namespace endowire::base {

/// Bad input: a file, a flag, a scene, an argument. The message is one calm line that names the file,
/// the field, its value and what is allowed: `scene.toml: instrument[0].radius_mm is -2; must be > 0`.
/// The command line shows it and exits with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace endowire::base
