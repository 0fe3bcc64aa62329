#include "sim/sensors/gnss.h"

#include <algorithm>
#include <cmath>

namespace alula::sim {

void Describe(base::Description& d, Outage& c) {
  d.Field("from", c.from, {.unit = "s", .meaning = "first instant without a fix", .min = 0});
  d.Field("until", c.until, {.unit = "s", .meaning = "first instant with one again", .min = 0});
  d.Check("until", [&c] { return c.from < c.until ? "" : "an outage ends after it begins"; });
}

void Describe(base::Description& d, GnssConfig& c) {
  d.Field("horizontal", c.horizontal,
          {.unit = "m", .meaning = "standard deviation of the wandering error, x and y each", .min = 0});
  d.Field("vertical", c.vertical, {.unit = "m", .meaning = "standard deviation of the wandering error, z", .min = 0});
  d.Field("correlation_time", c.correlation_time, {.unit = "s", .meaning = "of the wandering error", .min = 0.01});
  d.Field("outage_rate", c.outage_rate, {.unit = "Hz", .meaning = "outages that begin by chance", .min = 0});
  d.Field("outage_length", c.outage_length, {.unit = "s", .meaning = "their mean length", .min = 0.01});
  d.Field("outages", c.outages, {.meaning = "windows without fixes"});
}

GnssErrors::GnssErrors(const GnssConfig& config, double period, std::uint64_t seed, const std::string& name)
    : config_(config),
      period_(period),
      decay_(std::exp(-period / config.correlation_time)),
      stream_(seed, name + ".gnss"),
      outage_stream_(seed, name + ".outages"),
      sigma_(config.horizontal, config.horizontal, config.vertical),
      error_(sigma_.cwiseProduct(stream_.GaussianVec3())) {}

std::optional<base::Vec3> GnssErrors::Next(base::Time t) {
  const base::Vec3 error = error_;
  error_ = decay_ * error_ + std::sqrt(1.0 - decay_ * decay_) * sigma_.cwiseProduct(stream_.GaussianVec3());
  const double begins = outage_stream_.Uniform(), lasts = outage_stream_.Uniform();  // as many numbers whatever happens
  if (lost_for_ <= 0.0 && begins < -std::expm1(-config_.outage_rate * period_)) {
    lost_for_ = -config_.outage_length * std::log1p(-lasts);
  }
  const bool by_chance = lost_for_ > 0.0;
  lost_for_ -= period_;
  const base::Duration since = t - base::Time{};
  const bool planned = std::any_of(config_.outages.begin(), config_.outages.end(),
                                   [since](const Outage& o) { return o.from <= since && since < o.until; });
  if (by_chance || planned) return std::nullopt;
  return error;
}

}  // namespace alula::sim
