#include "sim/faults/sensor_choice.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"

namespace alula::sim::faults {

void DescribeSensors(base::Description& d, SensorChoice& c) {
  d.Field("sensor", c.pattern,
          {.meaning = "name, or pattern with *: imu, camera.left, camera.*, autopilot.imu, …",
           .required = true,
           .origin = &c.origin});
}

bool Matches(std::string_view pattern, std::string_view text) {
  // Greedy with one place to come back to: linear in practice, never worse than the product of the lengths.
  std::size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::vector<Sensor> Choose(const SensorChoice& choice, const Scope& scope) {
  std::vector<Sensor> chosen;
  std::vector<std::string> names;
  for (const Sensor& sensor : scope.sensors) {
    names.push_back(sensor.name);
    if (Matches(choice.pattern, sensor.name)) chosen.push_back(sensor);
  }
  if (!chosen.empty()) return chosen;
  throw base::InputError(choice.origin.where, choice.origin.path,
                         "no sensor of this scenario is called `" + choice.pattern + "`; " +
                             base::Suggestion(choice.pattern, names, "sensors"));
}

bool Contains(const std::vector<Sensor>& sensors, stack::SensorId id) {
  return std::any_of(sensors.begin(), sensors.end(), [id](const Sensor& sensor) { return sensor.id == id; });
}

std::string NamesOf(const std::vector<Sensor>& sensors) {
  std::string names;
  for (const Sensor& sensor : sensors) names += (names.empty() ? "" : ", ") + sensor.name;
  return names;
}

}  // namespace alula::sim::faults
