// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/ConditionText.h"

#include "Solver/Problem/ProblemData.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>

namespace smg
{
namespace
{

using Json = nlohmann::json;

void requireFinite(const std::vector<double>& numbers, const char* name)
{
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
  {
    throw Error(std::string("The ") + name + " of the condition is not a finite number.");
  }
}

/** A number, or a tensor of six components; three values are its diagonal. */
Json coefficientOf(std::vector<double> values, const ValueRules& rules, const char* key)
{
  if (values.size() == 1)
  {
    return values.front();
  }
  const bool mayBeTensor = rules.range == ValueRange::PositiveDefinite;
  if (mayBeTensor && (values.size() == 3 || values.size() == 6))
  {
    values.resize(6, 0.0);
    return values;
  }
  throw Error(
    std::string("A ") + key +
    (mayBeTensor ? " has 1 number, 3 (the diagonal of a tensor: xx, yy, zz) or 6 (xx, yy, zz, xy, "
                   "yz, xz)."
                 : " has 1 number."));
}

} // namespace

bool Condition::mayHoldEverywhere() const
{
  bool may = false;
  forProblemData([&]<class Row>(const Row& row)
    { may = may || (std::is_same_v<Row, DatumRow> && std::string_view(this->key) == row.key); });
  return may;
}

std::string Condition::text() const
{
  Json entry = Json::object();
  if (!this->mask.empty())
  {
    entry["mask"] = this->mask;
  }
  else if (!this->tagged.empty())
  {
    requireFinite({ this->tag }, "tag");
    entry["tag"] = { this->tagged, this->tag };
  }
  else if (!this->group.empty())
  {
    entry["group"] = this->group;
  }
  else if (this->isOnBoundary)
  {
    entry["boundary"] = true;
  }
  requireFinite(this->values, "value");
  requireFinite({ this->coefficient }, "coefficient");
  const Json value = this->isPosition ? Json("position") : Json(this->values);
  Json problem = Json::object();
  const auto add = [&](const auto& row)
  {
    if (std::string_view(this->key) != row.key)
    {
      return;
    }
    const auto columns = static_cast<int>(this->isPosition ? 3 : this->values.size());
    const ValueRules rules = row.rules(columns);
    const bool isSolution = rules.range == ValueRange::Any;
    const char* valueKey = "value";
    if constexpr (requires { row.valueKey; })
    {
      valueKey = row.valueKey;
      if (row.coefficientKey)
      {
        entry[row.coefficientKey] = this->coefficient;
      }
    }
    entry[valueKey] = isSolution ? value : coefficientOf(this->values, rules, row.key);
    problem[row.key] = Json::array({ entry });
    if (isSolution)
    {
      problem["columns"] = columns;
    }
  };
  forProblemData(add);
  return problem.dump();
}

} // namespace smg
