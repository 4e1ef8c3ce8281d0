// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/** The pieces of text of an HTML page: what is escaped, and numbers as a person reads them. */
namespace html
{

/** Text for the content of an element or of an attribute in quotes. Bytes that are no UTF-8, and
 * control characters other than line breaks and tabulators, become U+FFFD. */
std::string escape(std::string_view text);

/** "34,834" */
std::string count(std::int64_t number);
/** So many digits at most, as "0.0123" or "1.5e-7"; "not a number" or "infinite". */
std::string number(double value, int digits = 6);
/** "12.3 MiB" */
std::string bytes(double value);
/** "0.42 s", "12 min 3 s" */
std::string seconds(double value);
/** A power of ten, "10⁻⁷". */
std::string powerOfTen(int exponent);
/** "7 passes", "1 pass" */
std::string counted(std::int64_t number, const std::string& one, const std::string& several);

/** A command line that a shell reads as these words. */
std::string commandLine(const std::vector<std::string>& words);

/** The day and the time of now, with the time zone. */
std::string now();

} // namespace html
