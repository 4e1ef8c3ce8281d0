// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/StartValues.h"
#include "smg/MeshSource.h"
#include "smg/ProblemDescription.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ranges>

namespace smg
{

StartValues::StartValues(const ProblemDescription& description)
  : Start(static_cast<std::size_t>(description.columns), 0.0)
{
  if (description.initial.isGiven())
  {
    return;
  }
  std::vector<const DataValue*> all;
  for (const PlacedValue& entry : description.dirichlet)
  {
    this->IsPosition = this->IsPosition || entry.value.isPosition();
    all.push_back(&entry.value);
  }
  for (const ProblemDescription::Robin& robin : description.robin)
  {
    all.push_back(&robin.ambient);
  }
  const bool isKnown =
    std::ranges::all_of(all, [](const DataValue* value) { return value->numbers() != nullptr; });
  for (std::size_t k = 0; isKnown && !all.empty() && k < this->Start.size(); ++k)
  {
    const auto numberOf = [k](const DataValue* value) { return (*value->numbers())[k]; };
    const auto [min, max] = std::ranges::minmax(all | std::views::transform(numberOf));
    const double middle = min / 2 + max / 2;
    this->Start[k] = min < max && max - min < std::fabs(middle) ? middle : 0.0;
  }
}

void StartValues::set(const MeshBlock& block, std::vector<double>& values) const
{
  if (this->IsPosition)
  {
    values = block.positions;
    return;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = this->Start[i % this->Start.size()];
  }
}

} // namespace smg
