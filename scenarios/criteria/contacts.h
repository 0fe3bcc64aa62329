#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// Nothing but the legs touches, and they touch the pad only.
struct ContactsConfig {
  bool ends_run = true;
};
void Describe(base::Description& d, ContactsConfig& c);

class Contacts : public Criterion {
 public:
  explicit Contacts(const ContactsConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override { return {AtMost("forbidden_contacts", count_, 0, "1")}; }
  void AddMetrics(Metrics& metrics) const override;

 private:
  ContactsConfig config_;
  int count_ = 0;  // beginnings of forbidden contact
  bool touching_ = false;
  base::Time first_;
};

}  // namespace alula::scenarios
