// What a library may answer and what it may not.
#include "scenarios/plugin/internal/answer.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "scenarios/plugin/internal/utf8.h"

namespace alula::scenarios::plugin {
namespace {

/// What reading the answer throws; empty where nothing.
template <typename Answer>
std::string Complaint(const Answer& answer) {
  try {
    Read(answer);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return {};
}

AlulaEstimate Upright() {
  AlulaEstimate estimate{};
  estimate.X_OB = estimate.X_MO = alula_identity();
  return estimate;
}

TEST(PluginAnswer, ZerosAreAnAnswer) {
  const stack::StackOutput read = Read(AlulaOutput{});
  EXPECT_TRUE(read.commands.empty() && read.events.empty() && !read.estimate);
  EXPECT_EQ(read.state, stack::StackState::kInitialising);
  EXPECT_TRUE(Read(AlulaFiles{}).empty());
  EXPECT_TRUE(Read(AlulaTiming{}).empty());
}

TEST(PluginAnswer, ListsMustBeBelievable) {
  AlulaOutput output{};
  output.command_count = 1;
  EXPECT_EQ(Complaint(output), "the stack's answer: 1 commands at a null pointer");
  const AlulaCommand command{};
  output.commands = &command;
  output.command_count = std::uint64_t{1} << 40;
  EXPECT_EQ(Complaint(output), "the stack's answer: 1099511627776 commands; there may be 65536");
  EXPECT_NE(Complaint(AlulaFiles{nullptr, 3}), "");
  EXPECT_NE(Complaint(AlulaTiming{nullptr, 3}), "");
}

TEST(PluginAnswer, StateMustExist) {
  AlulaOutput output{};
  output.state = 5;
  EXPECT_EQ(Complaint(output), "the stack's answer: state 5; there are 0 to 4");
}

TEST(PluginAnswer, QuaternionsMustBeUnitAndNanIsLeftToTheSimulation) {
  AlulaEstimate estimate = Upright();
  AlulaOutput output{};
  output.estimate = &estimate;
  EXPECT_EQ(Complaint(output), "");
  estimate.X_MO.q = {};
  EXPECT_EQ(Complaint(output), "the stack's answer: the quaternion of estimate.X_MO has length 0.000000; 1 is wanted");
  estimate = Upright();
  estimate.X_OB.q.w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Complaint(output), "");
}

TEST(PluginAnswer, TextsMustBeUtf8AndOfBoundedLength) {
  AlulaEvent event{0, alula_text("kind"), alula_text("a sentence, größer")};
  AlulaOutput output{};
  output.events = &event;
  output.event_count = 1;
  EXPECT_EQ(Read(output).events[0].text, "a sentence, größer");
  event.text = alula_text("\xff");
  EXPECT_EQ(Complaint(output), "the stack's answer: the text of an event is no UTF-8");
  event.text = {nullptr, 5};
  EXPECT_EQ(Complaint(output), "the stack's answer: the text of an event is a null pointer");
  event.text = {"x", std::uint64_t{1} << 50};
  EXPECT_NE(Complaint(output).find("there may be 65536"), std::string::npos);
}

TEST(PluginAnswer, FilesHavePlainNames) {
  const std::uint8_t bytes[] = {1, 0, 2};
  AlulaFile file{alula_text("map.bt"), bytes, sizeof bytes};
  const AlulaFiles files{&file, 1};
  EXPECT_EQ(Read(files)[0].bytes, std::string("\1\0\2", 3));
  for (const char* name : {"", ".", "..", ".hidden", "../verdict.json", "a/b", "a\\b"}) {
    file.name = alula_text(name);
    EXPECT_NE(Complaint(files).find("a plain name is wanted"), std::string::npos) << name;
  }
  file.name = {"a\0b", 3};
  EXPECT_NE(Complaint(files), "");
  file = {alula_text("map.bt"), nullptr, 1};
  EXPECT_EQ(Complaint(files), "the stack's answer: the bytes of map.bt are a null pointer");
}

TEST(PluginUtf8, WellFormedIsWhatUnicodeSays) {
  for (const char* good :
       {"", "a", "\x7f", "\xc2\x80", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(IsUtf8(good)) << good;
    EXPECT_EQ(ValidUtf8(good), good);
  }
  for (const char* bad : {"\x80", "\xc0\x80", "\xc1\xbf", "\xc2", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
                          "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xe2\x82"}) {
    EXPECT_FALSE(IsUtf8(bad)) << bad;
    EXPECT_TRUE(IsUtf8(ValidUtf8(bad)));
  }
  EXPECT_EQ(ValidUtf8("gr\xfc\xdf"), "gr??");
}

}  // namespace
}  // namespace alula::scenarios::plugin
