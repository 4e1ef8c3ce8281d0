// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace html
{

using Json = nlohmann::ordered_json;

/** A number as its name in the report says: bytes, seconds, a count or a plain number. Texts,
 * truth values and lists of these, too. */
std::string valueText(const std::string& name, const Json& value);

/** A name of the report as words: "pool bytes peak". */
std::string nameText(const std::string& name);

/** A table; all texts are plain. Columns are numbers, except those that `isText` names. */
struct Table
{
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::vector<bool> isText = { true }; ///< of the first columns; of the others false
};
std::string table(const Table& table);

/** A table of objects; what one of them lacks is left empty. */
std::string tableOf(const Json& objects);

/** The entries of a report that no other part of the page shows, as names and values, with a table
 * for each list of objects. Empty if there are none. */
std::string furtherFigures(const Json& entries);

/** A number of an object, 0 if it has none of this name. */
double numberOf(const Json& object, const char* name);
std::int64_t countOf(const Json& object, const char* name);

} // namespace html
