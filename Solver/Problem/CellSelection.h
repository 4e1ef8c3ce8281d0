// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/ColumnTest.h"
#include "Solver/Problem/Selection.h"
#include "Solver/Problem/TagValues.h"
#include "Solver/Problem/VertexSetFile.h"

#include <optional>

namespace smg
{

/** The selection by a column of the cells: cells, their vertices and their facets. In a stream,
 * vertices precede their cells: a previous reading determines the selected vertices. */
class CellSelection : public Selection
{
public:
  CellSelection(
    ColumnTest test, DataPlace place, const std::string& key, const MeshColumns& columns)
    : Selection(place, key, columns)
    , Test(std::move(test))
    , Marks(columns.memory())
  {
  }

  bool needsPreparing() const override
  {
    return this->Place == DataPlace::Vertices && !this->Vertices;
  }
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void endPreparing(MeshParts* parts) override;
  VertexSetFile* preparedVertices() override { return this->Vertices ? &*this->Vertices : nullptr; }

  void atCells(const CellRange& cells, std::span<std::uint8_t> selected) const override;
  void atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const override;

protected:
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override
  {
    return (this->Place == DataPlace::Cells ? "" : "is of a cell that ") + this->Test.predicate();
  }
  std::string instead() const override { return this->Test.value ? this->Tags.text() : ""; }

private:
  ColumnTest Test;
  TagValues Tags;                        ///< during preparation
  std::optional<VertexSetFile> Vertices; ///< of the selected cells, if requested
  OpenValues<std::uint8_t> Marks;        ///< of open vertices, during preparation
  std::int64_t Marked = 0, Written = 0;  ///< vertices read, and written to the file
};

} // namespace smg
