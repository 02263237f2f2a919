// Text for XML, SVG and HTML.
#include "base/xml.h"

#include <gtest/gtest.h>

namespace billow {
namespace {

TEST(XmlEscape, LeavesNothingThatIsReadAsMarkup) {
  EXPECT_EQ(xml_escape("<a href=\"x\">'&amp;'</a> ]]> λ"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;amp;&#39;&lt;/a&gt; ]]&gt; λ");
}

TEST(XmlCharacters, AreThoseThatADocumentMayHold) {
  const std::string fine = "tab\t, lines\n\r, \u00A0λ\u2028\uFDCF\uFDF0, \U0001F41F, \U0010FFFD, \uFFFD";
  EXPECT_EQ(xml_characters(fine), fine);
  EXPECT_EQ(xml_characters(std::string_view("\0\x01\x1f", 3)), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(xml_characters("\x7f\u0080\u009F"), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(xml_characters("\uFFFE \uFFFF \uFDD0 \uFDEF \U0001FFFE \U0010FFFF"),
            "\uFFFD \uFFFD \uFFFD \uFFFD \uFFFD \uFFFD");
  // No UTF-8: a byte alone, an overlong form, a surrogate, past the end, and cut short.
  EXPECT_EQ(xml_characters("\xff"), "\uFFFD");
  EXPECT_EQ(xml_characters("\xc0\xaf"), "\uFFFD\uFFFD");
  EXPECT_EQ(xml_characters("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(xml_characters("\xf4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(xml_characters("a\xe2\x82"), "a\uFFFD\uFFFD");
}

}  // namespace
}  // namespace billow
