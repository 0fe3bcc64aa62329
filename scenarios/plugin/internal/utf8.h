#pragma once

#include <string>
#include <string_view>

namespace alula::scenarios::plugin {

/// Whether the text is well-formed UTF-8 (Unicode 15, table 3-7): JSON takes nothing else.
bool IsUtf8(std::string_view text);

/// The text with '?' in place of every byte that is no part of well-formed UTF-8.
std::string ValidUtf8(std::string_view text);

}  // namespace alula::scenarios::plugin
