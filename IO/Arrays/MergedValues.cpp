// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/MergedValues.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Core/Rounded.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace smg
{
namespace
{

class MergedValues
{
public:
  MergedValues(const StoredMesh& mesh, std::shared_ptr<const OriginalOrder> order,
    Solution& solution, std::vector<ColumnSpec> columns, const ProgressFunction& progress)
    : Order(std::move(order))
    , Columns(std::move(columns))
    , Stride(static_cast<std::size_t>(solution.columns()))
  {
    for (const MergedRow& merged : this->Order->merged())
    {
      this->Kept.push_back(merged.kept);
    }
    std::ranges::sort(this->Kept);
    this->Kept.erase(std::ranges::unique(this->Kept).begin(), this->Kept.end());
    this->Values.resize(this->Kept.size() * this->Stride);
    const OriginalRows& places = this->Order->vertices();
    std::vector<std::int64_t> rows;
    std::vector<double> numbers;
    visitBlocks(*mesh.source(places.columns(), {}), progress, 0.0, 1.0,
      [&](const MeshBlock& block)
      {
        rows.clear();
        places.append(block, rows);
        numbers.resize(rows.size() * this->Stride);
        solution.read(block.firstVertex, block.vertices(), numbers);
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
          const auto found = std::ranges::lower_bound(this->Kept, rows[i]);
          if (found != this->Kept.end() && *found == rows[i])
          {
            std::copy_n(numbers.data() + i * this->Stride, this->Stride,
              this->Values.data() + this->placeOf(rows[i]));
          }
        }
      });
  }

  /** `first`: the number among the vertices of no cell of the first of these. */
  void change(std::int64_t first, IsolatedVertices& vertices) const
  {
    const std::vector<MergedRow>& merged = this->Order->merged();
    for (std::size_t i = 0; i < vertices.ids.size(); ++i)
    {
      const std::int64_t row =
        this->Order->isolatedRow(first + static_cast<std::int64_t>(i), vertices.ids[i]);
      const auto found = std::ranges::lower_bound(merged, row, {}, &MergedRow::row);
      if (found != merged.end() && found->row == row)
      {
        this->put(this->Values.data() + this->placeOf(found->kept), i, vertices);
      }
    }
  }

private:
  /** Where the values of a vertex in this row begin. */
  std::size_t placeOf(std::int64_t row) const
  {
    const auto found = std::ranges::lower_bound(this->Kept, row);
    return static_cast<std::size_t>(found - this->Kept.begin()) * this->Stride;
  }

  void put(const double* numbers, std::size_t vertex, IsolatedVertices& vertices) const
  {
    for (const ColumnSpec& spec : this->Columns)
    {
      const auto components = static_cast<std::size_t>(spec.components);
      const auto column = std::ranges::find(vertices.columns, spec.name,
        [](const Column& own) -> const std::string& { return own.spec.name; });
      if (spec == PositionSpec)
      {
        std::copy_n(numbers, components, vertices.positions.data() + 3 * vertex);
      }
      else if (column != vertices.columns.end())
      {
        dispatch(column->spec.type,
          [&]<class T>(T)
          {
            for (std::size_t k = 0; k < components; ++k)
            {
              column->template as<T>()[vertex * components + k] = rounded<T>(numbers[k]);
            }
          });
      }
      numbers += components;
    }
  }

  std::shared_ptr<const OriginalOrder> Order;
  std::vector<ColumnSpec> Columns;
  std::size_t Stride;
  std::vector<std::int64_t> Kept; ///< rows of vertices with which points were merged, ascending
  std::vector<double> Values;     ///< of the solution there
};

} // namespace

CompleteIsolated mergedValues(const StoredMesh& mesh,
  const std::shared_ptr<const OriginalOrder>& order, Solution& solution,
  const std::vector<ColumnSpec>& columns, const ProgressFunction& progress)
{
  if (order->merged().empty())
  {
    return {};
  }
  const auto values =
    std::make_shared<const MergedValues>(mesh, order, solution, columns, progress);
  return [values](std::int64_t first, IsolatedVertices& vertices)
  { values->change(first, vertices); };
}

} // namespace smg
