#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

/// The stack can be lifted out of the house and flown on a robot: its objects import no symbol of Bullet, GL or of the
/// simulator's rooms. ALULA_STACK_LIBRARIES names a file that lists them, one a line.
namespace {

/// Whether a mangled symbol belongs to what the stack must not know.
bool IsForbidden(const std::string& symbol) {
  static const std::regex kForbidden(
      "(^(gl|egl|OSMesa)[A-Z]\\w*$)"                                                     // C functions of GL
      "|([0-9](bt[A-Z]|Bt[A-Z]))"                                                        // Bullet's classes
      "|(N[A-Z]*5alula(8geometry|6worlds|8vehicles|6render|3sim|9scenarios)[0-9A-Z])");  // rooms of the simulator
  return std::regex_search(symbol, kForbidden);
}

std::vector<std::string> UndefinedSymbols(const std::string& library) {
  std::vector<std::string> symbols;
  const std::string command = "nm --undefined-only --format=posix '" + library + "' 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return symbols;
  char line[8192];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    std::istringstream words(line);
    std::string symbol, kind;
    if (words >> symbol >> kind && kind == "U") symbols.push_back(symbol);
  }
  return pclose(pipe) == 0 ? symbols : std::vector<std::string>();
}

TEST(StackSymbols, ForbiddenOnesAreRecognised) {
  EXPECT_TRUE(IsForbidden("_ZN11btRigidBody12applyImpulseERK9btVector3S2_"));
  EXPECT_TRUE(IsForbidden("_ZTI16btCollisionShape"));
  EXPECT_TRUE(IsForbidden("glDrawArrays"));
  EXPECT_TRUE(IsForbidden("eglGetDisplay"));
  EXPECT_TRUE(IsForbidden("OSMesaMakeCurrent"));
  EXPECT_TRUE(IsForbidden("_ZNK5alula8geometry4Mesh4sizeEv"));
  EXPECT_TRUE(IsForbidden("_ZN5alula3sim10Simulation4StepEv"));
  EXPECT_FALSE(IsForbidden("_ZN5alula5stack7mapping3Map3AddEv"));
  EXPECT_FALSE(IsForbidden("_ZN5alula4base12RandomStream4BitsEv"));
  EXPECT_FALSE(IsForbidden("global_thing"));
}

TEST(StackSymbols, TheStackImportsNoneOfThem) {
  std::ifstream list(ALULA_STACK_LIBRARIES);
  std::size_t libraries = 0, symbols = 0;
  for (std::string library; std::getline(list, library);) {
    if (library.empty()) continue;
    ++libraries;
    for (const std::string& symbol : UndefinedSymbols(library)) {
      ++symbols;
      EXPECT_FALSE(IsForbidden(symbol)) << library << " imports " << symbol;
    }
  }
  EXPECT_GT(libraries, 0u);
  EXPECT_GT(symbols, 100u) << "nm gave next to nothing";
}

}  // namespace
