#include "crossings.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/vtp.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to the program

namespace endowire::cli {

namespace fs = std::filesystem;

namespace {

fs::path find_judge() {
  const fs::path here = program_folder();
  std::error_code error;
  for (const fs::path& path :
       {here / "check_crossings", here / ".." / ".." / "tools" / "check_crossings" / "check_crossings"})
    if (!here.empty() && fs::is_regular_file(path, error)) return path;
  return {};
}

struct Answer {
  int status = -1;
  std::string out;
};

/// Runs a program without a shell, so that no file name needs quoting; its stderr is dropped.
Answer ask(const std::vector<std::string>& arguments) {
  Answer answer;
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return answer;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0);
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  std::array<char, 4096> buffer{};
  while (failed == 0) {
    const ssize_t count = ::read(ends[0], buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    answer.out.append(buffer.data(), static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  if (failed == 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status))
    answer.status = WEXITSTATUS(status);
  return answer;
}

}  // namespace

io::CrossingVerdict judge_crossings(const fs::path& series, const fs::path& vessel, std::string_view unit) {
  if (!io::vtp_available())
    return {{}, "not judged: this build writes no wire.pvd (ENDOWIRE_WITH_VTK is off)"};
  const fs::path judge = find_judge();
  if (judge.empty()) return {{}, "not judged: check_crossings does not lie beside this program"};
  const Answer answer =
      ask({judge.string(), series.string(), vessel.string(), "--unit", std::string(unit), "--json"});
  const nlohmann::json verdict = nlohmann::json::parse(answer.out, nullptr, false);
  if ((answer.status == 0 || answer.status == 1) && verdict.is_object() && verdict.contains("crossings") &&
      verdict["crossings"].is_number_integer())
    return {verdict["crossings"].get<long long>(), ""};
  return {{},
          "not judged: check_crossings could not judge this recording (exit " +
              std::to_string(answer.status) + ")"};
}

}  // namespace endowire::cli
