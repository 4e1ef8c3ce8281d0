// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/PreviewErrorEstimate.h"

#include "Filters/Pieces/CoarserPreview.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace smg
{
namespace
{

/** A preview of fewer points is known well enough by eye. */
constexpr std::int64_t MinPoints = 400;
constexpr std::int64_t Coarsening = 4;

/** Two digits count, as in 0.0095, 12 or 4,400. */
std::string twoDigits(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.1e", value);
  const double rounded = std::strtod(text, nullptr);
  if (rounded >= 10.0 && rounded < 1e15)
  {
    return groupedDigits(std::llround(rounded));
  }
  std::snprintf(text, sizeof(text), "%.2g", rounded);
  return text;
}

} // namespace

PreviewErrorEstimate::PreviewErrorEstimate(
  vtkPointSet& preview, KeptCoarserPreview& kept, const Solve& solve)
{
  if (preview.GetNumberOfPoints() < MinPoints || !CoarserPreview::isPossible(preview))
  {
    return;
  }
  try
  {
    const CoarserPreview& coarser = kept.of(preview, preview.GetNumberOfPoints() / Coarsening);
    this->Points = coarser.points();
    this->Columns = solve(*coarser.of(preview), this->Values);
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const Error&)
  {
    this->Points.clear(); // a region without a point of it, for example
  }
}

std::string PreviewErrorEstimate::of(
  const std::vector<double>& values, int columns, int compared) const
{
  if (this->Columns < compared)
  {
    return "";
  }
  std::vector<double> differences;
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    double squares = 0.0;
    for (int k = 0; k < compared; ++k)
    {
      const auto there = static_cast<std::size_t>(this->Points[i] * columns + k);
      const double difference = values[there] - this->Values[i * std::size_t(this->Columns) + k];
      squares += difference * difference;
    }
    if (std::isfinite(squares)) // as where no source is reached
    {
      differences.push_back(std::sqrt(squares));
    }
  }
  if (differences.empty())
  {
    return "";
  }
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) /
                      static_cast<double>(differences.size());
  const auto most =
    differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
  std::ranges::nth_element(differences, most);
  return "the result on a quarter of which differs by " + twoDigits(mean) + " in the mean, " +
         twoDigits(*most) + " at 99 %.";
}

} // namespace smg
