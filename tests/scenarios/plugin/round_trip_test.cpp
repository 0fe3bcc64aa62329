// Every field of everything that crosses, through the structs of plugin.h and back, to the bit. The lists of fields
// below are structured bindings: a struct with a new field does not compile until the field is named here, and then
// fails until plugin.h, the loader and the exporter carry it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/random.h"
#include "scenarios/plugin/internal/answer.h"
#include "scenarios/plugin/internal/given.h"
#include "stack/interface/plugin_export.h"

namespace alula::scenarios {
namespace {

using namespace stack;  // NOLINT: this file is about its types

constexpr int kRounds = 20;

// The fields of each struct, as many as it has.
#define ALULA_FIELDS(Type, ...)   \
  auto Fields(Type& s) {          \
    auto& [__VA_ARGS__] = s;      \
    return std::tie(__VA_ARGS__); \
  }
ALULA_FIELDS(ImuSample, a, b)
ALULA_FIELDS(Image, a, b, c, d, e, f, g, h)
ALULA_FIELDS(DepthImage, a, b, c, d, e)
ALULA_FIELDS(GimbalAngles, a, b, c)
ALULA_FIELDS(BaroSample, a)
ALULA_FIELDS(MagSample, a)
ALULA_FIELDS(PositionFix, a, b, c)
ALULA_FIELDS(BatterySample, a, b)
ALULA_FIELDS(VehicleStatus, a, b, c, d, e)
ALULA_FIELDS(Measurement, a, b, c, d, e)
ALULA_FIELDS(CameraIntrinsics, a, b, c, d, e, f, g, h)
ALULA_FIELDS(CameraCalibration, a, b, c, d, e, f, g, h, i)
ALULA_FIELDS(GimbalCalibration, a, b, c)
ALULA_FIELDS(ImuNoise, a, b, c, d, e, f, g, h)
ALULA_FIELDS(ImuCalibration, a, b, c, d, e)
ALULA_FIELDS(BarometerCalibration, a, b, c)
ALULA_FIELDS(PositionReferenceCalibration, a, b)
ALULA_FIELDS(MagnetometerCalibration, a, b, c, d, e, f)
ALULA_FIELDS(Calibration, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
ALULA_FIELDS(GateHint, a, b, c)
ALULA_FIELDS(Mission, a, b, c, d, e, f, g, h, i, j, k)
ALULA_FIELDS(PositionSetpoint, a, b, c, d, e)
ALULA_FIELDS(VelocitySetpoint, a, b, c)
ALULA_FIELDS(GimbalSetpoint, a, b, c, d)
ALULA_FIELDS(Command, a, b, c)
ALULA_FIELDS(Estimate, a, b, c, d, e, f, g, h)
ALULA_FIELDS(StackEvent, a, b, c)
ALULA_FIELDS(StageTime, a, b, c, d)
ALULA_FIELDS(StackFile, a, b)
ALULA_FIELDS(base::Time, a)
ALULA_FIELDS(base::Duration, a)
ALULA_FIELDS(base::Rate, a, b)
#undef ALULA_FIELDS
auto Fields(Arm&) { return std::tuple<>(); }
auto Fields(Disarm&) { return std::tuple<>(); }
auto Fields(Hold&) { return std::tuple<>(); }
auto Fields(Land&) { return std::tuple<>(); }
// All but the view, which does not cross.
auto Fields(StackOutput& s) {
  auto& [a, b, c, d, e, view] = s;
  static_cast<void>(view);
  return std::tie(a, b, c, d, e);
}

/// Fills a value with numbers that no other field has.
class Filler {
 public:
  template <typename T>
  void Fill(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = random_.Index(2) == 1;
    } else if constexpr (std::is_same_v<T, PixelFormat>) {
      value = static_cast<PixelFormat>(random_.Index(2));
    } else if constexpr (std::is_same_v<T, DistortionModel>) {
      value = static_cast<DistortionModel>(random_.Index(2));
    } else if constexpr (std::is_same_v<T, CameraKind>) {
      value = static_cast<CameraKind>(random_.Index(4));
    } else if constexpr (std::is_same_v<T, StackState> || std::is_same_v<T, VehicleStatus::Mode>) {
      value = static_cast<T>(random_.Index(5));
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      value = static_cast<T>(random_.Bits() & std::numeric_limits<std::int16_t>::max());
    } else if constexpr (std::is_floating_point_v<T>) {
      value = random_.Gaussian();
    } else {
      std::apply([this](auto&... fields) { (this->Fill(fields), ...); }, Fields(value));
    }
  }
  void Fill(std::string& text) { text = "text " + std::to_string(random_.Bits()); }
  void Fill(base::Quat& q) { q = base::Exp(base::Vec3(random_.Gaussian(), random_.Gaussian(), random_.Gaussian())); }
  void Fill(base::Transform& X) {
    Fill(X.q);
    Fill(X.p);
  }
  void Fill(base::Vec3& m) { FillMatrix(m); }
  void Fill(base::Mat3& m) { FillMatrix(m); }
  void Fill(base::Mat6& m) { FillMatrix(m); }
  template <typename T, std::size_t kSize>
  void Fill(std::array<T, kSize>& values) {
    for (T& value : values) Fill(value);
  }
  template <typename T>
  void Fill(std::vector<T>& values) {
    values.resize(1 + random_.Index(4));
    for (T& value : values) Fill(value);
  }
  template <typename T>
  void Fill(std::shared_ptr<const std::vector<T>>& shared) {
    std::vector<T> values;
    Fill(values);
    shared = std::make_shared<const std::vector<T>>(std::move(values));
  }
  template <typename T>
  void Fill(std::optional<T>& value) {
    value.reset();
    if (random_.Index(2) == 1) Fill(value.emplace());
  }
  /// Keeps the alternative.
  template <typename... Ts>
  void Fill(std::variant<Ts...>& value) {
    std::visit([this](auto& alternative) { this->Fill(alternative); }, value);
  }

 private:
  template <typename Matrix>
  void FillMatrix(Matrix& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = random_.Gaussian();
  }

  base::RandomStream random_{4, "plugin round trip"};
};

/// Whether two values have the same bits in every field.
struct Equality {
  template <typename T>
  bool operator()(const T& a, const T& b) const {
    if constexpr (std::is_enum_v<T> || std::is_arithmetic_v<T>) {
      return a == b;
    } else {
      const auto fields_a = Fields(const_cast<T&>(a)), fields_b = Fields(const_cast<T&>(b));
      return [&]<std::size_t... I>(std::index_sequence<I...>) {
        return ((*this)(std::get<I>(fields_a), std::get<I>(fields_b)) && ...);
      }
      (std::make_index_sequence<std::tuple_size_v<std::decay_t<decltype(fields_a)>>>());
    }
  }
  bool operator()(const std::string& a, const std::string& b) const { return a == b; }
  bool operator()(const base::Vec3& a, const base::Vec3& b) const { return a == b; }
  bool operator()(const base::Mat3& a, const base::Mat3& b) const { return a == b; }
  bool operator()(const base::Mat6& a, const base::Mat6& b) const { return a == b; }
  bool operator()(const base::Quat& a, const base::Quat& b) const { return a.coeffs() == b.coeffs(); }
  bool operator()(const base::Transform& a, const base::Transform& b) const {
    return a.p == b.p && a.q.coeffs() == b.q.coeffs();
  }
  template <typename T, std::size_t kSize>
  bool operator()(const std::array<T, kSize>& a, const std::array<T, kSize>& b) const {
    return a == b;
  }
  template <typename T>
  bool operator()(const std::vector<T>& a, const std::vector<T>& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), *this);
  }
  template <typename T>
  bool operator()(const std::shared_ptr<T>& a, const std::shared_ptr<T>& b) const {
    return (*this)(*a, *b);
  }
  template <typename T>
  bool operator()(const std::optional<T>& a, const std::optional<T>& b) const {
    return a.has_value() == b.has_value() && (!a || (*this)(*a, *b));
  }
  template <typename... Ts>
  bool operator()(const std::variant<Ts...>& a, const std::variant<Ts...>& b) const {
    return a.index() == b.index() &&
           std::visit([&](const auto& in_a) { return (*this)(in_a, std::get<std::decay_t<decltype(in_a)>>(b)); }, a);
  }
};
constexpr Equality Same;

/// One value of every alternative.
template <typename Variant, std::size_t... I>
std::vector<Variant> Alternatives(std::index_sequence<I...>) {
  return {Variant(std::in_place_index<I>)...};
}
template <typename Variant>
std::vector<Variant> Alternatives() {
  return Alternatives<Variant>(std::make_index_sequence<std::variant_size_v<Variant>>());
}

TEST(PluginRoundTrip, EveryKindOfMeasurement) {
  using Data = decltype(Measurement::data);
  static_assert(std::variant_size_v<Data> == 9, "plugin.h has nine kinds of measurements");
  Filler filler;
  std::vector<AlulaMeasurement> written;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Measurement> measurements;
    for (Data& data : Alternatives<Data>()) {
      measurements.emplace_back().data = data;
      filler.Fill(measurements.back());
    }
    plugin::Write(measurements, written);
    ASSERT_EQ(written.size(), measurements.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
      EXPECT_TRUE(Same(measurements[i], stack::plugin::Read(written[i]))) << "kind " << written[i].kind;
    }
  }
}

TEST(PluginRoundTrip, CalibrationAndMission) {
  Filler filler;
  for (int round = 0; round < kRounds; ++round) {
    Calibration calibration;
    Mission mission;
    filler.Fill(calibration);
    filler.Fill(mission);
    const plugin::Given given(calibration, mission);
    EXPECT_TRUE(Same(calibration, stack::plugin::Read(given.calibration())));
    EXPECT_TRUE(Same(mission, stack::plugin::Read(given.mission())));
    EXPECT_STREQ(given.calibration().vehicle.bytes, calibration.vehicle.c_str());  // ends in a zero byte
  }
}

/// Answers what it was given to answer.
class Parrot : public NavigationStack {
 public:
  StackOutput Step(base::Time, std::span<const Measurement>) override { return output; }
  std::vector<StageTime> Timing() const override { return times; }
  std::vector<StackFile> Files() const override { return files; }
  StackOutput output;
  std::vector<StageTime> times;
  std::vector<StackFile> files;
};

TEST(PluginRoundTrip, EveryKindOfAnswer) {
  using What = decltype(Command::what);
  static_assert(std::variant_size_v<What> == 7, "plugin.h has seven kinds of commands");
  Filler filler;
  stack::plugin::Exported exported;
  exported.stack = std::make_unique<Parrot>();
  auto& parrot = static_cast<Parrot&>(*exported.stack);
  for (int round = 0; round < kRounds; ++round) {
    filler.Fill(parrot.output);
    filler.Fill(parrot.times);
    filler.Fill(parrot.files);
    parrot.output.commands.clear();
    for (What& what : Alternatives<What>()) {
      parrot.output.commands.emplace_back().what = what;
      filler.Fill(parrot.output.commands.back());
    }
    AlulaOutput output{};
    stack::plugin::Step(exported, {}, nullptr, 0, output);
    EXPECT_TRUE(Same(parrot.output, plugin::Read(output)));
    AlulaTiming timing{};
    stack::plugin::Timing(exported, timing);
    EXPECT_TRUE(Same(parrot.times, plugin::Read(timing)));
    AlulaFiles files{};
    stack::plugin::Files(exported, files);
    EXPECT_TRUE(Same(parrot.files, plugin::Read(files)));
  }
}

}  // namespace
}  // namespace alula::scenarios
