#include "sim/faults/computer.h"

#include <fmt/format.h>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

class SlowComputer : public Fault {
 public:
  explicit SlowComputer(double factor) : factor_(factor) {}
  std::string Words() const override { return fmt::format("the stack's computer takes {:.4g} times as long", factor_); }
  void Impair(Impairments& impairments) const override { impairments.computer *= factor_; }

 private:
  double factor_;
};

}  // namespace

void Describe(base::Description& d, Computer& c) {
  DescribeTiming(d, c);
  d.Field("factor", c.factor,
          {.meaning = "on every latency that the stack declares",
           .min = 1,
           .max = 1000,
           .required = true,
           .origin = &c.origin});
}

std::unique_ptr<Fault> Make(const Computer& config, const Scope& scope, std::uint64_t, const std::string&) {
  if (!scope.stack) throw base::InputError(config.origin.where, config.origin.path, "no stack runs on a computer here");
  return std::make_unique<SlowComputer>(config.factor);
}

}  // namespace alula::sim::faults
