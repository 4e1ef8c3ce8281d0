// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class MeshParts;

/**
 * The problem of a ProblemDescription on a mesh stream.
 *
 *     DescribedProblem problem(description, mesh.info());
 *     problem.prepare(*mesh.source(problem.vertexColumns(), problem.cellColumns()));
 *     solve(*mesh.source(problem.vertexColumns(), problem.cellColumns()), problem);
 *
 * Vertices are numbered by the column OriginalId (int64), or by their stream index if the mesh has
 * no such column. Only the column values and selections at vertices that later cells may use are
 * kept in memory. The stream may be read again, from its first block.
 */
class SMG_EXPORT DescribedProblem : public Problem
{
public:
  /**
   * Checks the description against the mesh.
   * @param description the problem
   * @param mesh the mesh that the problem is for
   * @param name what error messages call the description, for instance its file
   * @throws Error naming the place in the description if a value is out of range, a region is not
   * valid, or the mesh lacks a column or has it with another number of components
   */
  DescribedProblem(const ProblemDescription& description, const StreamInfo& mesh,
    const std::string& name = "problem");
  ~DescribedProblem() override;

  /** Names of the vertex columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;
  /** Names of the cell columns that the mesh source must deliver. */
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once, unless the description selects no part of the mesh, and checks that no
   * selection is empty. Required only where vertices are selected by a cell column, as the
   * nearest ones or as the boundary; optional otherwise. Writes an unnamed scratch file of one bit
   * a vertex for each cell column that selects, and for each boundary.
   * @param mesh the stream, from its first block
   * @param scratch folder for scratch files; empty: the system's temporary folder
   * @param memoryLimit as in SolveOptions; 1 GiB by default
   * @throws Error naming the place in the description if it selects nothing or names a vertex that
   * the mesh lacks; naming the memory that is needed if the limit does not suffice
   */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch = {},
    std::int64_t memoryLimit = std::int64_t(1) << 30);
  /** That a condition holds nowhere is no error of prepare() any more. */
  void acceptEmpty();
  /** The first half of prepare(), for the part of the mesh that a process has: see
   * DistributedSolver. */
  void preparePart(MeshSource& part, const std::filesystem::path& scratch = {},
    std::int64_t memoryLimit = std::int64_t(1) << 30);
  /** The second half of prepare(), in which the processes of all parts take part. */
  void endPreparing(MeshParts& parts);

  int columns() const override;
  /** All columns if a Dirichlet value is the position. */
  int vectorSize() const override;
  Weights weights() const override;
  ConditionCounts conditionCounts() const override;
  /** False: nothing says what the value is there. */
  bool keepsUndetermined() const override { return false; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasCells() const override;
  void cells(CellBatch& batch) override;
  bool hasFacets() const override;
  void facets(FacetBatch& batch) override;
  /** Whether the mesh has groups of facets, which conditions may name. */
  bool hasInnerFacets() const override;
  void innerFacets(FacetBatch& batch) override;
  std::int64_t bytes() const override;
  /** Known after prepare(). */
  std::shared_ptr<const VertexCouplings> couplings() const override;

private:
  struct OnMesh;
  std::unique_ptr<OnMesh> Data;
};

} // namespace smg
