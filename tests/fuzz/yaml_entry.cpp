#include "tests/fuzz/yaml_entry.h"

#include <cstdlib>
#include <string_view>

#include "base/config.h"
#include "base/error.h"
#include "tests/base/sample_config.h"

namespace alula::fuzz {

namespace {

using base::sample::Read;
using base::sample::Vehicle;

void ReadOne(std::string_view text, const std::vector<base::Override>& overrides) {
  Vehicle vehicle;
  try {
    vehicle = Read(text, overrides);
  } catch (const base::InputError&) {
    return;
  }
  const std::string dump = base::DumpConfig(vehicle);
  if (base::DumpConfig(Read(dump)) != dump) std::abort();
}

}  // namespace

void ReadYaml(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ReadOne(text, {});
  ReadOne("mass: 1 kg\n", {{"rotors.0.radius", std::string(text)}});
  ReadOne("mass: 1 kg\n", {{std::string(text), "1"}});
}

}  // namespace alula::fuzz
