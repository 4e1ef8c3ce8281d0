// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "smg/Export.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>

namespace smg
{

// Values of options in JSON. All functions throw Error with the place.

/** The bytes of a number of at least 1 MiB, or of a text with a unit. */
SMG_EXPORT std::int64_t bytesIn(const JsonNode& node);
/** The place of a text among some. */
SMG_EXPORT std::size_t choiceIn(const JsonNode& node, std::span<const char* const> choices);
inline std::size_t choiceIn(const JsonNode& node, std::initializer_list<const char*> choices)
{
  return choiceIn(node, std::span<const char* const>(choices.begin(), choices.size()));
}
/** true or false. */
SMG_EXPORT bool flagIn(const JsonNode& node);
/** The name of a folder. */
SMG_EXPORT std::filesystem::path folderIn(const JsonNode& node);

/** Numbers that are allowed: at least `least` and at most `most`, or between them. */
struct NumberRange
{
  double least = -HUGE_VAL;
  double most = HUGE_VAL;
  bool isOpen = false; ///< without its ends
};
/** In words, after "must be"; empty: any number. */
SMG_EXPORT std::string inWords(const NumberRange& range);
/** A number of a range. */
SMG_EXPORT double numberIn(const JsonNode& node, const NumberRange& range);

} // namespace smg
