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
 * Vertices are identified by the column OriginalId, or by their stream index if the mesh has no
 * such column. The column values and the selections are held in memory only at vertices that later
 * cells may use. The stream may be read repeatedly, from its first block.
 */
class SMG_EXPORT DescribedProblem : public Problem
{
public:
  /**
   * @param mesh the mesh of the problem
   * @param name the name of the description in error messages: its file
   * @throws Error with the place in the description if a value is out of range, or the mesh has no
   * such column
   */
  DescribedProblem(const ProblemDescription& description, const StreamInfo& mesh,
    const std::string& name = "problem");
  ~DescribedProblem() override;

  /** Names of the columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once if the description selects parts of the mesh. Optional unless vertices
   * are selected by a column of the cells or as nearest vertices, which is determined here. Writes
   * an unnamed scratch file with one bit per vertex for each such column.
   * @param scratch folder for scratch files; empty: the system's temporary folder
   * @throws Error with the place in the description if a selected part is empty or refers to a
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
