#pragma once

#include <string>
#include <string_view>

namespace alula::scenarios::campaign::internal {

/// A text made small for the database (zlib, its length before it), and back. Throws base::FaultError("database").
std::string Compressed(std::string_view text);
std::string Expanded(std::string_view bytes);

}  // namespace alula::scenarios::campaign::internal
