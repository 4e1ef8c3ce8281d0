// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/ReadOptions.h"

#include "IO/Description/ParseDescriptions.h"
#include "IO/Description/Sizes.h"
#include "IO/Jobs/JobOption.h"
#include "Solver/Core/Text.h"
#include "Solver/Problem/ComposeDescriptions.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

SmoothingSize sizeIn(const JsonNode& node)
{
  if (!node.isString())
  {
    return { numberIn(node, { .least = 0.0, .isOpen = true }), SmoothingSize::Mesh };
  }
  const std::optional<SmoothingSize> size = smoothingSizeOf(node.string());
  if (!size)
  {
    node.fail('\'' + node.string() +
              "' is not a size: give a number above 0, as 2.5, \"1%\" or \"6edges\"");
  }
  return *size;
}

/** Reads a value of each kind. */
struct OptionReader
{
  const JsonNode& node;
  Job& job;

  void operator()(const NumberOption& option) const
  {
    const bool isZero = option.zero && node.isString() && node.string() == option.zero;
    if (option.zero && !isZero && !node.value().is_number())
    {
      node.fail(std::string("must be a number, or ") + option.zero);
    }
    option.member.set(job, isZero ? 0.0 : numberIn(node, option.range));
  }
  void operator()(const CountOption& option) const
  {
    option.member.set(job, node.integer(option.least, option.most));
  }
  void operator()(const BytesOption& option) const { option.member.set(job, bytesIn(node)); }
  void operator()(const FlagOption& option) const { option.member.set(job, flagIn(node)); }
  void operator()(const ChoiceOption& option) const
  {
    const bool isFormer =
      option.formerName && node.isString() && node.string() == option.formerName;
    option.member.set(job, isFormer ? option.former : choiceIn(node, option.names));
  }
  void operator()(const ColumnOption& option) const { option.member.set(job, node.columnName()); }
  void operator()(const ColumnsOption& option) const
  {
    std::vector<std::string> names;
    for (const JsonNode& name : node.elements())
    {
      names.push_back(name.columnName());
    }
    option.member.set(job, std::move(names));
  }
  void operator()(const WhereOption& option) const { option.member.set(job, parsePlaces(node)); }
  void operator()(const SizeOption& option) const { option.member.set(job, sizeIn(node)); }
  void operator()(const FolderOption& option) const { option.member.set(job, folderIn(node)); }
  void operator()(const DescriptionOption& option) const { option.read(node, job); }
};

} // namespace

void readOption(const JsonNode& value, const JobOption& option, Job& job)
{
  std::visit(OptionReader{ value, job }, option.kind);
}

void readOptions(const JsonNode& object, Job& job)
{
  std::vector<const char*> keys;
  std::ranges::transform(job.table(), std::back_inserter(keys), &JobOption::key);
  object.requireObject(keys);
  std::set<std::string_view> on; // the flags that are set unless something is said
  for (const JobOption& option : job.table())
  {
    const auto* flag = std::get_if<FlagOption>(&option.kind);
    if (flag && *flag->member.get(job))
    {
      on.insert(option.key);
    }
  }
  for (const JobOption& option : job.table())
  {
    if (!object.has(option.key) && !option.isRequired)
    {
      continue;
    }
    const JsonNode value = object.member(option.key);
    for (const char* const other : option.excludes)
    {
      // A flag that is not set is as one that is not given, unless it is on by itself.
      const auto isGiven = [&](const char* key)
      { return object.has(key) && (on.contains(key) || object.member(key).value() != false); };
      if (other && isGiven(option.key) && isGiven(other))
      {
        value.fail(std::string("does not go with ") + other + ": leave one out");
      }
    }
    readOption(value, option, job);
  }
}

std::set<std::string> columnsOf(const Job& job)
{
  std::set<std::string> names;
  for (const JobOption& option : job.table())
  {
    if (const auto* column = std::get_if<ColumnOption>(&option.kind))
    {
      names.insert(column->member.get(job).value_or(""));
    }
    else if (const auto* columns = std::get_if<ColumnsOption>(&option.kind))
    {
      const std::vector<std::string> several = *columns->member.get(job);
      names.insert(several.begin(), several.end());
    }
    else if (const auto* where = std::get_if<WhereOption>(&option.kind))
    {
      names.merge(namedColumns(*where->member.get(job)));
    }
  }
  names.erase("");
  return names;
}

std::string allowedValues(const JobOption& option)
{
  if (const auto* number = std::get_if<NumberOption>(&option.kind))
  {
    return inWords(number->range) + (number->zero ? std::string(", or ") + number->zero : "");
  }
  if (const auto* count = std::get_if<CountOption>(&option.kind))
  {
    return "from " + groupedDigits(count->least) + " to " + groupedDigits(count->most);
  }
  const auto* choice = std::get_if<ChoiceOption>(&option.kind);
  return choice ? listed(choice->names, "or") : std::string();
}

namespace
{

std::string textOf(const SmoothingSize& size)
{
  constexpr const char* units[] = { "edges", "", "%" };
  return shortest(size.value) + units[size.unit];
}

/** Describes an option of each kind: its kind, and its value in a job. */
struct DescribedOption
{
  const Job& job;
  nlohmann::ordered_json& row;

  /** Sets the kind and, if it has a value, the default. */
  void operator()(const char* kind, const auto& member, const auto& jsonOf) const
  {
    row["kind"] = kind;
    if (const auto value = member.get(job))
    {
      row["default"] = jsonOf(*value);
    }
  }

  void operator()(const NumberOption& option) const
  {
    (*this)("number", option.member, [](double value) { return nlohmann::json(value); });
    if (*option.unit)
    {
      row["unit"] = option.unit;
    }
    if (option.zero)
    {
      row["choices"] = { option.zero };
    }
    // JSON has no infinity: without an end.
    if (row.contains("default") && !std::isfinite(row["default"].get<double>()))
    {
      row.erase("default");
    }
  }
  void operator()(const CountOption& option) const
  {
    (*this)("count", option.member, [](std::int64_t value) { return value; });
  }
  void operator()(const BytesOption& /*option*/) const { row["kind"] = "bytes"; }
  void operator()(const FlagOption& option) const
  {
    (*this)("flag", option.member, [](bool value) { return value; });
  }
  void operator()(const ChoiceOption& option) const
  {
    (*this)("choice", option.member, [&](std::size_t value) { return option.names[value]; });
    row["choices"] = std::vector<std::string>(option.names.begin(), option.names.end());
  }
  void operator()(const ColumnOption& /*option*/) const { row["kind"] = "column"; }
  void operator()(const ColumnsOption& /*option*/) const { row["kind"] = "columns"; }
  void operator()(const WhereOption& /*option*/) const { row["kind"] = "where"; }
  void operator()(const SizeOption& option) const
  {
    (*this)("size", option.member, [](const SmoothingSize& size) { return textOf(size); });
  }
  void operator()(const FolderOption& /*option*/) const { row["kind"] = "folder"; }
  void operator()(const DescriptionOption& /*option*/) const { row["kind"] = "description"; }
};

} // namespace

nlohmann::ordered_json describe(const Job& job)
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const JobOption& option : job.table())
  {
    nlohmann::ordered_json row;
    row["key"] = option.key;
    row["help"] = option.help;
    std::visit(DescribedOption{ job, row }, option.kind);
    if (const std::string allowed = allowedValues(option); !allowed.empty())
    {
      row["allowed"] = allowed;
    }
    const std::pair<const char*, bool> flags[] = { { "required", option.isRequired },
      { "advanced", option.isAdvanced }, { "common", option.isCommon } };
    for (const auto& [key, isSet] : flags)
    {
      if (isSet)
      {
        row[key] = true;
      }
    }
    for (const char* const other : option.excludes)
    {
      if (other)
      {
        row["excludes"].push_back(other);
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

} // namespace smg
