// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Selection.h"

#include "Solver/Problem/BoundarySelection.h"
#include "Solver/Problem/ColumnSelection.h"
#include "Solver/Problem/NearestSelection.h"
#include "smg/Region.h"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** Calls `visit(c, bits)` for each cell; bit k of `bits` is set if corner k is selected. */
void forCorners(
  CellType type, const CellRange& cells, const OpenValues<std::uint8_t>& open, auto visit)
{
  const auto corners = static_cast<std::size_t>(cornersOf(type));
  for (std::size_t c = 0; c < cells.corners.size() / corners; ++c)
  {
    unsigned bits = 0;
    for (std::size_t k = 0; k < corners; ++k)
    {
      bits |= static_cast<unsigned>(*open.at(cells.corners[c * corners + k])) << k;
    }
    visit(c, bits);
  }
}

} // namespace

std::unique_ptr<Selection> Selection::make(const Where& where, DataPlace place,
  ColumnOwner preferred, const std::string& key, MeshColumns& columns)
{
  if (std::holds_alternative<Everywhere>(where))
  {
    return nullptr;
  }
  if (const auto* region = std::get_if<Region>(&where))
  {
    return std::make_unique<RegionSelection>(*region, place, key, columns);
  }
  if (const auto* nearest = std::get_if<NearestVertices>(&where))
  {
    return std::make_unique<NearestSelection>(*nearest, place, key, columns);
  }
  if (std::holds_alternative<OnBoundary>(where))
  {
    return std::make_unique<BoundarySelection>(place, key, columns);
  }
  const auto ofColumn = [&](const std::string& name, const char* what,
                          std::optional<double> value) -> std::unique_ptr<Selection>
  {
    const NamedColumn column = columns.require(name, preferred, key + what);
    if (column.components != 1)
    {
      columns.fail(key + what, "the column '" + name + "' has " +
                                 std::to_string(column.components) +
                                 " components, but must have one");
    }
    const ColumnTest test{ column, value };
    if (column.owner == ColumnOwner::Cells)
    {
      return std::make_unique<CellSelection>(test, place, key, columns);
    }
    return std::make_unique<ColumnSelection>(test, place, key, columns);
  };
  if (const auto* tag = std::get_if<ColumnTag>(&where))
  {
    return ofColumn(tag->column, ".tag", tag->value);
  }
  return ofColumn(std::get<ColumnMask>(where).column, ".mask", std::nullopt);
}

void Selection::startBlock(const MeshBlock& block)
{
  if (block.firstVertex == 0)
  {
    this->Open.restart();
    this->Finalized = 0;
  }
  this->Open.release(this->Finalized);
  this->Finalized = block.finalized;
  const std::span<std::uint8_t> current = this->Open.append(block.vertices());
  this->select(block, current);
  this->Current = current;
}

void Selection::atCells(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const unsigned all = (1U << cornersOf(this->Columns.cellType())) - 1U;
  forCorners(this->Columns.cellType(), cells, this->Open,
    [&](std::size_t c, unsigned bits) { selected[c] = bits == all ? 1 : 0; });
}

void Selection::atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const int corners = cornersOf(this->Columns.cellType());
  const unsigned all = (1U << corners) - 1U;
  forCorners(this->Columns.cellType(), cells, this->Open,
    [&](std::size_t c, unsigned bits)
    {
      unsigned facets = 0;
      for (int k = 0; k < corners; ++k)
      {
        facets |= static_cast<unsigned>((bits | 1U << k) == all) << k;
      }
      selected[c] = static_cast<std::uint8_t>(facets);
    });
}

void Selection::prepare(const MeshBlock& block, const std::filesystem::path& /*scratch*/)
{
  this->startBlock(block);
  if (this->Place == DataPlace::Vertices)
  {
    this->Count += std::ranges::count(this->Current, 1);
    return;
  }
  const CellRange cells{ block, 0, block.corners };
  std::vector<std::uint8_t> selected(
    block.corners.size() / static_cast<std::size_t>(cornersOf(this->Columns.cellType())));
  this->Place == DataPlace::Cells ? this->atCells(cells, selected)
                                  : this->atFacets(cells, selected);
  this->Count += std::ranges::count_if(selected, [](std::uint8_t bits) { return bits != 0; });
}

void Selection::endPreparing(MeshParts* parts)
{
  if (parts)
  {
    parts->sum({ &this->Count, 1 });
  }
  if (this->Count == 0)
  {
    const char* what = this->Place == DataPlace::Vertices               ? "vertex"
                       : this->Place == DataPlace::Cells                ? "cell"
                       : this->Columns.cellType() == CellType::Triangle ? "edge"
                                                                        : "face";
    this->Columns.fail(this->Key, std::string("no ") + what + " of the mesh " + this->predicate() +
                                    (parts ? "" : this->instead()));
  }
}

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

namespace
{

std::string complaintOf(const Region::HalfSpace& half)
{
  return half.normal == std::array<double, 3>{}
           ? "must have a direction: its first three numbers must not all be 0"
           : "";
}

std::string complaintOf(const Region::Box& box)
{
  const bool isInsideOut =
    box.low[0] > box.high[0] || box.low[1] > box.high[1] || box.low[2] > box.high[2];
  return isInsideOut ? "must be x0, y0, z0, x1, y1, z1 with x0 <= x1, y0 <= y1 and z0 <= z1" : "";
}

std::string complaintOf(const Region::Sphere& sphere)
{
  return sphere.radius >= 0.0 ? "" : "must have a radius of at least 0";
}

std::string complaintOf(const Region::Vertices& vertices)
{
  if (vertices.ids.empty())
  {
    return "must name at least one vertex";
  }
  return vertices.ids.front() < 0 ? "must name vertices by numbers from 0" : "";
}

Region::Vertices sorted(Region::Vertices vertices)
{
  std::ranges::sort(vertices.ids);
  vertices.ids.erase(std::unique(vertices.ids.begin(), vertices.ids.end()), vertices.ids.end());
  return vertices;
}

} // namespace

Region::Region(Vertices shape)
  : What(sorted(std::move(shape)))
{
}

std::string Region::complaint() const
{
  return std::visit([](const auto& shape) { return complaintOf(shape); }, this->What);
}

bool Region::contains(std::span<const double, 3> p, std::int64_t id) const
{
  if (const auto* half = std::get_if<HalfSpace>(&this->What))
  {
    return half->normal[0] * p[0] + half->normal[1] * p[1] + half->normal[2] * p[2] >=
           half->distance;
  }
  if (const auto* box = std::get_if<Box>(&this->What))
  {
    return p[0] >= box->low[0] && p[1] >= box->low[1] && p[2] >= box->low[2] &&
           p[0] <= box->high[0] && p[1] <= box->high[1] && p[2] <= box->high[2];
  }
  if (const auto* sphere = std::get_if<Sphere>(&this->What))
  {
    const double x = p[0] - sphere->center[0];
    const double y = p[1] - sphere->center[1];
    const double z = p[2] - sphere->center[2];
    return x * x + y * y + z * z <= sphere->radius * sphere->radius;
  }
  const std::vector<std::int64_t>& ids = std::get<Vertices>(this->What).ids;
  return std::binary_search(ids.begin(), ids.end(), id);
}

std::optional<std::array<double, 3>> Region::center() const
{
  if (const auto* sphere = std::get_if<Sphere>(&this->What))
  {
    return sphere->center;
  }
  if (const auto* box = std::get_if<Box>(&this->What))
  {
    std::array<double, 3> center{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      center[axis] = std::midpoint(box->low[axis], box->high[axis]);
    }
    return center;
  }
  return std::nullopt;
}

} // namespace smg
