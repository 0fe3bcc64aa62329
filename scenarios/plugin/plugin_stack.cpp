#include "scenarios/plugin/plugin_stack.h"

#include <fstream>
#include <stdexcept>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "scenarios/plugin/internal/answer.h"
#include "scenarios/plugin/internal/float_state.h"
#include "scenarios/plugin/internal/given.h"
#include "scenarios/plugin/internal/library.h"
#include "scenarios/plugin/internal/utf8.h"
#include "stack/interface/plugin.h"

namespace alula::scenarios {
namespace {

using plugin::Given;
using plugin::KeepFloatState;

class PluginStack : public stack::NavigationStack {
 public:
  PluginStack(const PluginConfig& config, const stack::Calibration& calibration, const stack::Mission& mission,
              std::uint64_t seed, int workers)
      : library_(plugin::LoadLibrary(config.library, config.origin)),
        table_(library_.table),
        parameters_(config.parameters),
        given_(calibration, mission) {
    const AlulaSetup setup{
        &given_.calibration(), &given_.mission(), {parameters_.c_str(), parameters_.size()}, seed, workers, 0};
    const std::int32_t answer = Call([&] { return table_.create(&setup, &self_, &error_); });
    if (answer == ALULA_BAD_INPUT) throw base::InputError({}, "stack", ErrorText(answer));
    Expect(answer);
    made_ = true;
  }

  ~PluginStack() override {
    const KeepFloatState keep;
    if (made_) table_.destroy(self_);
  }

  PluginStack(const PluginStack&) = delete;
  PluginStack& operator=(const PluginStack&) = delete;

  stack::StackOutput Step(base::Time now, std::span<const stack::Measurement> measurements) override {
    plugin::Write(measurements, measurements_);
    AlulaOutput output{};
    Expect(
        Call([&] { return table_.step(self_, now.ns, measurements_.data(), measurements_.size(), &output, &error_); }));
    return plugin::Read(output);
  }

  bool SetComputeFactor(double factor) override {
    return library_.compute_factor != nullptr && Call([&] { return library_.compute_factor(self_, factor); }) != 0;
  }

  std::vector<stack::StackFile> Files() const override {
    AlulaFiles files{};
    if (table_.files != nullptr) Expect(Call([&] { return table_.files(self_, &files, &error_); }));
    return plugin::Read(files);
  }

  std::vector<stack::StageTime> Timing() const override {
    AlulaTiming timing{};
    if (table_.timing != nullptr) Expect(Call([&] { return table_.timing(self_, &timing, &error_); }));
    return plugin::Read(timing);
  }

 private:
  /// The one way into the library. What a careless one throws is given a form that does not need its code to be read.
  template <typename Function>
  std::int32_t Call(const Function& function) const {
    const KeepFloatState keep;
    error_.text[0] = '\0';
    std::string thrown;
    try {
      return function();
    } catch (const std::exception& e) {
      thrown = plugin::ValidUtf8(e.what());
    } catch (...) {
      thrown = "the stack threw something that is no std::exception";
    }
    throw std::runtime_error(thrown);
  }

  void Expect(std::int32_t answer) const {
    if (answer != ALULA_OK) throw std::runtime_error(ErrorText(answer));
  }

  std::string ErrorText(std::int32_t answer) const {
    error_.text[sizeof error_.text - 1] = '\0';
    if (error_.text[0] != '\0') return plugin::ValidUtf8(error_.text);
    return "the stack returned " + std::to_string(answer) + " and does not say why";
  }

  const plugin::Library library_;
  const AlulaStackPlugin& table_;
  const std::string parameters_;
  const Given given_;
  mutable AlulaError error_{};  // written to by every call, of which Files and Timing are const
  std::vector<AlulaMeasurement> measurements_;
  void* self_ = nullptr;
  bool made_ = false;
};

/// As YAML reads it back.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

void Describe(base::Description& d, PluginConfig& c) {
  d.Field("library", c.library,
          {.meaning = "a shared library with the stack", .required = true, .is_path = true, .origin = &c.origin});
  d.Field("parameters", c.parameters, {.meaning = "a text that the stack is given as it stands"});
}

std::unique_ptr<stack::NavigationStack> MakePluginStack(const PluginConfig& config,
                                                        const stack::Calibration& calibration,
                                                        const stack::Mission& mission, std::uint64_t seed,
                                                        int workers) {
  return std::make_unique<PluginStack>(config, calibration, mission, seed, workers);
}

base::Override StackOverride(const std::filesystem::path& library) {
  return {"stack", "{type: plugin, library: " + Quoted(library.string()) + "}"};
}

std::string HashOfLibrary(const std::filesystem::path& library) {
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::ifstream file(library, std::ios::binary);
  std::vector<char> chunk(kChunk);
  base::RollingHash hash;
  while (file.read(chunk.data(), kChunk), file.gcount() > 0) {
    hash.AddBytes({reinterpret_cast<const std::uint8_t*>(chunk.data()), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof() || file.bad()) {
    throw base::InputError({}, "stack.library", "`" + library.string() + "` cannot be read; is the name right?");
  }
  return hash.Hex();
}

}  // namespace alula::scenarios
