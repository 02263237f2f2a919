// JSON as billow writes it.
#pragma once

#include <string>

namespace billow::cli {

/// `json`, of nlohmann's kinds, as text, on one line without an `indent`. A path or a program's words may hold bytes
/// that are no UTF-8; they become U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace billow::cli
