#include "sim/faults/motor.h"

#include <fmt/format.h>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

class FailingMotor : public Fault {
 public:
  FailingMotor(int motor, double thrust) : motor_(static_cast<std::size_t>(motor)), thrust_(thrust) {}
  std::string Words() const override {
    return thrust_ > 0.0 ? fmt::format("motor {} gives {:.4g} of its thrust", motor_, thrust_)
                         : fmt::format("motor {} stops", motor_);
  }
  void Impair(Impairments& impairments) const override {
    std::vector<double>& thrust = impairments.vehicle.motor_thrust;
    if (thrust.size() <= motor_) thrust.resize(motor_ + 1, 1.0);
    thrust[motor_] *= thrust_;
  }

 private:
  std::size_t motor_;
  double thrust_;
};

}  // namespace

void Describe(base::Description& d, Motor& c) {
  DescribeTiming(d, c);
  d.Field("motor", c.motor, {.meaning = "its number, from 0", .min = 0, .required = true, .origin = &c.origin});
  d.Field("thrust", c.thrust, {.meaning = "share of its thrust that is left; 0: it stops", .min = 0, .max = 1});
}

std::unique_ptr<Fault> Make(const Motor& config, const Scope& scope, std::uint64_t, const std::string&) {
  if (config.motor >= scope.motors) {
    throw base::InputError(config.origin.where, config.origin.path,
                           scope.motors == 0 ? "this vehicle has no motors that could fail"
                                             : fmt::format("there is no motor {}; this vehicle has the motors 0 to {}",
                                                           config.motor, scope.motors - 1));
  }
  return std::make_unique<FailingMotor>(config.motor, config.thrust);
}

}  // namespace alula::sim::faults
