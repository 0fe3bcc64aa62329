#include "scenarios/criteria/contacts.h"

#include <algorithm>

namespace alula::scenarios {

void Describe(base::Description& d, ContactsConfig& c) {
  d.Field("ends_run", c.ends_run, {.meaning = "whether the first forbidden contact ends the run"});
}

std::optional<std::string> Contacts::Observe(const sim::StepView& step) {
  const bool now = std::any_of(step.contacts.begin(), step.contacts.end(), [&](const sim::Contact& contact) {
    return !(contact.may_touch && contact.object == step.world.pad_object);
  });
  if (now && !touching_ && count_++ == 0) first_ = step.time;
  touching_ = now;
  if (now && config_.ends_run) return "contact";
  return std::nullopt;
}

void Contacts::AddMetrics(Metrics& metrics) const {
  if (count_ > 0) metrics["first_contact_s"] = first_.Seconds();
}

}  // namespace alula::scenarios
