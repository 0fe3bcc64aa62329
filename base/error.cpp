#include "base/error.h"

namespace alula::base {

namespace {

std::string Compose(const SourcePosition& where, std::string_view key, std::string_view message) {
  std::string text;
  if (!where.file.empty()) {
    text += where.file;
    if (where.line > 0) text += ":" + std::to_string(where.line);
    if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
    text += ": ";
  }
  if (!key.empty()) {
    text += key;
    text += ": ";
  }
  text += message;
  // It may quote what a file says; a terminal gets one line of characters that print.
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace

InputError::InputError(const SourcePosition& where, std::string_view key, std::string_view message)
    : std::runtime_error(Compose(where, key, message)) {}

}  // namespace alula::base
