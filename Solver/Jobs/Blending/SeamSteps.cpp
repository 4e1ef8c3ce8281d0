// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Blending/SeamSteps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smg
{

SeamSteps::SeamSteps(const std::vector<ColumnSpec>& columns)
{
  for (const ColumnSpec& column : columns)
  {
    this->Components.push_back(column.components);
  }
  this->Steps.resize(
    static_cast<std::size_t>(std::accumulate(this->Components.begin(), this->Components.end(), 0)));
}

void SeamSteps::add(std::span<const std::int64_t> corners, const PatchedValues& values)
{
  if (values.inOnePatch(corners))
  {
    return;
  }
  ++this->Cells;
  for (std::size_t j = 1; j < corners.size(); ++j)
  {
    for (std::size_t i = 0; i < j; ++i)
    {
      if (values.inOnePatch(corners[i], corners[j]))
      {
        continue;
      }
      ++this->Edges;
      const double* a = values.at(corners[i]);
      const double* b = values.at(corners[j]);
      for (std::size_t k = 0; k < this->Steps.size(); ++k)
      {
        this->Steps[k] = std::max(this->Steps[k], std::fabs(a[k] - b[k]));
      }
    }
  }
}

std::vector<double> SeamSteps::largest() const
{
  std::vector<double> largest;
  auto step = this->Steps.begin();
  for (const int components : this->Components)
  {
    largest.push_back(*std::max_element(step, step + components));
    step += components;
  }
  return largest;
}

} // namespace smg
