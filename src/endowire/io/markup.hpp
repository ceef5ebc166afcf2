#pragma once

#include <string>
#include <string_view>

namespace endowire::io {

/// Text as it stands in HTML and SVG, between tags or in a quoted attribute: never read as markup. Control characters,
/// which XML forbids, become spaces.
[[nodiscard]] std::string escaped_markup(std::string_view text);

}  // namespace endowire::io
