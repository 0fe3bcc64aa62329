#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/describe.h"
#include "base/internal/yaml_tree.h"
#include "base/random.h"

namespace alula::base::yaml_internal {

/// Throws InputError with the node's place.
[[noreturn]] void Fail(const Node& node, std::string_view path, const std::string& message);

/// The text of a scalar, or an error that names what is `wanted`.
const std::string& ScalarText(const Node& node, const std::string& path, const char* wanted);

/// Index of the node's word among `info.choices`.
int ChoiceIndex(const Node& node, const std::string& path, const FieldInfo& info);

/// "did you mean `x`? There are x, y" or "choose one of x, y".
std::string Offer(const std::string& word, const std::vector<std::string>& words);

/// Whether the node is {choice: […]}.
bool IsChoice(const Node& node);

/// Reads single values, drawing those that are distributions (config.h: Draws).
class ValueReader {
 public:
  ValueReader(std::uint64_t seed, Draws* draws) : seed_(seed), draws_(draws) {}

  /// Notes what is drawn there from now on (nowhere: null); gives where it was noted before.
  Draws* NoteIn(Draws* draws) { return std::exchange(draws_, draws); }

  struct Draw {
    const Node* node;
    std::string path;
  };
  /// The entry that the seed draws from {choice: […]}; any other node is itself.
  Draw DrawChoice(const Node& node, const std::string& path) const;

  void Read(double* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(int* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(std::int64_t* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(std::uint64_t* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(bool* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(std::string* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(Duration* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(Rate* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void Read(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) const;

 private:
  template <typename Parse>
  double NumberOrDraw(const Node& node, const std::string& path, const FieldInfo& info, std::string_view unit,
                      const Parse& parse, bool whole) const;
  double DrawUniform(const std::string& path, double low, double high, bool whole) const;
  std::optional<double> DrawNormal(const std::string& path, double mean, double sigma, const FieldInfo& info,
                                   bool whole) const;
  double ReadDouble(const Node& node, const std::string& path, const FieldInfo& info, bool may_be_infinite) const;
  template <typename Integer>
  Integer ReadInteger(const Node& node, const std::string& path, const FieldInfo& info) const;
  void PatchVec3(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) const;
  void DrawVec3(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) const;

  std::optional<double> Quantile(const std::string& path) const;
  void Note(const std::string& path, Drawn drawn) const;

  std::uint64_t seed_;
  Draws* draws_;
};

/// The index that a map of `--set list.2=…` names, checked against the list's size.
int ElementIndex(const Node::Entry& entry, const std::string& path, std::size_t size);

}  // namespace alula::base::yaml_internal
