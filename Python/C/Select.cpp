// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/ReadColumn.h"
#include "IO/Description/ParseDescriptions.h"
#include "IO/Files/PartialProgress.h"
#include "Python/C/Call.h"
#include "Python/C/Handles.h"
#include "Python/C/Options.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/DescribedProblem.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{
namespace
{

/** Marks the vertices with a Dirichlet condition, by their rows in the original order. */
void markFixed(const smg_mesh& mesh, const ProblemDescription& description,
  const ProgressFunction& progress, std::span<std::uint8_t> selected)
{
  const StoredMesh& stored = mesh.stored();
  const ConversionOptions& opened = mesh.shared->options();
  DescribedProblem problem(description, stored.info(), "region");
  const auto order = mesh.shared->order(partOf(progress, 0.0, 0.2));
  const OriginalRows& places = order->vertices();
  problem.acceptEmpty(); // it may be a part of what the caller combines
  problem.prepare(*stored.source(problem.vertexColumns(), problem.cellColumns()), opened.scratch);

  std::vector<std::string> columns = problem.vertexColumns();
  for (const std::string& name : places.columns())
  {
    if (std::ranges::find(columns, name) == columns.end())
    {
      columns.push_back(name);
    }
  }
  std::vector<std::int64_t> rows;
  visitBlocks(*stored.source(columns, problem.cellColumns()), progress, 0.2, 1.0,
    [&](const MeshBlock& block)
    {
      const auto count = static_cast<std::size_t>(block.vertices());
      VertexConditions conditions;
      conditions.dirichlet.assign(count, -1);
      conditions.value.assign(count, 0.0);
      conditions.source.assign(count, 0.0);
      conditions.screening.assign(count, 0.0);
      problem.conditions(block, conditions);
      rows.clear();
      places.append(block, rows);
      for (std::size_t i = 0; i < count; ++i)
      {
        selected[static_cast<std::size_t>(rows[i])] = conditions.dirichlet[i] >= 0 ? 1 : 0;
      }
    });
  fillMerged(*order, { "selected", ScalarType::UInt8, 1 }, std::as_writable_bytes(selected).data());
}

void select(
  const smg_mesh& mesh, const char* where, const ProgressFunction& progress, std::uint8_t* selected)
{
  nlohmann::json entry = optionsText(where, "region");
  mesh.shared->requireRows(entry, partOf(progress, 0.0, 0.1));
  const ProblemDescription description = argument(
    [&]
    {
      entry["value"] = 0;
      const nlohmann::json json = { { "dirichlet", nlohmann::json::array({ entry }) } };
      return parseProblem(JsonNode(json, "region"));
    });
  const auto vertices = static_cast<std::size_t>(mesh.shared->vertices());
  std::fill_n(selected, vertices, std::uint8_t(0));
  try
  {
    markFixed(mesh, description, partOf(progress, 0.1, 1.0), { selected, vertices });
  }
  catch (const Error& error)
  {
    // The condition that stands for the region is nothing that the caller knows.
    constexpr std::string_view Condition = "dirichlet[0].";
    std::string message = error.what();
    const std::size_t place = message.find(Condition);
    if (place == std::string::npos)
    {
      throw;
    }
    throw ArgumentError(message.erase(place, Condition.size()));
  }
}

} // namespace
} // namespace smg

smg_status smg_select(
  smg_mesh* mesh, const char* where, smg_progress progress, void* user, uint8_t* selected)
{
  return smg::guarded(
    [&]
    {
      smg::select(smg::required(mesh, "mesh"), &smg::required(where, "where"),
        smg::progressOf(progress, user), &smg::required(selected, "selected"));
    });
}
