#include "endowire/io/own_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <new>

#include "endowire/base/error.hpp"

namespace endowire::io {

using base::InputError;

namespace {

constexpr rlim_t cpu_seconds = 60;
constexpr char good = '+';
constexpr char bad_input = '-';
constexpr char no_memory = 'm';

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  static_cast<void>(::setrlimit(static_cast<__rlimit_resource>(resource), &both));
}

// The sanitizers reserve terabytes of address space, and one that is refused more may wait for ever instead of ending.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool address_space_is_limited = false;
#else
constexpr bool address_space_is_limited = true;
#endif

/// Address space of this process.
std::size_t own_bytes() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void write_all(int to, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(to, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    done += static_cast<std::size_t>(count);
  }
}

enum class End { closed, too_late, too_long };

/// What comes through a pipe until its other end is closed.
End read_all(int from, std::chrono::steady_clock::time_point until, std::size_t most, std::string& bytes) {
  std::array<char, 65536> buffer{};
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) return End::too_late;
    pollfd end{from, POLLIN, 0};
    constexpr std::int64_t longest_ms = 1'000'000;
    const int ready = ::poll(&end, 1, static_cast<int>(std::min<std::int64_t>(left, longest_ms)));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t count = ::read(from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return End::closed;
    if (bytes.size() + static_cast<std::size_t>(count) > most) return End::too_long;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// Ends the process, whatever happens in it: an exception that left it would run a second copy of the caller. One thrown
/// while an answer is put together ends it by std::terminate.
[[noreturn]] void be_child(const std::function<std::string()>& work, std::size_t more_bytes,
                           int answer) noexcept {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, cpu_seconds);
  if (address_space_is_limited) limit(RLIMIT_AS, own_bytes() + more_bytes);
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  std::string result;
  try {
    result = good + work();
  } catch (const InputError& error) {
    result = bad_input + std::string(error.what());
  } catch (const std::bad_alloc&) {
    result = no_memory;
  } catch (...) {
    ::_exit(1);
  }
  write_all(answer, result);
  ::_exit(0);  // without the destructors of what is the parent's
}

}  // namespace

std::string in_own_process(const std::function<std::string()>& work, std::size_t more_bytes,
                           const std::string& label, std::chrono::milliseconds time_limit) {
  const auto until = std::chrono::steady_clock::now() + time_limit;
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw InputError(label + ": cannot be read: no pipe is left");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    be_child(work, more_bytes, ends[1]);
  }
  ::close(ends[1]);
  std::string answer;
  End end = End::closed;
  if (child > 0) end = read_all(ends[0], until, more_bytes, answer);
  ::close(ends[0]);
  if (child > 0 && end != End::closed) ::kill(child, SIGKILL);
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (child < 0) throw InputError(label + ": cannot be read: no process can be started");
  if (end == End::too_late)
    throw InputError(fmt::format("{}: takes more than {:.3g} s to read; must be a smaller surface", label,
                                 std::chrono::duration<double>(time_limit).count()));
  if (end == End::too_long)
    throw InputError(label + ": is damaged: it gives more data than its length allows");
  if (answer.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw InputError(label + ": is damaged: its reader broke off");
  const char kind = answer[0];
  answer.erase(0, 1);
  if (kind == no_memory)
    throw InputError(label + ": is damaged, or asks for more memory than its length allows");
  if (kind == bad_input) throw InputError(answer);
  return answer;
}

}  // namespace endowire::io
