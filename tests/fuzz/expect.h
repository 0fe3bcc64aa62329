#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/error.h"

namespace alula::fuzz {

/// Ends the program, in every build, so that libFuzzer keeps the input.
inline void Expect(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

/// A message is one line that a terminal shows as it stands.
inline void ExpectOneLine(std::string_view message) {
  Expect(!message.empty() && message.size() < 1000, "a message is empty or too long");
  Expect(std::none_of(message.begin(), message.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }),
         "a message has characters that do not print");
}

/// Bad input may end in InputError of one line, and in nothing else.
template <typename Read>
void Try(const Read& read) {
  try {
    read();
  } catch (const base::InputError& error) {
    ExpectOneLine(error.what());
  }
}

}  // namespace alula::fuzz
