#include "scenarios/factories.h"

#include <utility>

#include "base/error.h"
#include "worlds/check_start.h"

namespace alula::scenarios {
namespace {

template <typename... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

}  // namespace

std::shared_ptr<const worlds::World> MakeWorld(const WorldConfig& config, std::uint64_t seed) {
  auto world = std::make_shared<const worlds::World>(
      std::visit([&](const auto& c) { return worlds::MakeWorld(c, seed); }, config));
  worlds::CheckStart(*world);
  return world;
}

std::unique_ptr<vehicles::VehicleModel> MakeVehicle(const VehicleConfig& config, const std::string& name,
                                                    std::uint64_t seed) {
  return std::visit(Overloaded{
                        [&](const vehicles::QuadrotorConfig& c) { return vehicles::MakeQuadrotor(c, name, seed); },
                        [&](const vehicles::PrescribedConfig& c) { return vehicles::MakePrescribed(c, name); },
                    },
                    config);
}

std::unique_ptr<vehicles::Autopilot> MakeAutopilot(const AutopilotConfig& config, const VehicleConfig& vehicle) {
  if (std::holds_alternative<None>(config)) return nullptr;
  const auto* quadrotor = std::get_if<vehicles::QuadrotorConfig>(&vehicle);
  if (quadrotor == nullptr) throw base::InputError("autopilot: multicopter flies a vehicle of type quadrotor only");
  return vehicles::MakeMulticopterAutopilot(std::get<vehicles::MulticopterAutopilotConfig>(config), *quadrotor);
}

StackMaker MakerOf(const StackConfig& config) {
  namespace pilot = stack::pilot;
  using stack::Calibration, stack::Mission;
  return std::visit(Overloaded{
                        [](const None&) -> StackMaker { return {}; },
                        [](const pilot::PositionRelayConfig& c) -> StackMaker {
                          return [c](const Calibration& calibration, const Mission& mission, std::uint64_t, int) {
                            return pilot::MakePositionRelayStack(calibration, mission, c);
                          };
                        },
                        [](const pilot::VisualInertialConfig& c) -> StackMaker {
                          return [c](const Calibration& calibration, const Mission& mission, std::uint64_t seed,
                                     int workers) {
                            return pilot::MakeVisualInertialStack(calibration, mission, c, seed, workers);
                          };
                        },
                        [](const pilot::SlamStackConfig& c) -> StackMaker {
                          return [c](const Calibration& calibration, const Mission& mission, std::uint64_t,
                                     int workers) { return pilot::MakeSlamStack(calibration, mission, c, workers); };
                        },
                        [](const PluginConfig& c) -> StackMaker {
                          return [c](const Calibration& calibration, const Mission& mission, std::uint64_t seed,
                                     int workers) { return MakePluginStack(c, calibration, mission, seed, workers); };
                        },
                    },
                    config);
}

std::unique_ptr<Criterion> MakeCriterion(const CriterionConfig& config) {
  return std::visit(
      Overloaded{
          [](const TimeLimitConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<TimeLimit>(c); },
          [](const ContactsConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<Contacts>(c); },
          [](const ClearanceConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<Clearance>(c); },
          [](const GatesConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<Gates>(c); },
          [](const TargetReachedConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<TargetReached>(c); },
          [](const MeanSpeedConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<MeanSpeed>(c); },
          [](const AteConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<Ate>(c); },
          [](const LandedConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<Landed>(c); },
          [](const HoverErrorConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<HoverError>(c); },
          [](const BoundsConfig& c) -> std::unique_ptr<Criterion> { return std::make_unique<Bounds>(c); },
      },
      config);
}

}  // namespace alula::scenarios
