// What pictures and tables call an axis and its values.
#pragma once

#include <string>
#include <string_view>

namespace billow::cli {

/// "λ [per mean rest length]" of solver.filter.lambda, "h [s]" of an axis `h` with the key solver.step: the axis' name,
/// or λ, and the unit of the scene's key; the name alone where there is no key, or none with a unit.
std::string default_axis_label(const std::string& name, std::string_view key);

/// "h = 0.01 s" on the axis "h [s]": numbers, true, false, none and auto say nothing alone. Other words, and maps,
/// stand for themselves.
std::string shown_value(const std::string& axis_label, const std::string& value);

}  // namespace billow::cli
