// The names of backends.
#include "render/gl/backend.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include "base/suggest.h"

namespace billow::render {
namespace {

constexpr std::string_view device_prefix = "egl:";
constexpr const char* backend_variable = "BILLOW_BACKEND";

std::optional<int> parse_device(std::string_view digits) {
  int number = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = error == std::errc() && rest == digits.data() + digits.size();
  return whole && number >= 0 ? std::optional(number) : std::nullopt;
}

}  // namespace

Words<BackendKind> words(BackendKind) {
  static constexpr Word<BackendKind> list[] = {
      {"auto", BackendKind::automatic}, {"osmesa", BackendKind::osmesa}, {"egl", BackendKind::egl}};
  return list;
}

std::string text_of(const Backend& backend) {
  return backend.device ? fmt::format("{}{}", device_prefix, *backend.device) : std::string(word_of(backend.kind));
}

Backend parse_backend(std::string_view text) {
  for (const auto& [word, kind] : words(BackendKind()))
    if (word == text) return {kind, {}};
  if (text.starts_with(device_prefix)) {
    if (const auto device = parse_device(text.substr(device_prefix.size()))) return {BackendKind::egl, device};
    throw std::invalid_argument(fmt::format(
        "'{}' names no device; write egl:0, egl:1 and so on, as 'billow doctor' lists them, or egl alone for software",
        text));
  }
  std::vector<std::string_view> known = all_words<BackendKind>();
  known.push_back("egl:N");
  throw std::invalid_argument(fmt::format("there is no backend '{}'{}", text, suggestion(text, known, "backends are")));
}

Backend backend_of_environment() {
  const char* text = std::getenv(backend_variable);
  if (!text || !*text) return {};
  try {
    return parse_backend(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", backend_variable, error.what()));
  }
}

}  // namespace billow::render
