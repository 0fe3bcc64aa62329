#include "sim/sensors/auto_exposure.h"

#include <algorithm>
#include <cmath>

namespace alula::sim {

ExposureControl::ExposureControl(const CameraConfig& config)
    : config_(config.auto_exposure), nominal_(config.exposure), current_{config.exposure, 1.0} {
  if (config_) current_ = SettingOf(0.0);
}

ExposureSetting ExposureControl::SettingOf(double stops) const {
  const double wanted = std::exp2(stops) * nominal_.Seconds();
  const double length = std::clamp(wanted, config_->shortest.Seconds(), config_->longest.Seconds());
  return {base::Seconds(length), std::clamp(wanted / length, 1.0, config_->largest_gain)};
}

void ExposureControl::See(double mean, const ExposureSetting& setting) {
  if (!config_) return;
  constexpr double kDarkest = 0.004;  // share of full scale: below one grey level a mean says only "dark"
  const double error = std::log2(config_->target / std::max(mean, kDarkest));
  const double low = std::log2(config_->shortest.Seconds() / nominal_.Seconds());
  const double high = std::log2(config_->longest.Seconds() * config_->largest_gain / nominal_.Seconds());
  // The error counts from what the frame itself was taken with: then no delay can make the loop swing.
  const double taken = std::log2(setting.length.Seconds() * setting.gain / nominal_.Seconds());
  underway_.push_back(std::clamp(taken + config_->speed * error, low, high));
  if (static_cast<int>(underway_.size()) < config_->delay) return;
  current_ = SettingOf(underway_.front());
  underway_.pop_front();
}

}  // namespace alula::sim
