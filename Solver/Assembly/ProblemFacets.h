// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "smg/Problem.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace smg
{

/** The data of a problem on the facets of its cells, queried in batches and stored until it is
 * known which facets are on the boundary. The data of an interior facet are released with its
 * second cell.
 */
class ProblemFacets
{
public:
  /** A problem without data on facets is not queried; then only facets whose corners all have the
   * same Dirichlet condition are added. */
  ProblemFacets(Pool& pool, Problem& problem, CellType type, const OpenVertices& vertices);

  /** Sets the number of vertices so far. */
  void extend(std::int64_t vertices) { this->Open.extend(vertices); }
  void release(std::int64_t first) { this->Open.release(first); }

  /** Adds the facets of the cells of the block, except for cells that use a vertex twice or are
   * flagged as duplicates. Throws Error if a value is invalid. */
  void add(const MeshBlock& block);

  /** The facets so far. */
  const OpenFacets& open() const { return this->Open; }

  /** Excludes interior facets whose second cell belongs to another part of the mesh, unless they
   * have conditions of their own. */
  void exclude(FacetSet facets) { this->Excluded = std::move(facets); }

  /** Calls found(facet, area) for each boundary facet whose lowest corner is `vertex`, which is
   * final, with its length or area, then for each inner one with conditions; the pointers of the
   * facet are valid during the call. Throws Error if a value is invalid. */
  template <class Found>
  void take(std::int64_t vertex, Found&& found)
  {
    this->Open.take(vertex,
      [&](std::int64_t middle, std::int64_t high, std::int32_t record)
      {
        const BoundaryFacet facet = this->facet(vertex, middle, high, record);
        if (!this->isExcluded(facet))
        {
          found(facet, this->areaOf(facet));
        }
        else if (const std::int32_t inside = this->insideOf(record); inside > 0)
        {
          found(this->innerFacet(vertex, middle, high, inside), this->areaOf(facet));
        }
        this->forget(record);
      });
    const auto inner = this->Inner.find(vertex);
    if (inner == this->Inner.end())
    {
      return;
    }
    for (const InnerFacet& kept : inner->second)
    {
      const BoundaryFacet facet = this->innerFacet(vertex, kept.middle, kept.high, kept.record);
      found(facet, this->areaOf(facet));
      this->forget(kept.record);
    }
    this->Inner.erase(inner);
  }

private:
  static constexpr std::size_t BatchCells = 64;

  void ask(const MeshBlock& block, std::size_t first, std::size_t cells);
  void addCell(const std::int64_t* corner, std::int64_t cell, std::size_t c);
  bool mayHaveWanted(const std::int64_t* corner) const;
  bool isWanted(const std::int64_t* vertex) const;
  /** What the problem has set on the facets of a batch. */
  struct BatchValues
  {
    std::vector<std::int32_t> flux, robin;
    std::vector<double> fluxValue, coefficient, ambient;

    bool hasAny(std::size_t facet) const
    {
      return this->flux[facet] >= 0 || this->robin[facet] >= 0;
    }
  };
  FacetBatch start(
    BatchValues& values, const MeshBlock& block, std::size_t first, std::size_t cells) const;
  std::int32_t keep(
    const int* order, const std::int64_t* corner, int k, std::size_t facet, std::int64_t cell);
  std::int32_t keep(const BatchValues* values, const int* order, const std::int64_t* vertices,
    std::size_t facet, std::int64_t cell);
  bool hasTied(const std::int64_t* corner) const;
  void requireApart(
    const CellFacet& facet, std::int32_t first, std::int32_t second, std::int64_t cell) const;
  void require(const BoundaryFacet& facet, std::int64_t name) const;
  BoundaryFacet facet(
    std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t record) const;
  bool isExcluded(const BoundaryFacet& facet) const;
  /** The record of the conditions that hold if the facet is between cells; 0: none. */
  std::int32_t insideOf(std::int32_t record) const
  {
    return record > 0 ? this->Records[record].inside : 0;
  }
  BoundaryFacet innerFacet(
    std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t record) const
  {
    BoundaryFacet facet = this->facet(low, middle, high, record);
    facet.isInner = true;
    return facet;
  }
  void keepInside(const CellFacet& facet, std::int32_t record);
  double areaOf(const BoundaryFacet& facet) const;
  /** Releases the record, but not what holds inside. */
  void drop(std::int32_t record);
  /** Releases the record and what holds inside. */
  void forget(std::int32_t record)
  {
    this->drop(this->insideOf(record));
    this->drop(record);
  }

  Problem& Given;
  const OpenVertices& Vertices;
  CellType Type;
  bool Asks, AsksInside;
  std::size_t Columns, Corners; // Corners: of a facet
  ConditionCounts Counts;
  OpenFacets Open;
  FacetSet Excluded;
  struct InnerFacet
  {
    std::int64_t middle, high;
    std::int32_t record;
  };
  /** Facets of two cells or more with conditions, by their lowest corner, which is open. */
  std::map<std::int64_t, std::vector<InnerFacet>> Inner;
  /** What is stored of a facet that has conditions or tied corners. */
  struct Record
  {
    std::int32_t flux, robin; ///< its conditions; -1: none
    std::int32_t values;      ///< in Values; 0: it has no conditions
    std::int32_t vertices;    ///< in Placed: where its corners are; 0: where they are stated
    std::int32_t inside;      ///< the record of the conditions that hold between cells; 0: none
    std::int64_t cell;        ///< its index in the original file, or -1 minus that in the stream
  };
  FreeList<Record> Records;
  FreeList<double> Values; ///< fluxes, coefficients and ambient values at the corners
  FreeList<std::array<std::int64_t, 3>> Placed;
  // The block.
  const Column* CellIds = nullptr;
  std::int64_t FirstCell = 0;
  // The batch.
  BatchValues Asked, AskedInside;
};

} // namespace smg
