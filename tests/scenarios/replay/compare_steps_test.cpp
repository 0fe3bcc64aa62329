// Records side by side, without a flight.
#include "scenarios/replay/compare_steps.h"

#include <gtest/gtest.h>

#include "scenarios/replay/first_difference.h"

namespace alula::scenarios::replay {
namespace {

constexpr stack::SensorId kImu{1}, kLeft{100}, kRight{101};

/// The step of 1 ms that begins at `ms`.
KeptStep StepAt(int ms) {
  KeptStep step;
  step.number = ms;
  step.begin = base::Time{} + base::Milliseconds(ms);
  step.end = step.begin + base::Milliseconds(1);
  step.output.emplace();
  return step;
}

stack::Measurement Grey(stack::SensorId sensor, std::vector<std::uint8_t> bytes, int width, int stride) {
  stack::Image image;
  image.width = width;
  image.height = static_cast<int>(bytes.size()) / stride;
  image.stride = stride;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  return {sensor, 3, {}, {}, image};
}

Stretch Of(KeptStep step) {
  Stretch stretch;
  stretch.steps.push_back(std::move(step));
  stretch.sensors = {{kImu, "vehicle0/imu"}, {kLeft, "vehicle0/camera.left"}, {kRight, "vehicle0/camera.right"}};
  return stretch;
}

TEST(CompareSteps, EqualStepsHaveNoDifference) { EXPECT_EQ(CompareSteps(Of(StepAt(4)), Of(StepAt(4))), std::nullopt); }

TEST(CompareSteps, AnImageByItsFirstPixelAndHowManyDiffer) {
  KeptStep a = StepAt(4), b = StepAt(4);
  // Three pixels a row and one byte of padding, which a digest covers too.
  a.measurements = {Grey(kLeft, {1, 2, 3, 0, 4, 5, 6, 0}, 3, 4)};
  b.measurements = {Grey(kLeft, {1, 2, 3, 0, 4, 9, 8, 0}, 3, 4)};
  const std::optional<Difference> d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->stream, "measurements");
  EXPECT_EQ(d->record, "vehicle0/camera.left seq 3");
  EXPECT_EQ(d->field, "pixel (1, 1)");
  EXPECT_EQ(d->a, "5");
  EXPECT_EQ(d->b, "9");
  EXPECT_EQ(d->note, "2 of 8 pixels differ");
  EXPECT_EQ(
      ToText({{}, {}, d}),
      "first difference at 0.004 s (step 4): measurements: vehicle0/camera.left seq 3: pixel (1, 1): 5 in A, 9 in "
      "B; 2 of 8 pixels differ\n");
}

TEST(CompareSteps, AColourImageByPixelsAndADepthImageByMillimetres) {
  KeptStep a = StepAt(0), b = StepAt(0);
  for (KeptStep* step : {&a, &b}) {
    step->measurements = {Grey(kLeft, {1, 2, 3, 4, 5, std::uint8_t(step == &a ? 6 : 7)}, 2, 6)};
    std::get<stack::Image>(step->measurements[0].data).format = stack::PixelFormat::kRgb8;
  }
  std::optional<Difference> d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->field, "pixel (1, 0)");
  EXPECT_EQ(d->a, "(4, 5, 6)");
  EXPECT_EQ(d->note, "1 of 2 pixels differ");
  for (KeptStep* step : {&a, &b}) {
    stack::DepthImage depth{2, 1, {}, {}, nullptr};
    const std::vector<std::uint16_t> millimetres{1500, static_cast<std::uint16_t>(step == &a ? 0 : 2500)};
    depth.millimetres = std::make_shared<const std::vector<std::uint16_t>>(millimetres);
    step->measurements[0].data = depth;
  }
  d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->field, "pixel (1, 0)");
  EXPECT_EQ(d->a, "0");
  EXPECT_EQ(d->b, "2500");
}

TEST(CompareSteps, WithinAStepMeasurementsComeBeforeAnswersAndTheTruthLast) {
  KeptStep a = StepAt(7), b = StepAt(7);
  b.truth.v_WB.y() = 0.1;
  std::optional<Difference> d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->stream, "truth");
  EXPECT_EQ(d->field, "v_WB.y");
  EXPECT_EQ(d->time, base::Time{} + base::Milliseconds(8));  // the truth is that of the step's end
  b.output->events.push_back({b.begin, "gate", "passed"});
  d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->stream, "events");
  EXPECT_EQ(d->a, std::nullopt);
  EXPECT_EQ(ToText({{}, {}, d}),
            "first difference at 0.007 s (step 7): events: gate: only in B (time 0.007 s, kind \"gate\", text "
            "\"passed\")\n");
  a.output->commands = {{stack::Hold{}, {}, {}}};
  b.output->commands = {{stack::Land{}, {}, {}}};
  d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->record, "hold");
  EXPECT_TRUE(d->a);
  EXPECT_FALSE(d->b);
  a.measurements = {{kImu, 5, {}, {}, stack::ImuSample{{0.5, 0, 0}, {0, 0, 0}}}};
  b.measurements = {{kImu, 5, {}, {}, stack::ImuSample{{0.25, 0, 0}, {0, 0, 0}}}};
  d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->record, "vehicle0/imu seq 5");
  EXPECT_EQ(d->field, "angular_velocity.x");
  EXPECT_EQ(d->b, "0.25");
}

TEST(CompareSteps, ValuesThatADigestTakesForOneAreOne) {
  KeptStep a = StepAt(0), b = StepAt(0);
  a.truth.v_WB.x() = 0.0;
  b.truth.v_WB.x() = -0.0;
  EXPECT_EQ(CompareSteps(Of(a), Of(b)), std::nullopt);
  b.truth.v_WB.x() = 0.1 + 0.2;
  a.truth.v_WB.x() = 0.3;
  const std::optional<Difference> d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->a, "0.3");
  EXPECT_EQ(d->b, "0.30000000000000004");
}

TEST(CompareSteps, SensorsArePairedByNameAndTheirNumbersCountLast) {
  KeptStep a = StepAt(0), b = StepAt(0);
  const stack::ImuSample sample{{0, 0, 0}, {0, 0, base::kGravity}};
  a.measurements = {{kImu, 1, {}, {}, sample}, {kLeft, 1, {}, {}, stack::BaroSample{1013.0}}};
  b.measurements = {{kLeft, 1, {}, {}, stack::BaroSample{1013.0}}, {kImu, 1, {}, {}, sample}};
  std::optional<Difference> d = CompareSteps(Of(a), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->field, "order");
  Stretch renumbered = Of(a);
  renumbered.steps[0].measurements[0].sensor = kRight;
  renumbered.sensors = {{kRight, "vehicle0/imu"}, {kLeft, "vehicle0/camera.left"}};
  d = CompareSteps(Of(a), renumbered);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->field, "sensor");
  EXPECT_EQ(d->b, "101");
  renumbered.steps[0].truth.w_B.z() = 1.0;  // something that was done counts before how sensors are numbered
  d = CompareSteps(Of(a), renumbered);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->stream, "truth");
}

TEST(CompareSteps, ARunThatEndsEarlierSaysWhy) {
  Stretch a = Of(StepAt(4)), b = a;
  b.steps.push_back(StepAt(5));
  a.end = "landed";
  b.end = "time_limit";
  const std::optional<Difference> d = CompareSteps(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(ToText({{}, {}, d}), "first difference at 0.005 s (step 5): run: end: landed in A, goes on in B\n");
}

TEST(CompareSteps, StepsOfAnotherLength) {
  KeptStep b = StepAt(4);
  b.end = b.begin + base::Milliseconds(2);
  const std::optional<Difference> d = CompareSteps(Of(StepAt(4)), Of(b));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->field, "step's end");
  EXPECT_EQ(d->a, "0.005 s");
}

}  // namespace
}  // namespace alula::scenarios::replay
