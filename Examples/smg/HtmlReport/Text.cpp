// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Text.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace html
{

namespace
{

constexpr std::string_view Replacement = "\xEF\xBF\xBD"; // U+FFFD

/** What stands for a character of one byte in HTML. */
std::string_view inHtml(const char& c)
{
  switch (c)
  {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      break;
  }
  const auto code = static_cast<unsigned char>(c);
  const bool isControl = (code < 32 && c != '\n' && c != '\t') || code == 127;
  return isControl ? Replacement : std::string_view(&c, 1);
}

std::string formatted(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

} // namespace

std::string escape(std::string_view text)
{
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  while (!text.empty())
  {
    const std::size_t length = smg::utf8Bytes(text);
    out += length == 1 ? inHtml(text.front()) : length == 0 ? Replacement : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string count(std::int64_t number)
{
  return smg::groupedDigits(number);
}

std::string number(double value, int digits)
{
  if (!std::isfinite(value))
  {
    return std::isnan(value) ? "not a number" : value > 0.0 ? "infinite" : "-infinite";
  }
  char shown[64];
  std::snprintf(shown, sizeof shown, "%.*g", digits, value);
  std::string text = shown;
  // 1e-07 is written 1e-7.
  if (const std::size_t e = text.find('e'); e != std::string::npos)
  {
    const std::size_t power = text[e + 1] == '-' ? e + 2 : e + 1;
    text.erase(power, text.find_first_not_of("+0", power) - power);
  }
  return text;
}

std::string bytes(double value)
{
  constexpr const char* units[] = { "bytes", "KiB", "MiB", "GiB", "TiB", "PiB" };
  int unit = 0;
  for (; std::abs(value) >= 1024.0 && unit < 5; ++unit)
  {
    value /= 1024.0;
  }
  const char* const format = unit == 0 || value >= 100.0 ? "%.0f" : "%.1f";
  return formatted(format, value) + ' ' + units[unit];
}

std::string seconds(double value)
{
  if (value < 60.0)
  {
    return formatted(value < 10.0 ? "%.2f s" : "%.1f s", value);
  }
  const auto whole = static_cast<std::int64_t>(std::llround(value));
  const std::string parts[] = { std::to_string(whole / 3600) + " h",
    std::to_string(whole / 60 % 60) + " min", std::to_string(whole % 60) + " s" };
  return whole < 3600 ? parts[1] + ' ' + parts[2] : parts[0] + ' ' + parts[1];
}

std::string powerOfTen(int exponent)
{
  constexpr const char* raised[] = { "⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹" };
  if (exponent == 0 || exponent == 1)
  {
    return exponent == 0 ? "1" : "10";
  }
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
  {
    text += raised[digit - '0'];
  }
  return text;
}

std::string counted(std::int64_t number, const std::string& one, const std::string& several)
{
  return count(number) + ' ' + (number == 1 ? one : several);
}

std::string commandLine(const std::vector<std::string>& words)
{
  constexpr std::string_view Plain =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
    "_-+=./,:@%^";
  std::string line;
  for (const std::string& word : words)
  {
    // Letters beyond ASCII need no quotes.
    const bool isPlain = !word.empty() && std::ranges::all_of(word,
                                            [&](char c) {
                                              return Plain.find(c) != std::string_view::npos ||
                                                     static_cast<unsigned char>(c) >= 128;
                                            });
    std::string quoted;
    for (const char c : word)
    {
      quoted += c == '\'' ? "'\\''" : std::string(1, c);
    }
    line += (line.empty() ? "" : " ") + (isPlain ? word : '\'' + quoted + '\'');
  }
  return line;
}

std::string now()
{
  const std::time_t time = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&time, &local);
  // The names of months do not depend on the locale of the system.
  constexpr const char* months[] = { "January", "February", "March", "April", "May", "June", "July",
    "August", "September", "October", "November", "December" };
  char clock[32];
  std::strftime(clock, sizeof clock, "%H:%M %Z", &local);
  return std::to_string(local.tm_mday) + ' ' + months[local.tm_mon] + ' ' +
         std::to_string(local.tm_year + 1900) + ", " + clock;
}

} // namespace html
