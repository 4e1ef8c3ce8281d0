// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/RegionList.h"

#include "Solver/Core/Error.h"
#include "Solver/Stream/OriginalNumbers.h"

#include <algorithm>
#include <utility>

namespace smg
{

namespace
{

/** What a region selects. */
struct Selection
{
  std::int64_t vertices = 0;
  std::vector<bool> ids; ///< which of the vertices that the region names the mesh has
};

} // namespace

RegionList::RegionList(std::vector<NamedRegion> regions, const StreamInfo& mesh, std::string file)
  : Regions(std::move(regions))
  , File(std::move(file))
{
  this->HasIds = findColumn(mesh.vertexColumns, OriginalIdSpec) >= 0;
  this->ByName = std::any_of(this->Regions.begin(), this->Regions.end(),
    [](const NamedRegion& named) { return named.region.vertices() != nullptr; });
}

std::vector<std::string> RegionList::vertexColumns() const
{
  return this->HasIds && this->ByName ? std::vector<std::string>{ OriginalIdName }
                                      : std::vector<std::string>{};
}

const Column* RegionList::idColumn(const MeshBlock& block) const
{
  const std::ptrdiff_t place = findColumn(block.vertexColumns, OriginalIdSpec);
  if (place < 0 && !this->vertexColumns().empty())
  {
    throw Error(this->File + ": the mesh is read without its column " + OriginalIdName +
                ", which the regions of vertices need.");
  }
  return place < 0 ? nullptr : &block.vertexColumns[static_cast<std::size_t>(place)];
}

std::vector<std::int64_t> RegionList::check(MeshSource& mesh) const
{
  std::vector<std::int64_t> following(this->Regions.size(), 0);
  std::vector<Selection> selections(this->Regions.size());
  for (std::size_t k = 0; k < selections.size(); ++k)
  {
    const Region::Vertices* named = this->Regions[k].region.vertices();
    selections[k].ids.resize(named ? named->ids.size() : 0);
  }
  for (MeshBlock block; !selections.empty() && mesh.next(block);)
  {
    const Column* ids = this->idColumn(block);
    constexpr std::size_t None = static_cast<std::size_t>(-1);
    std::size_t vertex = None, last = None;
    this->visit(block,
      [&](std::size_t i, std::size_t k)
      {
        ++selections[k].vertices;
        ++following[k];
        if (i == vertex)
        {
          --following[last];
        }
        vertex = i;
        last = k;
        if (const Region::Vertices* named = this->Regions[k].region.vertices())
        {
          const auto place =
            std::lower_bound(named->ids.begin(), named->ids.end(), idOf(block, ids, i));
          selections[k].ids[static_cast<std::size_t>(place - named->ids.begin())] = true;
        }
      });
  }
  for (std::size_t k = 0; k < selections.size(); ++k)
  {
    const std::string place = this->File + ": " + this->Regions[k].name;
    const std::vector<bool>& ids = selections[k].ids;
    const auto missing = std::find(ids.begin(), ids.end(), false);
    if (missing != ids.end())
    {
      const std::int64_t id =
        this->Regions[k].region.vertices()->ids[static_cast<std::size_t>(missing - ids.begin())];
      throw Error(place + ".vertices: the mesh has no vertex with the original number " +
                  std::to_string(id) + ", or it belongs to no cell.");
    }
    if (selections[k].vertices == 0)
    {
      throw Error(place + ": no vertex of the mesh is in this region.");
    }
  }
  return following;
}

} // namespace smg
