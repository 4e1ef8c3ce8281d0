// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/JobProperties.h"

#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Jobs/ReadOptions.h"
#include "IO/Jobs/SolveJob.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace smg
{

std::string propertyOf(const JobOption& option)
{
  if (option.property)
  {
    return option.property;
  }
  std::string name;
  bool begins = true;
  for (const char c : std::string_view(option.key))
  {
    if (c != '_')
    {
      name += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    }
    begins = c == '_';
  }
  return name;
}

const std::map<std::string, std::string, std::less<>>& propertiesOfOptions()
{
  static const auto all = []
  {
    std::map<std::string, std::string, std::less<>> found;
    for (const JobKind& kind : jobKinds())
    {
      for (const JobOption& option : kind.make()->table())
      {
        std::string flag = std::string("--") + option.key;
        std::ranges::replace(flag, '_', '-');
        if (const std::string property = propertyOf(option); !property.empty())
        {
          found.emplace(flag, property);
        }
      }
    }
    return found;
  }();
  return all;
}

struct JobProperties::Row
{
  const JobOption* option;
  std::string property;
  bool isOptional; ///< whether 0 stands for none
  double number = 0.0;
  std::string text = {};

  /** The names of a choice, with that of none. */
  std::vector<std::string> choices() const
  {
    std::vector<std::string> names;
    if (const auto* choice = std::get_if<ChoiceOption>(&this->option->kind))
    {
      names.assign(this->isOptional ? 1 : 0, "automatic");
      names.insert(names.end(), choice->names.begin(), choice->names.end());
    }
    return names;
  }
};

namespace
{

/** A kind of option whose value is a number, a flag or a choice. */
template <class Kind>
concept Numeric = requires(const Kind& option, const Job& job)
{
  static_cast<double>(*option.member.get(job));
};

bool hasNumber(const JobOption& option)
{
  return std::visit([]<class Kind>(const Kind&) { return Numeric<Kind>; }, option.kind);
}

bool hasText(const JobOption& option)
{
  return isKind<ColumnOption>(option) || isKind<WhereOption>(option);
}

/** Of an option in a job; none: it has no such value, or no end. */
std::optional<double> numberIn(const Job& job, const JobOption& option)
{
  return std::visit(
    [&job]<class Kind>(const Kind& kind) -> std::optional<double>
    {
      if constexpr (Numeric<Kind>)
      {
        const auto value = kind.member.get(job);
        const double number = value ? static_cast<double>(*value) : HUGE_VAL;
        return std::isfinite(number) ? std::optional(number) : std::nullopt;
      }
      return std::nullopt;
    },
    option.kind);
}

void setNumber(Job& job, const JobOption& option, double number)
{
  std::visit(
    [&]<class Kind>(const Kind& kind)
    {
      if constexpr (Numeric<Kind>)
      {
        using Value = std::remove_cvref_t<decltype(*kind.member.get(job))>;
        kind.member.set(job, static_cast<Value>(number));
      }
    },
    option.kind);
}

/** Whole numbers with all of their digits. */
std::string textOf(const JobOption& option, double number)
{
  return isKind<NumberOption>(option) ? shortest(number)
                                      : std::to_string(static_cast<std::int64_t>(number));
}

} // namespace

JobProperties::JobProperties(std::string_view kind)
{
  const std::unique_ptr<Job> job = makeJob(kind);
  const auto add = [this](std::span<const JobOption> table, const Job& fresh)
  {
    for (const JobOption& option : table)
    {
      const std::string property = propertyOf(option);
      const std::optional<double> number = numberIn(fresh, option);
      const bool isProperty = !property.empty() && (hasNumber(option) || hasText(option));
      if (isProperty && this->placeOf(property) == this->Rows.size())
      {
        this->Rows.push_back({ &option, property, !number, number.value_or(0.0) });
      }
    }
  };
  add(job->table(), *job);
  if (dynamic_cast<const MeshJob*>(job.get()))
  {
    const SolveJob solve;
    add(ToleranceOptions, solve);
    add(SolverOptions, solve);
  }
}

JobProperties::~JobProperties() = default;

std::size_t JobProperties::placeOf(std::string_view property) const
{
  return static_cast<std::size_t>(
    std::ranges::find(this->Rows, property, &Row::property) - this->Rows.begin());
}

double JobProperties::number(std::string_view property) const
{
  return this->Rows[this->placeOf(property)].number;
}

const std::string& JobProperties::text(std::string_view property) const
{
  return this->Rows[this->placeOf(property)].text;
}

bool JobProperties::set(std::string_view property, double number)
{
  return std::exchange(this->Rows[this->placeOf(property)].number, number) != number;
}

bool JobProperties::set(std::string_view property, const std::string& text)
{
  return std::exchange(this->Rows[this->placeOf(property)].text, text) != text;
}

void JobProperties::check() const
{
  for (const Row& row : this->Rows)
  {
    const auto* real = std::get_if<NumberOption>(&row.option->kind);
    const auto* count = std::get_if<CountOption>(&row.option->kind);
    const std::vector<std::string> choices = row.choices();
    const bool isChoice = !choices.empty();
    const bool hasZero = !isChoice && (row.isOptional || (real && real->zero));
    if ((!real && !count && !isChoice) || (hasZero && row.number == 0.0))
    {
      continue;
    }
    const NumberRange range =
      real    ? real->range
      : count ? NumberRange{ static_cast<double>(count->least), static_cast<double>(count->most) }
              : NumberRange{ 0.0, static_cast<double>(choices.size() - 1) };
    const bool isIn = range.isOpen ? row.number > range.least && row.number < range.most
                                   : row.number >= range.least && row.number <= range.most;
    if (!isIn || std::isinf(row.number))
    {
      const std::string words = count ? allowedValues(*row.option) : inWords(range);
      throw Error(row.property + " is " + textOf(*row.option, row.number) + ": set it to " +
                  (words.starts_with("at least") ? "" : "a number ") + words +
                  (!hasZero          ? "."
                    : row.isOptional ? ", or to 0 (none)."
                                     : ", or to 0 (automatic)."));
    }
  }
}

void JobProperties::applyTo(Job& job) const
{
  for (const JobOption& option : job.table())
  {
    const auto row = std::ranges::find(this->Rows, &option, &Row::option);
    if (row == this->Rows.end())
    {
      continue;
    }
    if (const auto* column = std::get_if<ColumnOption>(&option.kind))
    {
      column->member.set(job, row->text == "None" ? "" : row->text);
    }
    else if (!row->isOptional || row->number != 0.0)
    {
      const bool isAfterNone = row->isOptional && isKind<ChoiceOption>(option);
      setNumber(job, option, row->number - (isAfterNone ? 1.0 : 0.0));
    }
  }
}

std::vector<std::string> JobProperties::lines() const
{
  std::vector<std::string> lines;
  for (const Row& row : this->Rows)
  {
    const std::vector<std::string> choices = row.choices();
    const bool isNamed = row.number >= 0.0 && row.number < static_cast<double>(choices.size());
    const std::string text = row.text.empty() ? "(none)" : row.text;
    lines.push_back(row.property + ": " +
                    (hasText(*row.option) ? text
                      : isNamed           ? choices[static_cast<std::size_t>(row.number)]
                                          : textOf(*row.option, row.number)));
  }
  return lines;
}

} // namespace smg
