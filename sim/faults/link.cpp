#include "sim/faults/link.h"

#include "base/error.h"
#include "sim/faults/sensor_choice.h"

namespace alula::sim::faults {
namespace {

class LostLink : public Fault {
 public:
  LostLink(Link::Direction direction, std::vector<Sensor> reports)
      : direction_(direction), reports_(std::move(reports)) {}
  std::string Words() const override {
    if (direction_ == Link::Direction::kUp) return "link: nothing of the stack reaches the autopilot";
    if (direction_ == Link::Direction::kDown) return "link: nothing of the autopilot reaches the stack";
    return "link: nothing passes between stack and autopilot";
  }
  void Impair(Impairments& impairments) const override {
    if (direction_ != Link::Direction::kDown) impairments.commands_lost = true;
  }
  bool Concerns(stack::SensorId id) const override {
    return direction_ != Link::Direction::kUp && Contains(reports_, id);
  }
  bool Take(stack::Measurement&) override { return false; }

 private:
  Link::Direction direction_;
  std::vector<Sensor> reports_;
};

}  // namespace

void Describe(base::Description& d, Link& c) {
  DescribeTiming(d, c);
  d.Field("direction", c.direction,
          {.meaning = "up: stack to autopilot; down: its reports to the stack",
           .required = true,
           .choices = {"up", "down", "both"},
           .origin = &c.origin});
}

std::unique_ptr<Fault> Make(const Link& config, const Scope& scope, std::uint64_t, const std::string&) {
  if (!scope.autopilot || !scope.stack) {
    throw base::InputError(config.origin.where, config.origin.path,
                           "there is no link without a stack and an autopilot");
  }
  return std::make_unique<LostLink>(config.direction, Choose({"status"}, scope));
}

}  // namespace alula::sim::faults
