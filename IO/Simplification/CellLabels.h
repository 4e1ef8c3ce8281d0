// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** A label in the row of a triangle. */
struct LabelPlace
{
  std::size_t begin, bytes;
};

/** Finds the columns of the cells that are labels, whose borders a simplification holds: those of
 * one integer that have at least two values, at most MostLabels, and on average one for at least
 * CellsOfLabel cells; so the numbers of cells are none. Nor are values that change at more than one
 * of ChangeCells cells of the stream, as grey values or grades: most edges would be borders. */
class CellLabels
{
public:
  static constexpr std::size_t MostLabels = 1024;
  static constexpr std::int64_t CellsOfLabel = 4, ChangeCells = 3;

  /** `columns`: those whose tuples follow one another in the row of a triangle. `pool` accounts for
   * the values. */
  CellLabels(const std::vector<ColumnSpec>& columns, Pool& pool);

  /** Adds the cells of the next block. */
  void add(const MeshBlock& block);
  /** The labels, as far as the cells that were added tell. */
  std::vector<LabelPlace> places() const;
  /** The columns of integers that have too many values, or values that change too often. */
  std::vector<std::string> others() const;

  /** The surfaces whose areas are compared. */
  enum Surface : std::uint8_t
  {
    Given,
    Simplified
  };
  /** Adds a triangle, by its row, to the area that its labels have on a surface. */
  void addArea(Surface surface, const std::byte* row, double area);
  /** The labels of a column whose shares of the area the two surfaces do not have in common. */
  struct Changes
  {
    std::string column;
    std::int64_t labels = 0;
    std::int64_t lost = 0;    ///< with no triangle of the simplified surface
    std::int64_t changed = 0; ///< others, by more than Tolerance
  };
  /** The columns with such labels. */
  std::vector<Changes> changes() const;
  static constexpr double Tolerance = 0.2; ///< of the share on the given surface

private:
  struct Integers
  {
    std::string name;
    LabelPlace place;
    std::vector<std::uint64_t> values;          ///< the bytes of each, ascending
    std::vector<std::array<double, 2>> areas{}; ///< of each value on the surfaces
    bool hasMore = false;                       ///< than MostLabels values
    std::optional<std::uint64_t> last{};        ///< of the last cell
    std::int64_t changes = 0;                   ///< from one cell to the next
  };

  bool areLabels(const Integers& column) const
  {
    return !column.hasMore && ChangeCells * column.changes <= this->Cells &&
           CellsOfLabel * static_cast<std::int64_t>(column.values.size()) <= this->Cells;
  }

  std::vector<Integers> Columns;
  std::int64_t Cells = 0;
};

} // namespace smg
