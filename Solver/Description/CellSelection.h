// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/ColumnTest.h"
#include "Solver/Description/Selection.h"
#include "Solver/Description/VertexSetFile.h"

#include <optional>

namespace smg
{

/**
 * What a column of the cells selects: cells, and their vertices and facets. The vertices come
 * before the cells of a stream: which ones are selected is found by reading it once before.
 */
class CellSelection : public Selection
{
public:
  CellSelection(
    ColumnTest test, DataPlace place, const std::string& key, const MeshColumns& columns)
    : Selection(place, key, columns)
    , Test(std::move(test))
  {
  }

  bool needsPreparing() const override
  {
    return this->Place == DataPlace::Vertices && !this->Vertices;
  }
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void endPreparing() override;

  void atCells(const CellRange& cells, std::span<std::uint8_t> selected) const override;
  void atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const override;

protected:
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override
  {
    return (this->Place == DataPlace::Cells ? "" : "is of a cell that ") + this->Test.predicate();
  }

private:
  ColumnTest Test;
  std::optional<VertexSetFile> Vertices; ///< of the cells, if these are asked for
  OpenValues<std::uint8_t> Marks;        ///< while preparing: what is known of open vertices
  std::int64_t Marked = 0, Written = 0;  ///< vertices that have come, and are in the file
};

} // namespace smg
