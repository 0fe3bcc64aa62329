#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/config.h"
#include "base/describe.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"

namespace alula::scenarios {

/// A stack from a shared library (stack/interface/plugin.h).
struct PluginConfig {
  std::string library;     // path of the shared library
  base::Origin origin;     // of `library`, for messages
  std::string parameters;  // handed to the stack as they stand
};
void Describe(base::Description& d, PluginConfig& c);

/// Loads the library and makes its stack. An answer that breaks the contract, an error return and an exception all come
/// out of the stack's functions as std::runtime_error; a crash or a hang is not caught here. The library stays loaded
/// until the process ends, because its threads and exit handlers may need it.
/// Throws base::InputError where the library is missing, is none, has no such symbol or another ABI, and where the
/// stack says that it cannot fly what it is given.
std::unique_ptr<stack::NavigationStack> MakePluginStack(const PluginConfig& config,
                                                        const stack::Calibration& calibration,
                                                        const stack::Mission& mission, std::uint64_t seed, int workers);

/// What `alula run SCENARIO --stack FILE` puts over the scenario: a library in place of the stack, which loses its keys
/// unless it was a library before (whose parameters stay). A relative path starts at the working directory.
base::Override StackOverride(const std::filesystem::path& library);

/// Sixteen hexadecimal digits of the file's content, for the verdict's versions. Throws base::InputError where it
/// cannot be read.
std::string HashOfLibrary(const std::filesystem::path& library);

}  // namespace alula::scenarios
