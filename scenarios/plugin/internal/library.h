#pragma once

#include <filesystem>

#include "base/describe.h"
#include "stack/interface/plugin.h"

namespace alula::scenarios::plugin {

/// Loads a shared library for the rest of the process and gives what it offers, once its ABI is known to be ours.
/// `origin`: where the path stands. Throws base::InputError.
const AlulaStackPlugin& LoadLibrary(const std::filesystem::path& library, const base::Origin& origin);

/// Why a library's table cannot be used; empty where it can.
std::string Mismatch(const AlulaStackPlugin& table);

}  // namespace alula::scenarios::plugin
