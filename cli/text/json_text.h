// JSON as text.
#pragma once

#include <string>

namespace billow::cli {

/// `json` (nlohmann's, ordered or not) with `indent` blanks a level, or on one line. A file may have any name: what of
/// a string is no UTF-8 becomes U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace billow::cli
