#include "sim/faults/offsets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

using Names = std::vector<std::string>;

/// The quantities of a kind of sample. One without any (an autopilot's report) cannot be shifted.
struct QuantitiesOf {
  Names operator()(const stack::ImuSample&) const { return {"angular_velocity", "specific_force"}; }
  Names operator()(const stack::BaroSample&) const { return {"pressure"}; }
  Names operator()(const stack::MagSample&) const { return {"magnetic_field"}; }
  Names operator()(const stack::PositionFix&) const { return {"position", "attitude"}; }
  Names operator()(const stack::BatterySample&) const { return {"voltage", "current"}; }
  Names operator()(const stack::Image&) const { return {"brightness"}; }
  Names operator()(const stack::DepthImage&) const { return {"depth"}; }
  Names operator()(const stack::GimbalAngles&) const { return {"angles"}; }
  template <typename Other>
  Names operator()(const Other&) const {
    return {};
  }
};

struct AddTo {
  const Offsets& offsets;
  double k;

  void operator()(stack::ImuSample& s) const {
    s.angular_velocity += k * offsets.angular_velocity;
    s.specific_force += k * offsets.specific_force;
  }
  void operator()(stack::BaroSample& s) const { s.pressure += k * offsets.pressure; }
  void operator()(stack::MagSample& s) const { s.magnetic_field += k * offsets.magnetic_field; }
  void operator()(stack::PositionFix& s) const {
    s.X_WB.p += k * offsets.position;
    if (!offsets.attitude.isZero(0.0)) s.X_WB.q = (s.X_WB.q * base::Exp(k * offsets.attitude)).normalized();
  }
  void operator()(stack::BatterySample& s) const {
    s.voltage += k * offsets.voltage;
    s.current += k * offsets.current;
  }
  void operator()(stack::Image& s) const {
    auto bytes = std::make_shared<std::vector<std::uint8_t>>(*s.bytes);
    const auto more = static_cast<int>(std::lround(k * offsets.brightness));
    for (std::uint8_t& byte : *bytes) byte = static_cast<std::uint8_t>(std::clamp(byte + more, 0, 255));
    s.bytes = std::move(bytes);
  }
  void operator()(stack::DepthImage& s) const {
    auto millimetres = std::make_shared<std::vector<std::uint16_t>>(*s.millimetres);
    const auto more = static_cast<int>(std::lround(1e3 * k * offsets.depth));
    for (std::uint16_t& mm : *millimetres) {
      if (mm != 0) mm = static_cast<std::uint16_t>(std::clamp(mm + more, 1, 65535));
    }
    s.millimetres = std::move(millimetres);
  }
  void operator()(stack::GimbalAngles& s) const {
    s.roll += k * offsets.angles.x();
    s.pitch += k * offsets.angles.y();
    s.yaw += k * offsets.angles.z();
  }
  template <typename Other>
  void operator()(Other&) const {}
};

bool Has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string Joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

struct Quantity {
  std::string_view name, unit, meaning;
  double most;  // either way
};

/// f(quantity, value) for each member.
template <typename OffsetsOrConst, typename Function>
void ForEach(OffsetsOrConst& c, const Function& f) {
  f({"angular_velocity", "rad/s", "of an IMU, its axes", 1e3}, c.angular_velocity);
  f({"specific_force", "m/s^2", "of an IMU, its axes", 1e4}, c.specific_force);
  f({"pressure", "Pa", "of a barometer", 5e4}, c.pressure);
  f({"magnetic_field", "T", "of a magnetometer, its axes", 1.0}, c.magnetic_field);
  f({"position", "m", "of a position reference or satellites, world axes", 1e5}, c.position);
  f({"attitude", "rad", "of a position reference: rotation vector, body axes", 6.3}, c.attitude);
  f({"voltage", "V", "of the battery's gauge", 1e3}, c.voltage);
  f({"current", "A", "of the battery's gauge", 1e3}, c.current);
  f({"brightness", "1", "of every pixel of an image, grey levels", 255}, c.brightness);
  f({"depth", "m", "of every pixel of a depth image", 65}, c.depth);
  f({"angles", "rad", "of a gimbal's encoders: roll, pitch, yaw", 6.3}, c.angles);
}

bool IsZero(double value) { return value == 0.0; }
bool IsZero(const base::Vec3& value) { return value.isZero(0.0); }
std::string Text(double value) { return fmt::format("{:.6g}", value); }
std::string Text(const base::Vec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z()); }

}  // namespace

void DescribeOffsets(base::Description& d, Offsets& c) {
  ForEach(c, [&d](const Quantity& quantity, auto& value) {
    d.Field(quantity.name, value,
            {.unit = quantity.unit, .meaning = quantity.meaning, .min = -quantity.most, .max = quantity.most});
  });
}

Names Given(const Offsets& offsets) {
  Names names;
  ForEach(offsets, [&names](const Quantity& quantity, const auto& value) {
    if (!IsZero(value)) names.emplace_back(quantity.name);
  });
  return names;
}

std::string Listed(const Offsets& offsets) {
  Names texts;
  ForEach(offsets, [&texts](const Quantity& quantity, const auto& value) {
    if (IsZero(value)) return;
    const std::string unit = quantity.unit == "1" ? "" : " " + std::string(quantity.unit);
    texts.push_back(fmt::format("{} {}{}", quantity.name, Text(value), unit));
  });
  return Joined(texts);
}

void CheckOffsets(const Offsets& offsets, const std::vector<Sensor>& sensors, const base::Origin& origin) {
  const Names given = Given(offsets);
  const auto fail = [&origin](const std::string& what) { throw base::InputError(origin.where, origin.path, what); };
  Names known;
  for (const Sensor& sensor : sensors) {
    const Names own = std::visit(QuantitiesOf(), sensor.sample);
    if (own.empty()) fail("`" + sensor.name + "` measures nothing that could be shifted; name another sensor");
    if (std::none_of(own.begin(), own.end(), [&given](const std::string& name) { return Has(given, name); })) {
      fail("nothing is added to `" + sensor.name + "`; give " + Joined(own));
    }
    known.insert(known.end(), own.begin(), own.end());
  }
  for (const std::string& name : given) {
    if (!Has(known, name)) fail("`" + name + "` is nothing that " + NamesOf(sensors) + " measures; drop it");
  }
}

void Add(const Offsets& offsets, double k, decltype(stack::Measurement::data)& sample) {
  std::visit(AddTo{offsets, k}, sample);
}

}  // namespace alula::sim::faults
