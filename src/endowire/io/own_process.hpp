#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace endowire::io {

/// Of the clock on the wall, for work that waits instead of computing: a file of 2 GB from a slow disk takes less.
inline constexpr std::chrono::minutes process_time_limit{10};

/// Lets work that may crash on hostile input do so alone: in a child process with limits on memory and time, silent.
///
/// What the work returns comes back through a pipe; it is as trustworthy as the input that it was made of. The child ends
/// with the work, whatever is thrown there. The library starts no threads; a caller that has some gives them up in
/// the child, so the work must not wait for any.
/// @param more_bytes  of memory, beyond what this process has now; what comes back is no more either
/// @throws base::InputError  what the work throws; or one that begins with `label` when it crashes, throws anything
///                           else, runs out of memory, or takes longer than a minute of CPU or the time limit
[[nodiscard]] std::string in_own_process(const std::function<std::string()>& work, std::size_t more_bytes,
                                         const std::string& label,
                                         std::chrono::milliseconds time_limit = process_time_limit);

}  // namespace endowire::io
