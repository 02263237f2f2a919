// What is printed of what is not printable.
#include "cli/text/terminal.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace billow::cli {
namespace {

TEST(Terminal, ShowsLettersOfAnyScriptAsTheyAre) {
  for (const char* text : {"Tuch", "ä ß é", "日本", "ткань", "קנבס", "🐟", "λ = 1 /s² … × –", "\"'\\"})
    EXPECT_EQ(printable(text), text);
}

TEST(Terminal, WritesOutWhatATerminalWouldActOn) {
  EXPECT_EQ(printable("\x1b[31mred\x07\x7f"), "\\x1b[31mred\\x07\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\u009b31m"), "\\u009b31m");
  EXPECT_EQ(printable("a\rb\tc\nd"), "a\\rb\\tc\\nd");
  EXPECT_EQ(printable("\u202egnp.exe \u2066x\u2069 \u061c"), "\\u202egnp.exe \\u2066x\\u2069 \\u061c");
  EXPECT_EQ(printable("a\u200bb\ufeff\u00ad\u2028\ue000"), "a\\u200bb\\ufeff\\u00ad\\u2028\\ue000");
  EXPECT_EQ(printable("\U000e0041\U0001ffff"), "\\U000e0041\\U0001ffff");
}

// Overlong forms, surrogates, what lies past the last character, and what is cut short.
TEST(Terminal, WritesOutBytesThatAreNoCharacters) {
  EXPECT_EQ(printable("a\xff\xfe"
                      "b"),
            "a\\xff\\xfeb");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xe6\x97"), "\\xe6\\x97");
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");
}

// However long what it quotes is.
TEST(Terminal, LeavesOutTheMiddleOfALongMessage) {
  testing::internal::CaptureStderr();
  say_line("scene.yaml:1:1: {}; the end", std::string(100'000, '\x1b'));
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_LT(said.size(), 4010u);
  EXPECT_EQ(said.rfind("scene.yaml:1:1: \\x1b", 0), 0u);
  EXPECT_NE(said.find(" … "), std::string::npos);
  EXPECT_EQ(said.substr(said.size() - 13), "x1b; the end\n");
}

TEST(Terminal, KeepsTheEndsOfLinesOfItsOwn) { EXPECT_EQ(printable_lines("one\ntwo\r\n"), "one\ntwo\\r\n"); }

TEST(Terminal, LeavesJsonTheValueThatItWas) {
  const std::string odd = "a\"\\\n\x1b\u009b\u202e\U000e0041ä日本";
  const nlohmann::json value = {{"name", odd}, {"list", {1, 2}}};
  const std::string text = printable_json(value.dump(2));
  EXPECT_EQ(nlohmann::json::parse(text), value);
  EXPECT_NE(text.find("\\u202e"), std::string::npos);
  EXPECT_NE(text.find("\\udb40\\udc41ä日本"), std::string::npos);
}

}  // namespace
}  // namespace billow::cli
