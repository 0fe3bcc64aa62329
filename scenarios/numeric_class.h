#pragma once

#include <map>
#include <string>
#include <string_view>

namespace alula::scenarios {

/// Whatever can change the last bit of a result, by name: CPU level, compiler, C library, OpenCV, BLAS, renderer.
/// Digests are comparable inside one class only. `renderer`: its Description(), empty where nothing was drawn.
std::map<std::string, std::string> Versions(std::string_view renderer);
std::string NumericClass(const std::map<std::string, std::string>& versions);

}  // namespace alula::scenarios
