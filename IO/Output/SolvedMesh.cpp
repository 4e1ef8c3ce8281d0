// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Output/SolvedMesh.h"

#include "Solver/Results/RenumberExtremes.h"
#include "Solver/Stream/OriginalNumbers.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace smg
{

namespace
{

bool isOfSolve(const std::string& name)
{
  return name == SolutionName || name == GradientName || name == FluxName;
}

void append(
  const char* name, int components, std::span<const double> values, std::vector<Column>& columns)
{
  Column column{ { name, ScalarType::Float64, components }, {} };
  column.bytes.resize(values.size_bytes());
  std::memcpy(column.bytes.data(), values.data(), values.size_bytes());
  columns.push_back(std::move(column));
}

} // namespace

SolvedMesh::SolvedMesh(
  const VsmReader& mesh, Problem& problem, Solution& solution, const ResultOptions& options)
  : Source(mesh.source())
  , Results(this->Source->info(), problem, solution, options)
  , Options(options)
  , Info(this->Source->info())
  , File(mesh.path())
{
  const int columns = problem.columns();
  for (std::vector<ColumnSpec>* specs : { &this->Info.vertexColumns, &this->Info.cellColumns })
  {
    std::erase_if(*specs, [](const ColumnSpec& spec) { return isOfSolve(spec.name); });
  }
  this->Info.vertexColumns.push_back({ SolutionName, ScalarType::Float64, columns });
  if (options.gradient)
  {
    this->Info.cellColumns.push_back({ GradientName, ScalarType::Float64, 3 * columns });
  }
  if (options.flux)
  {
    this->Info.cellColumns.push_back({ FluxName, ScalarType::Float64, 3 * columns });
  }
}

bool SolvedMesh::next(MeshBlock& block)
{
  if (!this->Source->next(block))
  {
    return false;
  }
  // The problem may use the columns of an earlier solve.
  this->Results.add(block);
  for (std::vector<Column>* columns : { &block.vertexColumns, &block.cellColumns })
  {
    std::erase_if(*columns, [](const Column& column) { return isOfSolve(column.spec.name); });
  }
  const int columns = this->Info.vertexColumns.back().components;
  append(SolutionName, columns, this->Results.values(), block.vertexColumns);
  if (this->Options.gradient)
  {
    append(GradientName, 3 * columns, this->Results.gradient(), block.cellColumns);
  }
  if (this->Options.flux)
  {
    append(FluxName, 3 * columns, this->Results.flux(), block.cellColumns);
  }
  return true;
}

void SolvedMesh::finish(Report& report)
{
  this->Results.finish(report);
  if (findColumn(this->Info.vertexColumns, OriginalIdSpec) < 0)
  {
    return;
  }
  VsmReader mesh(this->File);
  Column id;
  renumberExtremes(report,
    [&](std::int64_t vertex)
    {
      mesh.readVertexColumn(OriginalIdName, vertex, 1, id);
      return id.as<std::int64_t>()[0];
    });
}

} // namespace smg
