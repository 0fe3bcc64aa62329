// Our own stacks as a shared library. The parameters are the scenario's `stack`: "stack: {type: position_relay, …}".
#include <variant>

#include "base/config.h"
#include "stack/interface/plugin_export.h"
#include "stack/pilot/position_relay_stack.h"
#include "stack/pilot/visual_inertial_stack.h"

namespace {

using namespace alula;  // NOLINT: a test's own library
using stack::pilot::PositionRelayConfig;
using stack::pilot::VisualInertialConfig;

struct HouseConfig {
  std::variant<PositionRelayConfig, VisualInertialConfig> stack;
};
void Describe(base::Description& d, HouseConfig& c) {
  d.OneOf("stack", c.stack, {.meaning = "which", .choices = {"position_relay", "visual_inertial"}});
}

std::unique_ptr<stack::NavigationStack> Make(const stack::Calibration& calibration, const stack::Mission& mission,
                                             std::uint64_t seed, int workers, std::string_view parameters) {
  const auto config = base::ReadConfig<HouseConfig>(base::YamlDocument::Parse(parameters, "stack.parameters"), seed);
  if (const auto* relay = std::get_if<PositionRelayConfig>(&config.stack)) {
    return stack::pilot::MakePositionRelayStack(calibration, mission, *relay);
  }
  return stack::pilot::MakeVisualInertialStack(calibration, mission, std::get<VisualInertialConfig>(config.stack), seed,
                                               workers);
}

}  // namespace

ALULA_EXPORT_STACK(Make)
