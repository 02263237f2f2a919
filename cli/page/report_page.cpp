// Filling cli/page/page.html.
#include "cli/page/report_page.h"

#include <fmt/format.h>

#include <stdexcept>

#include "base/xml.h"
#include "cli/page/page_file.h"
#include "cli/text/version.h"

namespace billow::cli {

std::string json_for_script(std::string_view json) {
  std::string escaped;
  for (const char c : json) c == '<' ? escaped += "\\u003c" : escaped += c;
  return escaped;
}

std::string fill_template(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string filled;
  for (std::size_t open; (open = text.find("{{")) != std::string_view::npos;) {
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value = values.find(name);
    if (close == std::string_view::npos || value == values.end())
      throw std::logic_error(fmt::format("a page's template asks for '{}'", name.substr(0, 40)));
    filled.append(text.substr(0, open)).append(value->second);
    text.remove_prefix(close + 2);
  }
  return filled.append(text);
}

std::string html_page(std::string_view title, std::string_view body, const std::vector<std::string_view>& scripts) {
  std::string inlined;
  for (const std::string_view script : scripts) inlined += fmt::format("<script>\n{}</script>\n", page_file(script));
  return fill_template(page_file("page.html"), {{"title", xml_escape(title)},
                                                {"version", std::string(version())},
                                                {"style", std::string(page_file("page.css"))},
                                                {"body", std::string(body)},
                                                {"scripts", inlined}});
}

}  // namespace billow::cli
