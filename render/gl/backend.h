// Which OpenGL is to draw.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/words.h"

namespace billow::render {

/// `automatic` is always software, so that bytes repeat: OSMesa, or where that is missing EGL's.
enum class BackendKind { automatic, osmesa, egl };
Words<BackendKind> words(BackendKind);

struct Backend {
  BackendKind kind = BackendKind::automatic;
  std::optional<int> device = {};  // of egl, counted from 0 as EGL lists them; none: software
};

/// "auto", "osmesa", "egl" or "egl:2".
std::string text_of(const Backend& backend);

/// The backend of such a text. Throws std::invalid_argument, whose text says what can be written.
Backend parse_backend(std::string_view text);

/// That of the variable BILLOW_BACKEND; automatic where it is not set or empty. Throws std::invalid_argument.
Backend backend_of_environment();

}  // namespace billow::render
