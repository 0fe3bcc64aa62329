#include "scenarios/dataset/dataset_recorder.h"

#include <fmt/format.h>

#include <utility>

#include "base/error.h"
#include "sim/run_folder.h"

namespace alula::scenarios::dataset {
namespace fs = std::filesystem;
namespace {

constexpr base::Rate kTruthRate{200, 1};  // where no IMU says

class DatasetRecorder final : public Spectator {
 public:
  /// `own`: null where the files go into a folder that others put in place.
  DatasetRecorder(std::unique_ptr<DatasetWriter> writer, std::unique_ptr<sim::RunFolder> own, base::Rate truth_rate,
                  std::shared_ptr<DatasetSize> size)
      : writer_(std::move(writer)), own_(std::move(own)), truth_rate_(truth_rate), size_(std::move(size)) {}

  std::optional<std::string> Observe(const sim::StepView& step) override {
    for (const stack::Measurement& m : step.measurements) {
      writer_->Add(m);
      size_->images += std::holds_alternative<stack::Image>(m.data);
      size_->depth_images += std::holds_alternative<stack::DepthImage>(m.data);
      size_->imu_samples += std::holds_alternative<stack::ImuSample>(m.data);
    }
    for (; truth_rate_.SampleTime(truths_) <= step.time; ++truths_) {
      const base::Time time = truth_rate_.SampleTime(truths_);
      const vehicles::BodyState state = step.truth.At(time);
      writer_->Add(BodyTruth{time, state.X_WB, state.v_WB, state.w_B, step.imu_bias.gyro, step.imu_bias.accelerometer});
    }
    size_->span = step.time - base::Time{};
    return std::nullopt;
  }

  void Finish() override {
    writer_->Finish();
    // Whatever an earlier dataset of either format left there goes.
    if (own_) {
      own_->Commit({"mav0", "rgb", "depth", "rgb.txt", "depth.txt", "rgb.yaml", "depth.yaml", "accelerometer.txt",
                    "groundtruth.txt"});
    }
  }

 private:
  std::unique_ptr<DatasetWriter> writer_;
  std::unique_ptr<sim::RunFolder> own_;
  base::Rate truth_rate_;
  std::int64_t truths_ = 0;
  std::shared_ptr<DatasetSize> size_;
};

}  // namespace

SpectatorMaker RecordDataset(DatasetRequest request, std::shared_ptr<DatasetSize> size) {
  return [request = std::move(request), size = std::move(size)](const Stage& stage) -> std::unique_ptr<Spectator> {
    std::unique_ptr<sim::RunFolder> own;
    if (request.folder) own = std::make_unique<sim::RunFolder>(*request.folder);
    const fs::path folder = own ? own->PathOf("") : stage.folder / "dataset";
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw base::FaultError("disk", "cannot make " + folder.string() + ": " + error.message());
    const std::string comment =
        fmt::format("Alula: {} of scenario {}, seed {}", stage.calibration.vehicle, request.scenario, request.seed);
    const auto make = request.format == Format::kEuroc ? MakeEurocWriter : MakeTumWriter;
    const base::Rate rate = stage.calibration.imu ? stage.calibration.imu->rate : kTruthRate;
    return std::make_unique<DatasetRecorder>(make(folder, stage.calibration, comment), std::move(own), rate, size);
  };
}

}  // namespace alula::scenarios::dataset
