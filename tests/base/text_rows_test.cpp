#include "base/text_rows.h"

#include <gtest/gtest.h>

#include <sstream>

namespace alula::base {
namespace {

TextRow Row(std::string_view line) { return {line, {"file.csv", 7, 0}}; }

/// The message of the InputError that `action` throws; empty where it throws none.
template <typename Action>
std::string Complaint(const Action& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(TextRows, CommasOrBlanksPartTheCells) {
  const TextRow csv = Row("1, -2.5e3 ,,x y");
  ASSERT_EQ(csv.size(), 4u);
  EXPECT_TRUE(csv.has_commas());
  EXPECT_EQ(csv.Number(1, "p_x"), -2500.0);
  EXPECT_EQ(csv.Word(2, "nothing"), "");
  EXPECT_EQ(csv.Word(3, "word"), "x y");
  const TextRow tum = Row("  1.5\t+2   3 ");
  ASSERT_EQ(tum.size(), 3u);
  EXPECT_FALSE(tum.has_commas());
  EXPECT_EQ(tum.Number(1, "p_x"), 2.0);
}

TEST(TextRows, TimesKeepEveryNanosecond) {
  EXPECT_EQ(Row("1403715273262142977").TimeInNanoseconds(0, "t").ns, 1403715273262142977);
  EXPECT_EQ(Row("1305031102.175304001").TimeInSeconds(0, "t").ns, 1305031102175304001);
  EXPECT_EQ(Row("-0.25").TimeInSeconds(0, "t").ns, -250000000);
  EXPECT_EQ(Row("3").TimeInSeconds(0, "t").ns, 3000000000);
  EXPECT_EQ(Row("1.5e2").TimeInSeconds(0, "t").ns, 150000000000);
  EXPECT_EQ(Row("0.12345678987").TimeInSeconds(0, "t").ns, 123456789);  // digits beyond the nanosecond fall away
}

TEST(TextRows, BadCellsNameFileLineAndColumn) {
  EXPECT_EQ(Complaint([] { Row("1,two").Number(1, "p_x"); }), "file.csv:7: p_x: `two` is not a finite number");
  for (const char* bad : {"nan", "inf", "1e999", "", "1.5x", "0x10", "--1"}) {
    EXPECT_NE(Complaint([&] { Row(std::string(bad) + ",").Number(0, "p_x"); }), "") << bad;
  }
  EXPECT_EQ(Complaint([] { Row("1,2").Number(2, "p_z"); }),
            "file.csv:7: p_z: is missing: the row has 2 values and this one is number 3");
  for (const char* bad : {"1.5", "9300000000000000000", "x", ""}) {
    EXPECT_NE(Complaint([&] { Row(std::string(bad) + ",").TimeInNanoseconds(0, "t"); }), "") << bad;
  }
  for (const char* bad : {"1.2.3", "1e300", "-", "nan", "99999999999999999999.5"}) {
    EXPECT_NE(Complaint([&] { Row(std::string(bad) + ",").TimeInSeconds(0, "t"); }), "") << bad;
  }
}

TEST(TextRows, CommentsAndEmptyLinesAreCountedAndSkipped) {
  std::istringstream text("#head\r\n\n1 2\r\n  # more\n3 4");
  std::vector<int> lines;
  ForEachRow(text, "f", [&](const TextRow& row) {
    lines.push_back(row.where().line);
    EXPECT_EQ(row.size(), 2u);
    row.Number(1, "second");
  });
  EXPECT_EQ(lines, (std::vector<int>{3, 5}));
  EXPECT_NE(Complaint([] { ForEachRowOf("/nowhere/at/all", [](const TextRow&) {}); }), "");
  EXPECT_NE(Complaint([] { ForEachRowOf("/", [](const TextRow&) {}); }), "");
}

}  // namespace
}  // namespace alula::base
