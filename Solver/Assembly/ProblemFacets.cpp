// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/ProblemFacets.h"

#include "Solver/Assembly/Facets.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Mesh/VisitCells.h"
#include "smg/CellWeights.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The data of a problem on the facets of its cells (edges of triangles, faces of tetrahedra).
// Whether a facet is on the boundary is known only when its lowest vertex is final, so its data are
// stored until then. A second cell shows that the facet is interior, and releases its data at once:
// what is stored are the facets of open vertices, and the data of those facets that have a
// condition and only one cell so far. What the problem states for facets between cells is stored
// beside it, since nothing tells at first which of both will hold, and then until the lowest vertex
// is final, once.
//
// Data are stored in ascending order of the corners, which is the same in both cells of a facet.
// The boundary facets of a vertex are found in the order in which the stream first had them, so
// that sums over them do not depend on blocks.

namespace smg
{

ProblemFacets::ProblemFacets(
  Pool& pool, Problem& problem, CellType type, const OpenVertices& vertices)
  : Given(problem)
  , Vertices(vertices)
  , Type(type)
  , Asks(problem.hasFacets())
  , AsksInside(Asks && problem.hasInnerFacets())
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Corners(static_cast<std::size_t>(BoundaryFacet::cornersOf(type)))
  , Counts(problem.conditionCounts())
  , Open(pool)
  , Records(pool)
  , Values(pool, static_cast<int>(this->Corners * (1 + 2 * this->Columns)))
  , Placed(pool)
{
}

void ProblemFacets::add(const MeshBlock& block)
{
  const std::size_t cells = cellsOf(this->Type, block);
  // Original indices of the cells, for messages: the block is gone when a facet is found to be on
  // the boundary.
  const std::ptrdiff_t ids = findColumn(block.cellColumns, OriginalCellIdSpec);
  this->CellIds = ids < 0 ? nullptr : &block.cellColumns[static_cast<std::size_t>(ids)];
  this->FirstCell = block.firstCell;
  for (std::size_t first = 0; first < cells; first += BatchCells)
  {
    const std::size_t count = std::min(BatchCells, cells - first);
    if (this->Asks)
    {
      this->ask(block, first, count);
    }
    forCellRange(this->Type, block, first, first + count,
      [&](const std::int64_t* corners, unsigned flags, std::size_t c)
      {
        // A duplicate would turn the boundary facets of its original into interior ones.
        if (isDistinctCell(corners, cornersOf(this->Type), flags))
        {
          this->addCell(corners, block.firstCell + static_cast<std::int64_t>(c), c - first);
        }
      });
  }
}

/** Queries the problem for the facets of cells [first, first + cells) of the block. */
void ProblemFacets::ask(const MeshBlock& block, std::size_t first, std::size_t cells)
{
  FacetBatch batch = this->start(this->Asked, block, first, cells);
  this->Given.facets(batch);
  if (this->AsksInside)
  {
    FacetBatch inside = this->start(this->AskedInside, block, first, cells);
    this->Given.innerFacets(inside);
  }
}

/** A batch of these cells without conditions. */
FacetBatch ProblemFacets::start(
  BatchValues& values, const MeshBlock& block, std::size_t first, std::size_t cells) const
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const std::size_t facets = cells * corners;
  values.flux.assign(facets, -1);
  values.robin.assign(facets, -1);
  values.fluxValue.assign(facets * this->Corners * this->Columns, 0.0);
  values.coefficient.assign(facets * this->Corners, 0.0);
  values.ambient.assign(facets * this->Corners * this->Columns, 0.0);
  return { this->Type, block, first,
    std::span(block.corners).subspan(first * corners, cells * corners), values.flux,
    values.fluxValue, values.robin, values.coefficient, values.ambient };
}

/** Adds the facets of a cell, number `c` of the batch. */
void ProblemFacets::addCell(const std::int64_t* corner, std::int64_t cell, std::size_t c)
{
  const int corners = cornersOf(this->Type);
  if (!(this->Asks || this->mayHaveWanted(corner)))
  {
    return;
  }
  std::int64_t nodes[4] = {};
  std::transform(corner, corner + corners, nodes,
    [this](std::int64_t vertex) { return this->Vertices.ties.node(vertex); });
  for (int k = 0; k < corners; ++k)
  {
    // Facet k is opposite to corner k, so that a cell has as many facets as corners.
    const CellFacet sorted = facetOf(this->Type, nodes, k);
    if (!this->Asks && !this->isWanted(sorted.vertex))
    {
      continue;
    }
    const std::size_t facet = c * static_cast<std::size_t>(corners) + static_cast<std::size_t>(k);
    const std::int32_t record = this->keep(sorted.order, corner, k, facet, cell);
    const std::int32_t before =
      this->Open.add(sorted.vertex[0], sorted.vertex[1], sorted.vertex[2], record);
    if (before != OpenFacets::Fresh && this->Vertices.ties.any())
    {
      this->requireApart(sorted, before, record, cell);
    }
    // A second cell has the facet: it is interior, and of neither cell's data more is needed than
    // what holds there. A third one gets 0, for no data, from add().
    for (const std::int32_t kept : { before, record })
    {
      if (before != OpenFacets::Fresh && kept > 0)
      {
        this->keepInside(sorted, this->insideOf(kept));
        this->drop(kept);
      }
    }
  }
}

/** Throws Error if two facets with the same nodes are not copies of each other: a period that is as
 * short as two cells has such ones. */
void ProblemFacets::requireApart(
  const CellFacet& facet, std::int32_t first, std::int32_t second, std::int64_t cell) const
{
  int equal = 0;
  for (std::size_t e = 0; e < this->Corners; ++e)
  {
    const auto vertexOf = [&](std::int32_t record)
    {
      const std::int32_t placed = record > 0 ? this->Records[record].vertices : 0;
      return placed > 0 ? this->Placed[placed][e] : facet.vertex[e];
    };
    equal += vertexOf(first) == vertexOf(second) ? 1 : 0;
  }
  if (equal > 0 && equal < static_cast<int>(this->Corners))
  {
    throw Error("periodic: there are fewer than three cells from one side to the other at cell " +
                std::to_string(cell) + ": use a finer mesh, or repeat the body");
  }
}

/** Keeps the record of an inner facet, the one that came first; 0: none. */
void ProblemFacets::keepInside(const CellFacet& facet, std::int32_t record)
{
  if (record == 0)
  {
    return;
  }
  std::vector<InnerFacet>& ofVertex = this->Inner[facet.vertex[0]];
  const bool isKnown = std::ranges::any_of(ofVertex, [&facet](const InnerFacet& known)
    { return known.middle == facet.vertex[1] && known.high == facet.vertex[2]; });
  if (isKnown)
  {
    this->forget(record);
    return;
  }
  ofVertex.push_back({ facet.vertex[1], facet.vertex[2], record });
}

void ProblemFacets::drop(std::int32_t record)
{
  if (record == 0)
  {
    return;
  }
  const Record& dropped = this->Records[record];
  if (dropped.values > 0)
  {
    this->Values.give(dropped.values);
  }
  if (dropped.vertices > 0)
  {
    this->Placed.give(dropped.vertices);
  }
  this->Records.give(record);
}

/** Whether enough corners of a cell are prescribed for one of its facets to be wanted: a quick
 * test, which spares most cells the sorting of their facets. */
bool ProblemFacets::mayHaveWanted(const std::int64_t* corner) const
{
  std::size_t known = 0;
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    known += this->Vertices.dirichlet[corner[k]] >= 0 ? 1 : 0;
  }
  return known >= this->Corners;
}

/** Whether all corners of a facet have the same Dirichlet condition. */
bool ProblemFacets::isWanted(const std::int64_t* vertex) const
{
  const std::int32_t condition = this->Vertices.dirichlet[vertex[0]];
  return condition >= 0 &&
         std::all_of(vertex + 1, vertex + this->Corners,
           [&](std::int64_t v) { return this->Vertices.dirichlet[v] == condition; });
}

bool ProblemFacets::hasTied(const std::int64_t* vertices) const
{
  return this->Vertices.ties.any() &&
         std::any_of(vertices, vertices + this->Corners,
           [this](std::int64_t vertex) { return this->Vertices.ties.isTied(vertex); });
}

/** Stores facet number `facet` of the batch, and returns its record; 0 if it has no condition and
 * no tied corner. It is opposite to corner k of its cell. `order`: see CellFacet. */
std::int32_t ProblemFacets::keep(
  const int* order, const std::int64_t* corner, int k, std::size_t facet, std::int64_t cell)
{
  std::int64_t vertices[3] = {};
  std::copy_if(corner, corner + cornersOf(this->Type), vertices,
    [opposite = corner[k]](std::int64_t vertex) { return vertex != opposite; });
  const bool isInside = this->AsksInside && this->AskedInside.hasAny(facet);
  const bool hasConditions = isInside || (this->Asks && this->Asked.hasAny(facet));
  if (!hasConditions && !this->hasTied(vertices))
  {
    return 0;
  }
  const std::int32_t record =
    this->keep(hasConditions ? &this->Asked : nullptr, order, vertices, facet, cell);
  if (isInside)
  {
    const std::int32_t inside = this->keep(&this->AskedInside, order, vertices, facet, cell);
    this->Records[record].inside = inside;
  }
  return record;
}

/** `values`: null: it has no condition. */
std::int32_t ProblemFacets::keep(const BatchValues* values, const int* order,
  const std::int64_t* vertices, std::size_t facet, std::int64_t cell)
{
  Record record{ -1, -1, 0, 0, 0, 0 };
  record.cell =
    this->CellIds ? this->CellIds->as<std::int64_t>()[cell - this->FirstCell] : -1 - cell;
  if (this->Vertices.ties.any())
  {
    record.vertices = this->Placed.take();
    std::transform(order, order + this->Corners, this->Placed[record.vertices].begin(),
      [vertices](int e) { return vertices[e]; });
  }
  if (values)
  {
    record.flux = values->flux[facet];
    record.robin = values->robin[facet];
    if (record.flux >= this->Counts.flux || record.robin >= this->Counts.robin)
    {
      throw Error("a facet of cell " + std::to_string(cell) +
                  " names a condition that the problem does not have: see conditionCounts");
    }
    record.values = this->Values.take();
    double* kept = this->Values.at(record.values);
    const auto copy = [&](const std::vector<double>& numbers, std::size_t each)
    {
      for (std::size_t e = 0; e < this->Corners; ++e, kept += each)
      {
        const std::size_t corner = facet * this->Corners + static_cast<std::size_t>(order[e]);
        std::copy_n(numbers.data() + corner * each, each, kept);
      }
    };
    copy(values->fluxValue, this->Columns);
    copy(values->coefficient, 1);
    copy(values->ambient, this->Columns);
  }
  const std::int32_t slot = this->Records.take();
  this->Records[slot] = record;
  return slot;
}

/** Checks the data of a boundary facet. Those of interior facets are not used, and may be anything.
 */
void ProblemFacets::require(const BoundaryFacet& facet, std::int64_t name) const
{
  const auto finite = [](const double* values, std::size_t count) {
    return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
  };
  const std::string where =
    " on the boundary of cell " + (name >= 0 ? nameOfRow(name, true) : nameOfRow(-1 - name, false));
  if (facet.flux >= 0 && !finite(facet.fluxValue, this->Corners * this->Columns))
  {
    throw Error("flux[" + std::to_string(facet.flux) + "]: is not a finite number" + where);
  }
  const bool negative =
    facet.robin >= 0 && std::any_of(facet.coefficient, facet.coefficient + this->Corners,
                          [](double value) { return !(value >= 0.0); });
  if (facet.robin >= 0 && (negative || !finite(facet.coefficient, this->Corners) ||
                            !finite(facet.ambient, this->Corners * this->Columns)))
  {
    throw Error("robin[" + std::to_string(facet.robin) +
                "]: the coefficient and the ambient value must be finite numbers, the coefficient "
                "not negative," +
                where);
  }
}

/** The facet with pointers to its values, whose record the caller releases after use. */
BoundaryFacet ProblemFacets::facet(
  std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t record) const
{
  BoundaryFacet facet{ { low, middle, high } };
  if (record == 0)
  {
    return facet;
  }
  const Record& kept = this->Records[record];
  if (kept.vertices > 0)
  {
    std::copy_n(this->Placed[kept.vertices].begin(), this->Corners, facet.vertices);
  }
  if (kept.values > 0)
  {
    facet.flux = kept.flux;
    facet.robin = kept.robin;
    facet.fluxValue = this->Values.at(kept.values);
    facet.coefficient = facet.fluxValue + this->Corners * this->Columns;
    facet.ambient = facet.coefficient + this->Corners;
    this->require(facet, kept.cell);
  }
  return facet;
}

bool ProblemFacets::isExcluded(const BoundaryFacet& facet) const
{
  const std::int64_t third = this->Type == CellType::Triangle ? 0 : facet.corners[2];
  return this->Excluded.contains({ facet.corners[0], facet.corners[1], third });
}

double ProblemFacets::areaOf(const BoundaryFacet& facet) const
{
  const double* points[3] = {};
  for (std::size_t k = 0; k < this->Corners; ++k)
  {
    points[k] = this->Vertices.points.at(facet.vertices[k]);
  }
  return facetArea(this->Type, points);
}

} // namespace smg
