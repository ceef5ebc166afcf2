#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace endowire::test {

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

inline std::string quoted(const std::string& text) {
  std::string result(1, '\'');
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  result += '\'';
  return result;
}

/// Runs the built program as a user would; its working folder is the test's.
/// @param environment  e.g. "NAME=value"
inline Outcome run_endowire(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                            const std::string& environment = "") {
  const std::filesystem::path out = folder / ".stdout";
  const std::filesystem::path err = folder / ".stderr";
  std::string command = "cd ";
  command.append(quoted(folder.path().string()))
      .append(" && ")
      .append(environment)
      .append(" ")
      .append(quoted(ENDOWIRE_PROGRAM));
  for (const std::string& argument : arguments) command.append(" ").append(quoted(argument));
  command.append(" > ").append(quoted(out.string())).append(" 2> ").append(quoted(err.string()));
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  return outcome;
}

}  // namespace endowire::test
