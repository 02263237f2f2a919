// Numbers in and out, whatever the locale.
#include "cli/text/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <random>

namespace billow::cli {
namespace {

TEST(NumberText, ReadsDecimalNumbers) {
  const std::vector<std::pair<const char*, double>> texts{
      {"0", 0.0},         {"-0.5", -0.5},
      {"+3", 3.0},        {".25", 0.25},
      {"1.", 1.0},        {"1e6", 1e6},
      {"2E-3", 2e-3},     {"0.1", 0.1},
      {"1e-320", 1e-320}, {"1.7976931348623157e308", 1.7976931348623157e308},
  };
  for (const auto& [text, value] : texts) {
    SCOPED_TRACE(text);
    EXPECT_EQ(parse_number(text).fault, NumberFault::none);
    EXPECT_EQ(parse_number(text).value, value);
  }
}

TEST(NumberText, SaysWhyATextIsNoNumber) {
  const std::vector<std::pair<const char*, NumberFault>> texts{
      {"", NumberFault::not_a_number},         {"abc", NumberFault::not_a_number},
      {"1x", NumberFault::not_a_number},       {"1 2", NumberFault::not_a_number},
      {"+-1", NumberFault::not_a_number},      {"0x1p3", NumberFault::not_a_number},
      {"1,5", NumberFault::decimal_comma},     {"1,5,2", NumberFault::not_a_number},
      {"010", NumberFault::leading_zero},      {"-00", NumberFault::leading_zero},
      {".NaN", NumberFault::not_finite},       {"-Infinity", NumberFault::not_finite},
      {"nan(1)", NumberFault::not_a_number},   {"1e400", NumberFault::out_of_range},
      {"infinite", NumberFault::not_a_number},
  };
  for (const auto& [text, fault] : texts) EXPECT_EQ(parse_number(text).fault, fault) << text;
}

TEST(NumberText, ShortestReadsBackExactly) {
  std::mt19937_64 bits(7);
  for (int i = 0; i < 20000; ++i) {
    double value;
    const std::uint64_t pattern = bits();
    std::memcpy(&value, &pattern, sizeof value);
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(parse_number(shortest(value)).value, value) << shortest(value);
  }
}

TEST(NumberText, ShortestIsWhatAPersonWouldWrite) {
  const std::vector<std::pair<double, const char*>> numbers{
      {0.0, "0"},       {-9.81, "-9.81"},  {0.1, "0.1"},        {1e6, "1000000"},
      {0.001, "0.001"}, {1e-7, "1.0e-07"}, {1.5e20, "1.5e+20"},
  };
  for (const auto& [value, text] : numbers) EXPECT_EQ(shortest(value), text);
}

// The C library's readers and writers would take the comma here.
TEST(NumberText, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_ALL, name)) break;
  EXPECT_EQ(parse_number("0.5").value, 0.5);
  EXPECT_EQ(shortest(0.5), "0.5");
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace billow::cli
