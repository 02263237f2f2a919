// Numbers as people read them, in tables, legends and along axes.
#pragma once

#include <string>
#include <string_view>

namespace billow {

/// "14,502", "0.00139", "1.45 × 10⁻⁵", "−3": at most `digits` significant digits, but every digit before the point;
/// a power of ten where zeros would have to be counted, below 10⁻⁴ and from 10⁷ on. For people: programs get all
/// digits.
std::string readable(double value, int digits = 4);

/// "1,024.50": with that many decimals, a true minus sign and no "−0".
std::string readable_fixed(double value, int decimals);

/// "14,502"
std::string grouped(long number);

/// "14,502 springs", "1 spring": `one` is the word for one, and `many`, where it is more than an s longer, for others.
std::string counted(long number, std::string_view one, std::string_view many = {});

/// "10⁻⁵"
std::string power_of_ten(int exponent);

}  // namespace billow
