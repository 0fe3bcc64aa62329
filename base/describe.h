#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "base/time.h"

namespace alula::base {

class Description;

/// Where a value stood in a file and the way to it ("world.objects.2.shape.file"), for errors that are found after
/// reading: `throw InputError(origin.where, origin.path, "…")`. Empty where the value is a default.
struct Origin {
  SourcePosition where;
  std::string path;
};

/// What a field is: unit in SI terms ("kg", "m/s", "rad", "rad/s/sqrt(Hz)", "1" for pure numbers), range, meaning.
/// YAML may write any unit of the same dimension ("70 deg", "5 inch", "250 mm"); the value in memory is SI.
struct FieldInfo {
  std::string_view unit = "1";
  std::string_view meaning = {};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool required = false;                    // no default: the file must give it
  std::vector<std::string_view> choices{};  // for strings and enums: the words allowed, in the order of the enum
  bool is_path = false;      // a file name: a relative one starts at the folder of the YAML file that states it
  Origin* origin = nullptr;  // the reader notes here where it found the value
};

/// A config struct has one function, found by argument-dependent lookup:
///
///   void Describe(base::Description& d, RotorConfig& c) {
///     d.Field("radius", c.radius, {.unit = "m", .meaning = "propeller radius", .min = 0.01, .max = 2});
///   }
///
/// The names `extends`, `type`, `uniform`, `normal` and `choice` are taken by the reader (config.h).
/// It drives reading, overriding, checking, the JSON Schema, the documentation and the resolved dump (config.h).
template <typename T>
concept Describable = requires(Description& d, T& t) {
  Describe(d, t);
};

/// The fields of one struct, bound to the members of one instance.
class Description {
 public:
  struct Bound {
    std::string name;
    FieldInfo info;
    using Scalar = std::variant<double*, int*, std::int64_t*, std::uint64_t*, bool*, std::string*, Vec3*, Duration*,
                                Rate*, std::vector<double>*, std::vector<std::string>*, std::vector<Vec3>*>;
    struct Enum {
      std::function<int()> get;
      std::function<void(int)> set;
    };
    struct Struct {
      std::function<void(Description&)> describe;
    };
    struct List {
      std::function<std::size_t()> size;
      std::function<void(std::size_t)> resize;
      std::function<void(std::size_t, Description&)> describe;
    };
    struct Optional {  // a struct that may be absent
      std::function<bool()> present;
      std::function<void(bool)> emplace;
      std::function<void(Description&)> describe;
    };
    struct OneOf {  // a struct whose `type` key names which; choices in info.choices
      std::function<std::size_t()> index;
      std::function<void(std::size_t)> emplace;
      std::function<void(Description&)> describe;
      std::size_t alternatives = 0;
    };
    struct ListOfOneOf {
      std::function<std::size_t()> size;
      std::function<void(std::size_t)> resize;
      std::function<std::size_t(std::size_t)> index;
      std::function<void(std::size_t, std::size_t)> emplace;  // (element, alternative)
      std::function<void(std::size_t, Description&)> describe;
      std::size_t alternatives = 0;
    };
    std::variant<Scalar, Enum, Struct, List, Optional, OneOf, ListOfOneOf> value;
  };

  /// Scalars, vectors of numbers and words, enums (with `choices`), described structs, and vectors and optionals of
  /// them.
  template <typename T>
  void Field(std::string_view name, T& value, FieldInfo info = {});

  /// A variant of described structs; `info.choices` names the alternatives in order; the YAML key `type` selects.
  template <typename... Ts>
  void OneOf(std::string_view name, std::variant<Ts...>& value, FieldInfo info);

  /// A list of such variants.
  template <typename... Ts>
  void ListOf(std::string_view name, std::vector<std::variant<Ts...>>& value, FieldInfo info);

  /// A check over several fields, run after reading; returns an empty string or what is wrong with which key.
  void Check(std::string_view key, std::function<std::string()> check) {
    checks_.emplace_back(std::string(key), std::move(check));
  }

  const std::vector<Bound>& fields() const { return fields_; }
  const std::vector<std::pair<std::string, std::function<std::string()>>>& checks() const { return checks_; }

 private:
  std::vector<Bound> fields_;
  std::vector<std::pair<std::string, std::function<std::string()>>> checks_;
};

namespace describe_internal {

template <typename T>
struct IsVector : std::false_type {};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type {};
template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// A struct describes itself; any other element is one field without a name, of the same unit and range.
template <typename T>
void DescribeElement(Description& d, T& element, const FieldInfo& info) {
  if constexpr (Describable<T>) {
    Describe(d, element);
  } else {
    FieldInfo own = info;
    own.required = false;
    d.Field("", element, std::move(own));
  }
}

template <typename... Ts, std::size_t... I>
void EmplaceByIndex(std::variant<Ts...>& v, std::size_t index, std::index_sequence<I...>) {
  ((index == I ? void(v.template emplace<I>()) : void()), ...);
}

template <typename... Ts>
void DescribeActive(Description& d, std::variant<Ts...>& v) {
  std::visit([&d](auto& alternative) { Describe(d, alternative); }, v);
}

}  // namespace describe_internal

template <typename T>
void Description::Field(std::string_view name, T& value, FieldInfo info) {
  Bound bound{std::string(name), std::move(info), Bound::Scalar{}};
  if constexpr (std::is_constructible_v<Bound::Scalar, T*>) {
    bound.value = Bound::Scalar{&value};
  } else if constexpr (std::is_enum_v<T>) {
    bound.value =
        Bound::Enum{[&value] { return static_cast<int>(value); }, [&value](int i) { value = static_cast<T>(i); }};
  } else if constexpr (describe_internal::IsVector<T>::value) {
    bound.value = Bound::List{[&value] { return value.size(); }, [&value](std::size_t n) { value.resize(n); },
                              [&value, own = bound.info](std::size_t i, Description& d) {
                                describe_internal::DescribeElement(d, value[i], own);
                              }};
  } else if constexpr (describe_internal::IsOptional<T>::value) {
    bound.value = Bound::Optional{
        [&value] { return value.has_value(); }, [&value](bool on) { on ? void(value.emplace()) : value.reset(); },
        [&value, own = bound.info](Description& d) { describe_internal::DescribeElement(d, *value, own); }};
  } else {
    static_assert(Describable<T>, "a field is a scalar, an enum, or a struct with Describe(Description&, T&)");
    bound.value = Bound::Struct{[&value](Description& d) { Describe(d, value); }};
  }
  fields_.push_back(std::move(bound));
}

template <typename... Ts>
void Description::OneOf(std::string_view name, std::variant<Ts...>& value, FieldInfo info) {
  fields_.push_back(
      {std::string(name), std::move(info),
       Bound::OneOf{
           [&value] { return value.index(); },
           [&value](std::size_t i) { describe_internal::EmplaceByIndex(value, i, std::index_sequence_for<Ts...>{}); },
           [&value](Description& d) { describe_internal::DescribeActive(d, value); }, sizeof...(Ts)}});
}

template <typename... Ts>
void Description::ListOf(std::string_view name, std::vector<std::variant<Ts...>>& value, FieldInfo info) {
  fields_.push_back(
      {std::string(name), std::move(info),
       Bound::ListOfOneOf{[&value] { return value.size(); }, [&value](std::size_t n) { value.resize(n); },
                          [&value](std::size_t i) { return value[i].index(); },
                          [&value](std::size_t i, std::size_t alternative) {
                            describe_internal::EmplaceByIndex(value[i], alternative, std::index_sequence_for<Ts...>{});
                          },
                          [&value](std::size_t i, Description& d) { describe_internal::DescribeActive(d, value[i]); },
                          sizeof...(Ts)}});
}

}  // namespace alula::base
