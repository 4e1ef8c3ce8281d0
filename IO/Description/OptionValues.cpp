// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/OptionValues.h"

#include "IO/Description/Sizes.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace smg
{

std::int64_t bytesIn(const JsonNode& node)
{
  constexpr std::int64_t MinBytes = std::int64_t(1) << 20, MaxBytes = std::int64_t(1) << 50;
  if (!node.isString())
  {
    return node.integer(MinBytes, MaxBytes);
  }
  std::optional<double> bytes;
  try
  {
    bytes = bytesOf(node.string());
  }
  catch (const Error& error)
  {
    node.fail(error.what());
  }
  if (!bytes || *bytes > static_cast<double>(MaxBytes))
  {
    node.fail("must be a number of bytes, or a text with a unit, as 512M, 1.5GiB or 2GB");
  }
  return static_cast<std::int64_t>(*bytes);
}

std::size_t choiceIn(const JsonNode& node, std::span<const char* const> choices)
{
  const std::string given = node.string();
  const auto found = std::ranges::find(choices, given);
  if (found == choices.end())
  {
    std::string names;
    for (const char* choice : choices)
    {
      names += (names.empty() ? "" : ", ") + std::string(choice);
    }
    node.fail("must be one of " + names);
  }
  return static_cast<std::size_t>(found - choices.begin());
}

bool flagIn(const JsonNode& node)
{
  if (!node.value().is_boolean())
  {
    node.fail("must be true or false");
  }
  return node.isTrue();
}

std::filesystem::path folderIn(const JsonNode& node)
{
  const std::string folder = node.string();
  if (folder.empty())
  {
    node.fail("must be the name of a folder");
  }
  return folder;
}

std::string inWords(const NumberRange& range)
{
  const bool hasLeast = std::isfinite(range.least), hasMost = std::isfinite(range.most);
  if (hasLeast && hasMost)
  {
    return (range.isOpen ? "between " : "from ") + shortest(range.least) +
           (range.isOpen ? " and " : " to ") + shortest(range.most) +
           (range.isOpen ? ", both excluded" : "");
  }
  return hasLeast ? (range.isOpen ? "above " : "at least ") + shortest(range.least) : "";
}

double numberIn(const JsonNode& node, const NumberRange& range)
{
  const double number = node.number();
  const bool isIn = range.isOpen ? number > range.least && number < range.most
                                 : number >= range.least && number <= range.most;
  if (!isIn)
  {
    node.fail("must be " + inWords(range));
  }
  return number;
}

} // namespace smg
