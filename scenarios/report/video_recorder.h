#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "scenarios/report/mp4_writer.h"
#include "scenarios/report/video_frame.h"
#include "scenarios/runner.h"
#include "vehicles/vehicle.h"
#include "worlds/world.h"

namespace alula::scenarios {

/// Films a run: looks at every step and composes thirty pictures a second of simulated time. It never ends a run and
/// nothing reads it, so a digest does not depend on it.
class VideoRecorder : public Spectator {
 public:
  /// `left_camera`: the sensor whose pictures are shown; none where the vehicle has no camera.
  /// Throws base::InputError where ffmpeg or the maker is missing.
  VideoRecorder(const std::filesystem::path& file, std::string_view maker, const worlds::World& world,
                const vehicles::VehicleBody& body, std::optional<stack::SensorId> left_camera, std::string title);

  std::optional<std::string> Observe(const sim::StepView& step) override;
  /// Puts the finished file in place.
  void Finish() override { writer_.Finish(); }

 private:
  void Remember(const sim::StepView& step);
  /// The image whose features the stack shows, or the newest one.
  const stack::Image& ImageOf(const stack::StackView* view) const;

  std::optional<stack::SensorId> left_camera_;
  std::deque<std::pair<std::uint32_t, stack::Image>> left_images_;
  VideoComposer composer_;
  Mp4Writer writer_;
  VideoMoment moment_;
  std::int64_t pictures_ = 0;
};

/// Films the run into video.mp4 of its folder.
SpectatorMaker FilmTheRun(std::string title);

}  // namespace alula::scenarios
