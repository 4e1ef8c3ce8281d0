// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Selection.h"

#include "Solver/Core/Text.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Problem/BoundarySelection.h"
#include "Solver/Problem/ColumnSelection.h"
#include "Solver/Problem/CombinedSelection.h"
#include "Solver/Problem/NearestSelection.h"
#include "smg/Region.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

// Evaluates the parts of a mesh that a description names (Where) block by block of the stream.
//
// A region selects vertices by their positions or numbers. Cells come later in the stream than
// their vertices, so one byte is kept for each open vertex, and cells and facets look up their
// corners. What each vertex gets depends on the vertex alone, hence not on how the stream is cut
// into blocks. Parts that cannot be known when the vertex arrives (the vertices of selected cells,
// the boundary, nearest vertices) take a reading of the stream beforehand: see the derived classes.
//
// A description that selects nothing is most likely a mistake, for instance in a unit or a number,
// which would go unnoticed in the solution. prepare() therefore counts what is selected.

namespace smg
{

std::size_t pointsOf(const Where& place)
{
  if (const auto* region = std::get_if<Region>(&place))
  {
    return region->vertices() ? region->vertices()->ids.size() : 0;
  }
  const auto* nearest = std::get_if<NearestVertices>(&place);
  return nearest ? nearest->points.size() : 0;
}

std::string whyNoGroup(const std::string& name, const MeshGroups& groups)
{
  for (const GroupOf kind : { GroupOf::Facets, GroupOf::Vertices })
  {
    if (!groups.find(name, kind).empty())
    {
      return "the group '" + name + "' is of " + nameOf(kind) + ", but cells are needed here";
    }
  }
  return groups.empty() ? "the mesh has no groups, so none is called '" + name + "'"
                        : "the mesh has no group '" + name + "'; it has " + groups.listFor(name);
}

std::string groupNames(const Where& where)
{
  const auto* group = std::get_if<InGroup>(&where);
  return group ? listed(group->names, "and") : "";
}

bool isOfCells(const Where& where, const MeshColumns& columns)
{
  if (const auto* group = std::get_if<InGroup>(&where))
  {
    const auto is = [&](const std::string& name, GroupOf kind)
    { return !columns.groups().find(name, kind).empty(); };
    return std::ranges::any_of(group->names,
      [&](const std::string& name)
      {
        return is(name, GroupOf::Cells) ||
               (is(name, GroupOf::Facets) && !is(name, GroupOf::Vertices));
      });
  }
  if (const auto* combined = std::get_if<Combination>(&where))
  {
    return std::ranges::any_of(
      combined->parts, [&](const Where& part) { return isOfCells(part, columns); });
  }
  const std::string* const column = columnOf(where);
  return column && columns.isOfCells(*column, ColumnOwner::Vertices);
}

namespace
{

/** Calls `visit(c, bits)` for each cell; bit k of `bits` is set if corner k is selected. All
 * corners of a valid stream are open when their cell arrives. */
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

namespace
{

/** The kinds of groups that a place may mean, the first of which that has the name counts. */
std::vector<GroupOf> kindsAt(DataPlace place)
{
  if (place == DataPlace::Cells)
  {
    return { GroupOf::Cells, GroupOf::Vertices };
  }
  return { GroupOf::Facets, GroupOf::Vertices, GroupOf::Cells };
}

/** The selection of the groups of these names: one for each kind that they have. */
std::unique_ptr<Selection> selectionOf(
  const InGroup& where, DataPlace place, const std::string& key, MeshColumns& columns)
{
  const MeshGroups& groups = columns.groups();
  const std::vector<GroupOf> kinds = kindsAt(place);
  std::map<GroupOf, std::vector<std::uint32_t>> wanted;
  for (const std::string& name : where.names)
  {
    const auto named =
      std::ranges::find_if(kinds, [&](GroupOf kind) { return !groups.find(name, kind).empty(); });
    if (named == kinds.end())
    {
      const bool isOfFacets = !groups.find(name, GroupOf::Facets).empty();
      columns.fail(key + ".group",
        whyNoGroup(name, groups) +
          (isOfFacets && key.starts_with("source") ? "; a source on facets is a flux" : ""));
    }
    for (const std::uint32_t group : groups.find(name, *named))
    {
      wanted[*named].push_back(group);
    }
  }
  std::vector<std::unique_ptr<Selection>> parts;
  const std::string names = (where.names.size() == 1 ? "the group '" : "one of the groups '") +
                            listed(where.names, "and") + "'";
  for (const auto& [kind, numbers] : wanted)
  {
    if (!columns.hasGroupColumn(kind))
    {
      columns.fail(key + ".group", names + " has no " + nameOf(kind) + " of the mesh");
    }
    const ColumnTest test{ columns.requireGroups(kind), std::nullopt, groups.setsWith(numbers),
      names };
    parts.push_back(
      kind == GroupOf::Vertices
        ? std::unique_ptr<Selection>(std::make_unique<ColumnSelection>(test, place, key, columns))
        : std::make_unique<CellSelection>(test, place, key, columns));
  }
  return parts.size() == 1 ? std::move(parts.front())
                           : std::make_unique<CombinedSelection>(
                               Combination::Kind::Any, std::move(parts), place, key, columns);
}

} // namespace

/** Checks all that is known without reading the mesh, so that a mistake is reported at once. */
std::unique_ptr<Selection> Selection::make(const Where& where, DataPlace place,
  ColumnOwner preferred, const std::string& key, MeshColumns& columns)
{
  if (std::holds_alternative<Everywhere>(where))
  {
    // No selection at all is faster than one that is true everywhere.
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
  if (const auto* group = std::get_if<InGroup>(&where))
  {
    return selectionOf(*group, place, key, columns);
  }
  if (const auto* combined = std::get_if<Combination>(&where))
  {
    std::vector<std::unique_ptr<Selection>> parts;
    for (const Where& part : combined->parts)
    {
      std::unique_ptr<Selection> made = make(part, place, preferred, key, columns);
      if (!made)
      {
        columns.fail(key, "everywhere cannot be combined with other parts");
      }
      parts.push_back(std::move(made));
    }
    return std::make_unique<CombinedSelection>(
      combined->kind, std::move(parts), place, key, columns);
  }
  // Tag and mask: a column of the vertices and one of the cells are selected in different ways. If
  // both exist, `preferred` decides.
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

/** Evaluates the selection at the vertices of the block, beside those of earlier ones that are
 * still open. */
void Selection::startBlock(const MeshBlock& block)
{
  this->select(block, this->open(block));
}

std::span<std::uint8_t> Selection::open(const MeshBlock& block)
{
  // The same object serves several readings: preparation, solve, results.
  const std::span<std::uint8_t> current = this->Open.startBlock(block);
  this->Current = current;
  return current;
}

/** A cell is selected if all its corners are. */
void Selection::atCells(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const unsigned all = (1U << cornersOf(this->Columns.cellType())) - 1U;
  forCorners(this->Columns.cellType(), cells, this->Open,
    [&](std::size_t c, unsigned bits) { selected[c] = bits == all ? 1 : 0; });
}

/** A facet is selected if all its corners are, that is, all corners of the cell except the opposite
 * one. */
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

void Selection::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  if (block.firstVertex == 0)
  {
    this->begin();
  }
  this->add(block, scratch);
}

/** Counts selected vertices, or the selected cells or facets, depending on the place of the datum:
 * vertices alone need not make up a whole cell. */
void Selection::add(const MeshBlock& block, const std::filesystem::path& /*scratch*/)
{
  this->startBlock(block);
  if (this->Place == DataPlace::Vertices)
  {
    this->Count += std::ranges::count(this->Current, 1);
    return;
  }
  const CellRange cells{ block, 0, block.corners };
  std::vector<std::uint8_t> selected(cellsOf(this->Columns.cellType(), block));
  this->Place == DataPlace::Cells ? this->atCells(cells, selected)
                                  : this->atFacets(cells, selected);
  this->Count += std::ranges::count_if(selected, [](std::uint8_t bits) { return bits != 0; });
}

/** A part of the mesh may have none of the selected items, as long as another one has some. */
void Selection::endPreparing(MeshParts* parts)
{
  if (parts)
  {
    parts->sum({ &this->Count, 1 });
  }
  this->IsWhole = !parts;
  if (this->Count == 0 && !this->MayBeEmpty)
  {
    const char* what = this->Place == DataPlace::Vertices               ? "vertex"
                       : this->Place == DataPlace::Cells                ? "cell"
                       : this->Columns.cellType() == CellType::Triangle ? "edge"
                                                                        : "face";
    this->Columns.fail(this->Key, std::string("no ") + what + " of the mesh " + this->predicate() +
                                    (parts ? "" : this->instead()));
  }
}

void Selection::checkCells(const CellRange& cells, std::span<const std::uint8_t> selected) const
{
  const std::int64_t first = cells.block.firstCell + static_cast<std::int64_t>(cells.first);
  this->HasCells =
    (first > 0 && this->HasCells) || std::ranges::find(selected, 1) != selected.end();
  const bool isLast = first + std::ssize(selected) == this->Columns.cells();
  if (isLast && !this->HasCells && this->IsWhole && !this->MayBeEmpty)
  {
    this->Columns.fail(this->Key, "no cell of the mesh has all its corners in this place");
  }
}

Selection* Selections::add(
  const Where& where, DataPlace place, ColumnOwner preferred, const std::string& key)
{
  std::unique_ptr<Selection> made = Selection::make(where, place, preferred, key, this->Columns);
  return made ? this->All.emplace_back(std::move(made)).get() : nullptr;
}

/** Only some kinds of selections do; others merely can be checked by a reading. */
bool Selections::needPreparing() const
{
  return std::ranges::any_of(
    this->All, [](const auto& selection) { return selection->needsPreparing(); });
}

void Selections::prepare(MeshSource& mesh, const std::filesystem::path& scratch,
  std::int64_t memoryLimit, const std::function<void(const MeshBlock& prepared)>& visit)
{
  this->Columns.memory().setLimit(memoryLimit);
  this->IsLimited = true;
  const auto prepareBlock = [&](const MeshBlock& block)
  {
    this->prepare(block, scratch);
    if (visit)
    {
      visit(block);
    }
  };
  if (!this->All.empty())
  {
    forCheckedBlocks(mesh, prepareBlock, true);
  }
}

void Selections::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  for (const auto& selection : this->All)
  {
    selection->prepare(block, scratch);
  }
}

void Selections::acceptEmpty()
{
  for (const auto& selection : this->All)
  {
    selection->acceptEmpty();
  }
}

/** All processes have the same selections and come here in the same order, as MeshParts requires.
 */
void Selections::endPreparing(MeshParts* parts)
{
  for (const auto& selection : this->All)
  {
    selection->endPreparing(parts);
  }
  if (this->IsLimited)
  {
    // From now on a solve counts this memory within its own limit, see Problem::bytes().
    this->Columns.memory().setLimit(INT64_MAX);
    this->IsLimited = false;
  }
}

/** Also those that nothing in this block asks for: the marks of open vertices must have no gaps. */
void Selections::startBlock(const MeshBlock& block)
{
  for (const auto& selection : this->All)
  {
    selection->startBlock(block);
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
    // Vertices are named by their numbers in the original file, which a conversion has reordered.
    columns.requireIds();
    this->Found.resize(named->ids.size());
  }
}

/** Tests each vertex by its position and its number, of which the region uses one. */
void RegionSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  const Region::Vertices* named = this->Selected.vertices();
  const Column* ids = named ? this->Columns.ids(block) : nullptr;
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    const std::int64_t id =
      ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
    // A mesh without original numbers is numbered as the stream is.
    const std::span<const double, 3> point(block.positions.data() + 3 * i, 3);
    // Most vertices are beyond a few named ones: a description may have very many such regions.
    const bool isBeyond = named && (id < named->ids.front() || id > named->ids.back());
    selected[i] = !isBeyond && this->Selected.contains(point, id) ? 1 : 0;
  }
}

void RegionSelection::begin()
{
  this->Selection::begin();
  std::ranges::fill(this->Found, 0);
}

/** Also looks for each vertex that is named by number: a region must not be smaller than it
 * says. */
void RegionSelection::add(const MeshBlock& block, const std::filesystem::path& scratch)
{
  this->Selection::add(block, scratch);
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
      // The numbers are in ascending order without repetitions, see Region.
      const auto place = std::ranges::lower_bound(named->ids, id);
      this->Found[static_cast<std::size_t>(place - named->ids.begin())] += 1;
    }
  }
}

/** Vertices on the border of several parts are counted in each of them; only 0 matters. */
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

/** In this form, the test also rejects NaN. */
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
  // For the binary search in contains().
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

/** Plain comparisons without tolerances: what is selected is reproducible. */
bool Region::contains(std::span<const double, 3> p, std::int64_t id) const
{
  // All shapes are closed sets: points exactly on their boundary are selected.
  if (const auto* half = std::get_if<HalfSpace>(&this->What))
  {
    // The normal need not have the length 1: `distance` is in the same unit as the product.
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

/** Half-spaces and sets of vertices have no natural centre. */
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
      // midpoint(): the sum of two finite coordinates may overflow.
      center[axis] = std::midpoint(box->low[axis], box->high[axis]);
    }
    return center;
  }
  return std::nullopt;
}

} // namespace smg
