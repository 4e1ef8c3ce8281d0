// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/ColumnTest.h"
#include "Solver/Description/Selection.h"

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

private:
  ColumnTest Test;
};

} // namespace smg
