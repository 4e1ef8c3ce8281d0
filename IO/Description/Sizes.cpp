// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/Sizes.h"

#include "smg/Error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace smg
{
namespace
{

/** The text after a number, without spaces before it. */
std::string unitAfter(const char* number)
{
  std::string unit = number;
  unit.erase(0, unit.find_first_not_of(' '));
  return unit;
}

} // namespace

std::optional<double> bytesOf(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  std::string unit = unitAfter(end);
  if (end == text.c_str() || unit.empty())
  {
    return {};
  }
  std::ranges::transform(
    unit, unit.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::string_view Prefixes = "kmgt";
  const std::size_t power = Prefixes.find(unit.front());
  const std::string rest = unit.substr(1);
  if (power == std::string_view::npos || !(rest.empty() || rest == "ib" || rest == "b"))
  {
    throw Error('\'' + text + "' has another unit than K, M, G, T, KiB to TiB and KB to TB");
  }
  const double bytes =
    number * std::pow(rest == "b" ? 1000.0 : 1024.0, static_cast<double>(power) + 1.0);
  constexpr double Mebibyte = 1 << 20, Most = 1LL << 52;
  if (!(bytes >= Mebibyte && bytes <= Most * Mebibyte))
  {
    throw Error('\'' + text + "' is not a size of at least 1 MiB");
  }
  return bytes;
}

std::optional<SmoothingSize> smoothingSizeOf(const std::string& text)
{
  char* end = nullptr;
  SmoothingSize size;
  size.value = std::strtod(text.c_str(), &end);
  const std::string unit = unitAfter(end);
  size.unit = unit == "edges" || unit == "edge" ? SmoothingSize::MeanEdges
              : unit == "%"                     ? SmoothingSize::Diagonal
                                                : SmoothingSize::Mesh;
  size.value /= unit == "%" ? 100.0 : 1.0;
  const bool isSize = end != text.c_str() && std::isfinite(size.value) && size.value > 0.0 &&
                      (unit.empty() || size.unit != SmoothingSize::Mesh);
  return isSize ? std::optional(size) : std::nullopt;
}

} // namespace smg
