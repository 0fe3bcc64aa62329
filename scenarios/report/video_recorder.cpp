#include "scenarios/report/video_recorder.h"

#include <variant>

namespace alula::scenarios {

namespace {

constexpr base::Rate kPictureRate{30, 1};
constexpr std::size_t kImagesKept = 8;  // the stack shows features of an image some 50 ms old

std::vector<render::Mover> Movers(const vehicles::VehicleBody& body) {
  std::vector<render::Mover> movers;
  for (const vehicles::Part& part : body.parts) movers.push_back({part.name, part.shape, part.material});
  return movers;
}

std::vector<base::Transform> Places(const vehicles::VehicleBody& body) {
  std::vector<base::Transform> X_BP;
  for (const vehicles::Part& part : body.parts) X_BP.push_back(part.X_BP);
  return X_BP;
}

}  // namespace

VideoRecorder::VideoRecorder(const std::filesystem::path& file, std::string_view maker, const worlds::World& world,
                             const vehicles::VehicleBody& body, std::optional<stack::SensorId> left_camera,
                             std::string title)
    : left_camera_(left_camera),
      composer_(maker, world, Movers(body), Places(body), std::move(title)),
      writer_(file, VideoComposer::kWidth, VideoComposer::kHeight, static_cast<int>(kPictureRate.cycles)) {
  moment_.gate_count = static_cast<int>(world.gates.size());
}

void VideoRecorder::Remember(const sim::StepView& step) {
  if (left_camera_) {
    for (const stack::Measurement& m : step.measurements) {
      if (m.sensor != *left_camera_) continue;
      if (const auto* image = std::get_if<stack::Image>(&m.data)) left_images_.emplace_back(m.seq, *image);
    }
    if (left_images_.size() > kImagesKept) left_images_.pop_front();
    if (!left_images_.empty()) moment_.left = ImageOf(moment_.view.get());
  }
  if (step.output == nullptr) return;
  if (step.output->estimate) moment_.X_MB = step.output->estimate->X_MO * step.output->estimate->X_OB;
  if (step.output->view) moment_.view = step.output->view;
  if (!step.output->events.empty()) moment_.caption = step.output->events.back().text;
  moment_.next_gate = step.output->next_gate;
}

const stack::Image& VideoRecorder::ImageOf(const stack::StackView* view) const {
  if (view != nullptr) {
    for (const auto& [seq, image] : left_images_) {
      if (seq == view->image_seq) return image;
    }
  }
  return left_images_.back().second;
}

std::optional<std::string> VideoRecorder::Observe(const sim::StepView& step) {
  Remember(step);
  if (step.time < kPictureRate.SampleTime(pictures_)) return std::nullopt;
  moment_.time = step.time;
  moment_.X_WB = step.truth.at_end.X_WB;
  moment_.X_WL = step.actors.LinkPoses(step.time);
  moment_.v_WB = step.truth.at_end.v_WB;
  const base::Duration dt = kPictureRate.SampleTime(pictures_ + 1) - kPictureRate.SampleTime(pictures_);
  writer_.Add(composer_.Compose(moment_, dt).rgb);
  ++pictures_;
  return std::nullopt;
}

SpectatorMaker FilmTheRun(std::string title) {
  return [title = std::move(title)](const Stage& stage) -> std::unique_ptr<Spectator> {
    std::optional<stack::SensorId> left;
    if (stage.calibration.stereo) {
      left = stage.calibration.cameras.at(static_cast<std::size_t>((*stage.calibration.stereo)[0])).sensor;
    }
    return std::make_unique<VideoRecorder>(stage.folder / "video.mp4", stage.render, stage.world, stage.body, left,
                                           title);
  };
}

}  // namespace alula::scenarios
