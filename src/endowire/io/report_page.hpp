#pragma once

#include <string_view>

/// The files of io/report/, put into the program at build time (cmake/embed.cmake).
namespace endowire::io::report_page {

extern const std::string_view html;  ///< with {{title}}, {{style}}, {{run}}, {{script}} in it
extern const std::string_view style;
extern const std::string_view script;  ///< all scripts, in their order

}  // namespace endowire::io::report_page
