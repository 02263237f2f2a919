// Numbers as people read them, in pictures and on pages.
#pragma once

#include <string>

namespace billow {

/// "10⁻⁵" has superscript(-5).
std::string superscript(int number);

/// `value` to `digits` significant ones, with a true minus sign: "−2.31", "0.0042", "10⁶", "3.59·10⁻⁵". Powers of ten
/// stand where plain digits would be many: from 10⁵ on, and below 10⁻³.
std::string readable_number(double value, int digits = 3);

/// A whole number in groups of three digits: "14,502".
std::string grouped(long number);

}  // namespace billow
