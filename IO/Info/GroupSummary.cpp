// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Info/GroupSummary.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace smg
{
namespace
{

/** The column of the sets of this kind among those of a block; null: it has none. */
const Column* setsIn(const std::vector<Column>& columns, GroupOf kind, CellType cells)
{
  const std::ptrdiff_t place = findColumn(columns, MeshGroups::columnSpec(kind, cornersOf(cells)));
  return place < 0 ? nullptr : &columns[static_cast<std::size_t>(place)];
}

/** The length, area or volume of a simplex. */
double measureOf(std::span<const double* const> points)
{
  const auto edge = [&](std::size_t k) { return difference(points[k], points[0]); };
  if (points.size() == 2)
  {
    return std::sqrt(dot(edge(1), edge(1)));
  }
  const Vector normal = cross(edge(1), edge(2));
  return points.size() == 3 ? std::sqrt(dot(normal, normal)) / 2.0
                            : std::fabs(dot(normal, edge(3))) / 6.0;
}

} // namespace

GroupSummary::GroupSummary(const StreamInfo& info)
  : Info(info)
{
  for (std::vector<Size>& sizes : this->Sets)
  {
    sizes.resize(info.groups.sets.size());
  }
}

void GroupSummary::add(const MeshBlock& block, const MeshMeasures& points)
{
  if (const Column* column = setsIn(block.vertexColumns, GroupOf::Vertices, this->Info.cellType))
  {
    for (const GroupSet set : column->as<GroupSet>())
    {
      auto& sizes = this->Sets[std::size_t(GroupOf::Vertices)];
      sizes[set < sizes.size() ? set : 0].count += 1;
    }
  }
  this->addCells(block, points);
}

void GroupSummary::addCells(const MeshBlock& block, const MeshMeasures& points)
{
  const Column* const ofCells = setsIn(block.cellColumns, GroupOf::Cells, this->Info.cellType);
  const Column* const ofFacets = setsIn(block.cellColumns, GroupOf::Facets, this->Info.cellType);
  if (!ofCells && !ofFacets)
  {
    return;
  }
  const auto count = static_cast<std::size_t>(cornersOf(this->Info.cellType));
  std::array<const double*, 4> at{};
  const auto addTo = [this](GroupOf kind, GroupSet set, std::span<const double* const> simplex)
  {
    auto& sizes = this->Sets[std::size_t(kind)];
    if (set > 0 && set < sizes.size())
    {
      sizes[set].count += 1;
      sizes[set].measure += measureOf(simplex);
    }
  };
  const Column* const flags = block.flags();
  for (std::size_t c = 0; c < block.corners.size() / count; ++c)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      at[k] = points.point(block.corners[c * count + k]);
    }
    const bool hasWeight = !flags || flags->as<std::uint8_t>()[c] == 0;
    if (ofCells && hasWeight)
    {
      addTo(GroupOf::Cells, ofCells->as<GroupSet>()[c], std::span(at).first(count));
    }
    for (std::size_t k = 0; ofFacets && k < count; ++k)
    {
      if (const GroupSet set = ofFacets->as<GroupSet>()[c * count + k]; set > 0)
      {
        std::array<const double*, 4> facet = at;
        std::copy(at.begin() + static_cast<std::ptrdiff_t>(k) + 1, at.end(),
          facet.begin() + static_cast<std::ptrdiff_t>(k));
        addTo(GroupOf::Facets, set, std::span(facet).first(count - 1));
      }
    }
  }
}

std::vector<MeshDescription::Group> GroupSummary::result() const
{
  const MeshGroups& all = this->Info.groups;
  std::vector<MeshDescription::Group> result(all.groups.size());
  for (std::size_t g = 0; g < result.size(); ++g)
  {
    result[g].group = all.groups[g];
  }
  for (std::size_t set = 0; set < all.sets.size(); ++set)
  {
    for (const std::uint32_t g : all.sets[set])
    {
      const Size& size = this->Sets[std::size_t(all.groups[g].of)][set];
      result[g].count += size.count;
      result[g].measure += size.measure;
    }
  }
  return result;
}

} // namespace smg
