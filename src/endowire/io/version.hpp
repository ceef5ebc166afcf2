#pragma once

namespace endowire::io {

/// Version of the program that wrote a file; equals the project's (a test compares them).
inline constexpr const char* version = "0.1.0";

}  // namespace endowire::io
