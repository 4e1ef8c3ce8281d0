// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/ConditionText.h"

#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

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
Json coefficientOf(std::vector<double> values, bool mayBeTensor)
{
  if (values.size() == 1)
  {
    return values.front();
  }
  if (mayBeTensor && (values.size() == 3 || values.size() == 6))
  {
    values.resize(6, 0.0);
    return values;
  }
  throw Error(mayBeTensor ? "A conductivity has 1 number, 3 (the diagonal of a tensor: xx, yy, zz) "
                            "or 6 (xx, yy, zz, xy, yz, xz)."
                          : "A screening has 1 number.");
}

} // namespace

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
  else if (this->isOnBoundary)
  {
    entry["boundary"] = true;
  }
  requireFinite(this->values, "value");
  requireFinite({ this->coefficient }, "coefficient");
  const Json value = this->isPosition ? Json("position") : Json(this->values);
  Json problem = Json::object();
  problem["columns"] = this->isPosition ? 3 : this->values.size();
  const auto add = [&](const char* key, const char* valueKey, const Json& what)
  {
    entry[valueKey] = what;
    problem[key] = Json::array({ entry });
  };
  switch (this->kind)
  {
    case ConditionKind::Dirichlet:
      add("dirichlet", "value", value);
      break;
    case ConditionKind::Flux:
      add("flux", "value", value);
      break;
    case ConditionKind::Robin:
      entry["coefficient"] = this->coefficient;
      add("robin", "ambient", value);
      break;
    case ConditionKind::Soft:
      entry["weight"] = this->coefficient;
      add("soft", "value", value);
      break;
    case ConditionKind::Source:
      add("source", "value", value);
      break;
    case ConditionKind::Conductivity:
    case ConditionKind::Screening:
    {
      const bool isConductivity = this->kind == ConditionKind::Conductivity;
      add(isConductivity ? "conductivity" : "screening", "value",
        coefficientOf(this->values, isConductivity));
      problem.erase("columns");
      break;
    }
  }
  return problem.dump();
}

} // namespace smg
