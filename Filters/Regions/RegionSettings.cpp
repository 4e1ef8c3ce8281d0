// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/RegionSettings.h"

#include "Solver/Jobs/Projection/PointTree.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace smg
{

double meanEdgeLength(const MeshBlock& block, CellType cellType)
{
  const std::span<const double> positions(block.positions);
  const auto corners = static_cast<std::size_t>(cornersOf(cellType));
  double sum = 0.0;
  std::int64_t edges = 0;
  for (std::size_t cell = 0; cell < block.corners.size(); cell += corners)
  {
    const auto corner = [&](std::size_t k)
    { return positions.subspan(3 * block.corners[cell + k]).first<3>(); };
    for (std::size_t i = 1; i < corners; ++i)
    {
      for (std::size_t j = 0; j < i; ++j, ++edges)
      {
        sum += std::sqrt(PointTree::squaredDistance(corner(i), corner(j)));
      }
    }
  }
  return edges > 0 ? sum / static_cast<double>(edges) : 0.0;
}

Where MarkedRegionSettings::where() const
{
  if (this->isBoundary())
  {
    return OnBoundary{};
  }
  if (!this->group.empty())
  {
    return InGroup{ { this->group } };
  }
  if (this->tag)
  {
    return ColumnTag{ this->array, *this->tag };
  }
  return ColumnMask{ this->array };
}

bool MarkedRegionSettings::isMarked(double value, bool isFloat) const
{
  if (this->tag)
  {
    return value == (isFloat ? static_cast<double>(static_cast<float>(*this->tag)) : *this->tag);
  }
  if (std::isnan(value))
  {
    throw Error("The array " + this->array +
                " of the region has a value that is not a number: choose another array.");
  }
  return value != 0.0;
}

void PointRegionSettings::check(bool hasSelection) const
{
  if (this->kind == Kind::Selection && !hasSelection)
  {
    throw Error("The region has no selection: select something on its input and copy the active "
                "selection.");
  }
  if (this->kind == Kind::Ids)
  {
    if (this->ids.empty())
    {
      throw Error("The region has no ids: name at least one point in Ids.");
    }
    const std::int64_t lowest = *std::min_element(this->ids.begin(), this->ids.end());
    if (lowest < 0)
    {
      throw Error("The id " + std::to_string(lowest) + " of the region is negative.");
    }
  }
  if (this->kind == Kind::Points && this->points.empty())
  {
    throw Error("The region has no points: name at least one place in Points.");
  }
  if (!std::isfinite(this->radius))
  {
    throw Error("The radius of the region is not a finite number.");
  }
}

IdList::IdList(const std::vector<std::int64_t>& ids)
  : Size(static_cast<std::int64_t>(ids.size()))
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    this->Sorted.emplace_back(ids[i], static_cast<std::int64_t>(i));
  }
  std::sort(this->Sorted.begin(), this->Sorted.end());
  const auto end = std::unique(this->Sorted.begin(), this->Sorted.end(),
    [](const auto& a, const auto& b) { return a.first == b.first; });
  this->Sorted.erase(end, this->Sorted.end());
}

std::int64_t IdList::numberOf(std::int64_t id) const
{
  const auto found =
    std::lower_bound(this->Sorted.begin(), this->Sorted.end(), std::pair(id, std::int64_t(0)));
  return found != this->Sorted.end() && found->first == id ? found->second : -1;
}

std::int64_t IdList::firstMissing(const std::vector<char>& isFound) const
{
  for (const auto& [id, number] : this->Sorted)
  {
    if (number >= static_cast<std::int64_t>(isFound.size()) || !isFound[number])
    {
      return id;
    }
  }
  return -1;
}

} // namespace smg
