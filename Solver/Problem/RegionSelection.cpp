// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/RegionSelection.h"

#include <algorithm>

namespace smg
{

RegionSelection::RegionSelection(
  const Region& region, DataPlace place, const std::string& key, MeshColumns& columns)
  : Selection(place, key, columns)
  , Selected(region)
{
  if (const std::string complaint = region.complaint(); !complaint.empty())
  {
    columns.fail(key, "the region " + complaint);
  }
  if (const Region::Vertices* named = region.vertices())
  {
    columns.requireIds();
    this->Found.resize(named->ids.size());
  }
}

void RegionSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  const Column* ids = this->Selected.vertices() ? this->Columns.ids(block) : nullptr;
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    const std::int64_t id =
      ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
    const std::span<const double, 3> point(block.positions.data() + 3 * i, 3);
    selected[i] = this->Selected.contains(point, id) ? 1 : 0;
  }
}

void RegionSelection::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  this->Selection::prepare(block, scratch);
  const Region::Vertices* named = this->Selected.vertices();
  if (!named)
  {
    return;
  }
  const Column* ids = this->Columns.ids(block);
  const std::span<const std::uint8_t> selected = this->atVertices();
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    if (selected[i])
    {
      const std::int64_t id =
        ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
      const auto place = std::ranges::lower_bound(named->ids, id);
      this->Found[static_cast<std::size_t>(place - named->ids.begin())] += 1;
    }
  }
}

void RegionSelection::endPreparing(MeshParts* parts)
{
  if (parts)
  {
    parts->sum(this->Found);
  }
  const auto missing = std::ranges::find(this->Found, 0);
  if (missing != this->Found.end())
  {
    const std::int64_t id =
      this->Selected.vertices()->ids[static_cast<std::size_t>(missing - this->Found.begin())];
    this->Columns.fail(this->Key + ".vertices", "the mesh has no vertex with the original number " +
                                                  std::to_string(id) +
                                                  ", or it belongs to no cell");
  }
  this->Selection::endPreparing(parts);
}

} // namespace smg
