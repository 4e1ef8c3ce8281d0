// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/ConditionNames.h"

#include "Solver/Problem/ProblemData.h"

#include <cctype>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

namespace smg
{
namespace
{

/** The number of entries of each datum that has a list of them. */
std::map<std::string, std::size_t> entriesOf(const ProblemDescription& problem)
{
  std::map<std::string, std::size_t> entries;
  forProblemData(
    [&]<class Row>(const Row& row)
    {
      if constexpr (std::is_same_v<Row, DatumRow>)
      {
        entries[row.key] = (problem.*row.member).entries.size();
      }
      else if constexpr (!std::is_same_v<Row, ColumnRow>)
      {
        entries[row.key] = (problem.*row.member).size();
      }
    });
  return entries;
}

/** Replaces the key of an entry at the beginning of `rest` by the property of a Mesh Condition. */
void nameProperty(std::string& rest)
{
  constexpr std::pair<std::string_view, std::string_view> properties[] = { { ".value", "Value" },
    { ".ambient", "Value" }, { ".coefficient", "Coefficient" }, { ".weight", "Coefficient" },
    { ".mask", "Mask Array" }, { ".tag", "Tag Array" } };
  for (const auto& [key, property] : properties)
  {
    if (rest.starts_with(key))
    {
      rest.replace(0, key.size(), ": " + std::string(property));
      return;
    }
  }
}

} // namespace

void ConditionNames::add(
  int number, const ProblemDescription& before, const ProblemDescription& after)
{
  const auto had = entriesOf(before);
  for (const auto& [key, count] : entriesOf(after))
  {
    for (std::size_t index = had.at(key); index < count; ++index)
    {
      this->Entries.push_back({ key, index, number });
    }
  }
}

ConditionNames ConditionNames::ofAlone(int number)
{
  ConditionNames names;
  for (const auto& [key, count] : entriesOf({}))
  {
    names.Entries.push_back({ key, 0, number });
  }
  return names;
}

std::string ConditionNames::in(std::string sentence) const
{
  for (const Entry& entry : this->Entries)
  {
    const std::string place = entry.key + '[' + std::to_string(entry.index) + ']';
    std::string label = entry.key;
    label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
    const std::string name = "Mesh Condition " + std::to_string(entry.number) + " (" + label + ')';
    for (std::size_t at = sentence.find(place); at != std::string::npos;
         at = sentence.find(place, at + name.size()))
    {
      std::string rest = sentence.substr(at + place.size());
      nameProperty(rest);
      sentence.resize(at);
      constexpr std::string_view whole = "problem: ";
      if (sentence.ends_with(whole))
      {
        sentence.resize(at -= whole.size());
      }
      sentence += name + rest;
    }
  }
  return sentence;
}

} // namespace smg
