// What every page that billow writes shares: its shell and style, and how text gets into it safely.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace billow::cli {

/// JSON that can stand within <script>: every < is escaped, so that neither </script> nor <!-- ends or opens anything.
std::string json_for_script(std::string_view json);

/// `text` with every {{name}} replaced by its value; values are put in as they are, so escape them first. Throws
/// std::logic_error on a name without a value.
std::string fill_template(std::string_view text, const std::map<std::string, std::string, std::less<>>& values);

/// A whole page, self-contained: cli/page/page.html with page.css inside, `title` (plain text), `body` (HTML) and the
/// named scripts of cli/page. The classes that `body` may use are listed in page.css.
std::string html_page(std::string_view title, std::string_view body, const std::vector<std::string_view>& scripts = {});

}  // namespace billow::cli
