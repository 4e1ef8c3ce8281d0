// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Problem/Selection.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace smg
{

/**
 * Several selections together: vertex by vertex, cell by cell, facet by facet.
 *
 * Vertices of parts that a reading of the stream finds beforehand are combined after it, in a
 * scratch file of a bit a vertex. That nothing is selected is not found out for cells and facets if
 * a part is the boundary or the nearest vertices.
 */
class CombinedSelection : public Selection
{
public:
  CombinedSelection(Combination::Kind kind, std::vector<std::unique_ptr<Selection>> parts,
    DataPlace place, const std::string& key, const MeshColumns& columns);

  bool needsPreparing() const override;
  void endPreparing(MeshParts* parts) override;
  VertexSetFile* preparedVertices() override { return this->Vertices ? &*this->Vertices : nullptr; }

  void atCells(const CellRange& cells, std::span<std::uint8_t> selected) const override;
  void atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const override;
  /** Facets of a group are so with others, too; what is not selected is not stated as a facet. */
  void atInnerFacets(const CellRange& cells, std::span<std::uint8_t> selected) const override;

protected:
  void begin() override;
  void add(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override;

private:
  struct Part
  {
    std::unique_ptr<Selection> selection;
    bool isLate;                                       ///< whether it is known only after a reading
    std::unique_ptr<VertexSetFile> vertices = nullptr; ///< of one that is not, until others are
  };

  /** Combines what `get` returns of each part; a bit of `all` is set where something can be. */
  void combine(std::span<std::uint8_t> selected, std::uint8_t all, auto get) const;
  void combineVertices();

  Combination::Kind How;
  std::vector<Part> Parts;
  bool IsLate;                           ///< whether any part is
  std::int64_t Read = 0;                 ///< vertices, during preparation
  std::optional<VertexSetFile> Vertices; ///< after preparation, if it is late
  std::filesystem::path Scratch;
  mutable std::vector<std::uint8_t> OfPart;
};

} // namespace smg
