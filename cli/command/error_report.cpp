// "FILE:LINE:COLUMN: what is wrong; what to do" -> its parts.
#include "cli/command/error_report.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/text/json_text.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Of a message that begins with its place.
struct Place {
  std::string_view file;
  int line = 0, column = 0;
  std::size_t end = 0;  // where the message goes on
};

// The number at `place` with `ending` behind it, or -1; `place` goes on behind that.
int number_at(std::string_view text, std::size_t& place, std::string_view ending) {
  int number = -1;
  const char* const begin = text.data() + place;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  const std::size_t next = static_cast<std::size_t>(end - text.data());
  if (error != std::errc() || end == begin || text.substr(next, ending.size()) != ending) return -1;
  place = next + ending.size();
  return number;
}

// The first ":LINE:COLUMN: " behind a name.
Place located_place(std::string_view text) {
  for (std::size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
    std::size_t place = colon + 1;
    const int line = number_at(text, place, ":");
    if (line < 0) continue;
    const int column = number_at(text, place, ": ");
    if (column >= 0) return {text.substr(0, colon), line, column, place};
  }
  return {};
}

// One that is there, or that an argument names, or that was looked for in a folder that an argument names.
bool is_file(std::string_view name, const std::vector<std::string>& arguments) {
  std::error_code error;
  const auto names_it = [&](const std::string& argument) {
    return name == argument || (!argument.empty() && name.starts_with(argument + "/"));
  };
  return !name.starts_with("--") && (std::any_of(arguments.begin(), arguments.end(), names_it) ||
                                     std::filesystem::exists(std::filesystem::path(name), error));
}

Place place_of_file(std::string_view text, const std::vector<std::string>& arguments) {
  const std::size_t colon = text.find(": ");
  if (colon == std::string_view::npos || !is_file(text.substr(0, colon), arguments)) return {};
  return {text.substr(0, colon), 0, 0, colon + 2};
}

bool is_letter(std::string_view text, std::size_t place) {
  return place < text.size() && std::isalnum(static_cast<unsigned char>(text[place]));
}

// The first "; " that is not in 'quotes', which what is quoted can have; an apostrophe stands within a word.
std::size_t hint_in(std::string_view text) {
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\'' && (quoted ? !is_letter(text, k + 1) : k == 0 || !is_letter(text, k - 1))) quoted = !quoted;
    if (!quoted && text.substr(k, 2) == "; ") return k;
  }
  return std::string_view::npos;
}

}  // namespace

std::string error_json(std::string_view message, int status, const std::vector<std::string>& arguments) {
  Place place = located_place(message);
  if (place.end == 0) place = place_of_file(message, arguments);
  const std::string_view rest = message.substr(place.end);
  const std::size_t hint = hint_in(rest);
  const auto or_null = [](bool is_there, const auto& value) { return is_there ? Json(value) : Json(); };
  return json_text(Json{{"file", or_null(!place.file.empty(), place.file)},
                        {"line", or_null(place.line > 0, place.line)},
                        {"column", or_null(place.column > 0, place.column)},
                        {"message", rest.substr(0, hint)},
                        {"hint", hint == std::string_view::npos ? Json() : Json(rest.substr(hint + 2))},
                        {"exit", status}});
}

}  // namespace billow::cli
