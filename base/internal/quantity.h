#pragma once

#include <string>
#include <string_view>

#include "base/describe.h"
#include "base/time.h"

/// Numbers with units as they stand in YAML. Errors are thrown as plain InputError whose text starts at "what was
/// wrong"; the reader adds file, line, column and key.
namespace alula::base::quantity {

/// "0.75 kg" in SI, checked against the dimension of `unit` (as FieldInfo::unit). Infinity only where allowed.
double ParseNumber(std::string_view text, std::string_view unit, bool may_be_infinite);
/// "8 ms", "2 h", to the nearest nanosecond; at most 100 days.
Duration ParseDuration(std::string_view text);
/// "200 Hz", "1/3 Hz", "29.97 Hz", "30000/1001 Hz": exact and in lowest terms, above zero.
Rate ParseRate(std::string_view text);
/// An integer; with a unit where `unit` has a dimension.
std::int64_t ParseInteger(std::string_view text, std::string_view unit);
std::uint64_t ParseUnsigned(std::string_view text, std::string_view unit);

/// Throws when `value` lies outside info.min … info.max; `text`, what the user wrote, and `unit` are for the message.
void CheckRange(double value, const FieldInfo& info, std::string_view unit, std::string_view text);

/// Shortest digits that read back to the same bits.
std::string Digits(double value);
/// The value with its unit, as ParseNumber reads it.
std::string Format(double value, std::string_view unit);
std::string Format(Duration value);
std::string Format(Rate value);

}  // namespace alula::base::quantity
