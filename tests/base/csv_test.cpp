// What spreadsheets make of a field.
#include "base/csv.h"

#include <gtest/gtest.h>

namespace billow {
namespace {

TEST(CsvField, IsQuotedWhereItMustBe) {
  EXPECT_EQ(csv_field("plain λ"), "plain λ");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a, b"), "\"a, b\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_field("a\r"), "\"a\r\"");
  EXPECT_EQ(csv_field("a;b"), "\"a;b\"");
}

TEST(CsvField, IsNoFormula) {
  for (const char* formula :
       {"=1+1", "=cmd|x", "@SUM", "-x", "+x", "-", "+1+1", "-1-1", "--1", "1e5=", " =1", "\uFF1D1"})
    EXPECT_EQ(csv_field(formula), (formula[0] == '1' ? "" : "'") + std::string(formula)) << formula;
  EXPECT_EQ(csv_field("\t=1"), "\"'\t=1\"");
  EXPECT_EQ(csv_field("=a,b"), "\"'=a,b\"");
}

TEST(CsvField, LeavesNumbersNumbers) {
  for (const char* number : {"-1", "+1", "-.5", "+2.", "-2.5e-3", "+1E5", "0.5"}) EXPECT_EQ(csv_field(number), number);
}

}  // namespace
}  // namespace billow
