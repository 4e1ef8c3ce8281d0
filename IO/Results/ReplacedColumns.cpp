// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Rounded.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** The names of the columns of a mesh that are neither replaced nor dropped. */
std::vector<std::string> otherNames(const std::vector<ColumnSpec>& specs,
  const std::vector<ColumnSpec>& replaced, const std::vector<std::string>& dropped)
{
  std::vector<std::string> names;
  for (const ColumnSpec& spec : specs)
  {
    if (std::ranges::find(replaced, spec.name, &ColumnSpec::name) == replaced.end() &&
        std::ranges::find(dropped, spec.name) == dropped.end())
    {
      names.push_back(spec.name);
    }
  }
  return names;
}

} // namespace

struct ReplacedColumns::Implementation
{
  std::unique_ptr<MeshSource> source;
  Solution& solution;
  std::vector<ColumnSpec> columns;
  StreamInfo info;
  std::vector<double> values;

  /** Copies components `first` and following of each vertex. */
  void fill(Column& column, std::size_t vertices, std::size_t first)
  {
    const auto stride = static_cast<std::size_t>(this->solution.columns());
    const auto components = static_cast<std::size_t>(column.spec.components);
    column.resize(vertices);
    dispatch(column.spec.type,
      [&]<class T>(T)
      {
        const std::span<T> out = column.as<T>();
        for (std::size_t i = 0; i < vertices; ++i)
        {
          for (std::size_t c = 0; c < components; ++c)
          {
            out[i * components + c] = rounded<T>(this->values[i * stride + first + c]);
          }
        }
      });
  }
};

ReplacedColumns::ReplacedColumns(const StoredMesh& mesh, Solution& solution,
  std::vector<ColumnSpec> columns, const std::vector<std::string>& dropped)
{
  const StreamInfo& info = mesh.info();
  int components = 0;
  for (const ColumnSpec& spec : columns)
  {
    components += spec.components;
  }
  if (solution.vertices() != info.vertices || solution.columns() != components)
  {
    throw Error("a solution of " + std::to_string(solution.columns()) + " columns for " +
                std::to_string(solution.vertices()) + " vertices does not fit a mesh of " +
                std::to_string(info.vertices) + " vertices and columns of " +
                std::to_string(components) + " components: it is that of another mesh.");
  }
  auto source =
    mesh.source(otherNames(info.vertexColumns, columns, dropped), columnNames(info.cellColumns));
  StreamInfo result = source->info();
  result.vertexColumns.insert(result.vertexColumns.end(), columns.begin(), columns.end());
  this->Self.reset(
    new Implementation{ std::move(source), solution, std::move(columns), std::move(result), {} });
}

ReplacedColumns::~ReplacedColumns() = default;

const StreamInfo& ReplacedColumns::info() const
{
  return this->Self->info;
}

bool ReplacedColumns::next(MeshBlock& block)
{
  Implementation& self = *this->Self;
  if (!self.source->next(block))
  {
    return false;
  }
  const auto vertices = static_cast<std::size_t>(block.vertices());
  self.values.resize(vertices * static_cast<std::size_t>(self.solution.columns()));
  self.solution.read(block.firstVertex, block.vertices(), self.values);
  std::size_t first = 0;
  for (const ColumnSpec& spec : self.columns)
  {
    block.vertexColumns.push_back({ spec, {} });
    self.fill(block.vertexColumns.back(), vertices, first);
    first += static_cast<std::size_t>(spec.components);
  }
  return true;
}

} // namespace smg
