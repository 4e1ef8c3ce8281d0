// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/ColumnTest.h"
#include "Solver/Problem/Selection.h"
#include "Solver/Problem/TagValues.h"

namespace smg
{

/** The selection by a column of the vertices. */
class ColumnSelection : public Selection
{
public:
  ColumnSelection(
    ColumnTest test, DataPlace place, const std::string& key, const MeshColumns& columns)
    : Selection(place, key, columns)
    , Test(std::move(test))
  {
  }

  void prepare(const MeshBlock& block, const std::filesystem::path& scratch) override
  {
    this->Selection::prepare(block, scratch);
    this->Tags.add(this->Test.column.in(block), this->atVertices());
  }

protected:
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override
  {
    const std::size_t valid = this->Test.apply(this->Test.column.in(block), 0, selected);
    if (valid < selected.size())
    {
      this->Columns.fail(
        this->Key + ".mask", "is not a number at " + this->Columns.vertexName(block, valid));
    }
  }
  std::string predicate() const override { return this->Test.predicate(); }
  std::string instead() const override { return this->Test.value ? this->Tags.text() : ""; }

private:
  ColumnTest Test;
  TagValues Tags; ///< during preparation
};

} // namespace smg
