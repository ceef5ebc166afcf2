#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace endowire::io {

/// Lets work that may crash on hostile input do so alone: in a child process with limits on memory and time, silent.
///
/// What the work returns comes back through a pipe. The library starts no threads; a caller that has some gives them up in
/// the child, so the work must not wait for any.
/// @param more_bytes  of memory, beyond what this process has now
/// @throws base::InputError  what the work throws; or one that begins with `label` when it crashes, runs out of memory or
///                           takes longer than a minute of CPU
[[nodiscard]] std::string in_own_process(const std::function<std::string()>& work, std::size_t more_bytes,
                                         const std::string& label);

}  // namespace endowire::io
