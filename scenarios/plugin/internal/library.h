#pragma once

#include <filesystem>

#include "base/describe.h"
#include "stack/interface/plugin.h"

namespace alula::scenarios::plugin {

/// What a library exports.
struct Library {
  const AlulaStackPlugin& table;
  decltype(&alula_stack_compute_factor) compute_factor = nullptr;  // null: it has none
};

/// Loads a shared library for the rest of the process and gives what it offers, once its ABI is known to be ours.
/// `origin`: where the path stands. Throws base::InputError.
Library LoadLibrary(const std::filesystem::path& library, const base::Origin& origin);

/// Why a library's table cannot be used; empty where it can.
std::string Mismatch(const AlulaStackPlugin& table);

}  // namespace alula::scenarios::plugin
