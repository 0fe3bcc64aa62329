#include "scenarios/write_file.h"

#include <cstdio>
#include <fstream>

#include "base/error.h"

namespace alula::scenarios {

void WriteFile(std::string_view option, const std::filesystem::path& file, std::string_view text) {
  if (file == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  const std::filesystem::path partial = file.string() + ".partial";
  std::ofstream stream(partial, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(partial, file, error);
  if (!stream || error) {
    std::filesystem::remove(partial, error);
    throw base::InputError(std::string(option) + ": cannot write " + file.string());
  }
}

}  // namespace alula::scenarios
