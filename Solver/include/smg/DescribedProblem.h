// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class ProblemOnMesh;

/**
 * The problem of a description on a mesh stream.
 *
 *     DescribedProblem problem(description, mesh.info());
 *     problem.prepare(*mesh.source(problem.vertexColumns(), problem.cellColumns()));
 *     solve(*mesh.source(problem.vertexColumns(), problem.cellColumns()), problem);
 *
 * Vertices are named by the column OriginalId, or by their stream index if the mesh has no such
 * column. Memory holds the column values and the selections at the vertices that later cells may
 * use. The stream may be read again, from its first block.
 */
class SMG_EXPORT DescribedProblem : public Problem
{
public:
  /**
   * @param mesh the mesh that the problem is for
   * @param name what errors call the description: its file
   * @throws Error naming the place in the description if something is out of range, or the mesh has
   * no such column
   */
  DescribedProblem(const ProblemDescription& description, const StreamInfo& mesh,
    const std::string& name = "problem");
  ~DescribedProblem() override;

  /** Names of the columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once, unless the description selects no part of the mesh. Optional, except
   * where vertices are selected by a column of the cells or as the nearest ones, which only this
   * finds. Writes a nameless scratch file of one bit a vertex for each such column.
   * @param scratch folder for scratch files; empty: the system's temporary folder
   * @throws Error naming the place in the description if a part that it selects is empty or has a
   * vertex that the mesh lacks
   */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch = {});

  int columns() const override;
  Weights weights() const override;
  ConditionCounts conditionCounts() const override;
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasCells() const override;
  void cells(CellBatch& batch) override;
  bool hasFacets() const override;
  void facets(FacetBatch& batch) override;

private:
  std::unique_ptr<ProblemOnMesh> OnMesh;
};

} // namespace smg
