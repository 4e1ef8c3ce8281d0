// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace smg
{

/** Vertex column with the solution (float64): `columns` components. */
inline constexpr const char* SolutionName = "Solution";
/** Column with grad u (float64), of the cells or the vertices: 3 components for each column of the
 * problem. */
inline constexpr const char* GradientName = "Gradient";
/** Cell column with -K grad u (float64): 3 components for each column of the problem. */
inline constexpr const char* FluxName = "Flux";

/**
 * The stream of a mesh with all its columns and the solution of a problem on it: the vertex
 * column Solution and, if wanted, the cell columns Gradient and Flux (0 in cells without weight; on
 * surfaces, in the plane of the triangle) and the vertex column Gradient (NaN at vertices of no
 * cell with weight). Columns of these names from an earlier solve are left out.
 */
class SMG_EXPORT SolvedMesh : public MeshSource
{
public:
  /**
   * Opens the stream. Mesh, problem and solution must outlive it.
   * @param mesh the mesh of the solution
   * @param problem the problem of the solution; asked once more while the stream is read
   * @param solution the solution
   * @param options which results to compute; with gradientAtVertices the first call of next()
   * reads the mesh before
   * @throws Error if the solution has another number of columns than the problem, or of vertices
   * than the mesh, or the problem has edge targets
   */
  SolvedMesh(const StoredMesh& mesh, Problem& problem, Solution& solution,
    const ResultOptions& options = {});

  ~SolvedMesh() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;

  /**
   * Adds the results to a copy of the solution's report: `conditions`, `energy`, `integrals`,
   * `mean`, `minimum`, `maximum`, `source`, `screening`, `balance`, and notes. To be called when
   * the stream has been read to its end. The vertices of minima and maxima are original numbers if
   * the mesh is a .vsm file with the column OriginalId.
   */
  void finish(Report& report);

  /** Hands over the column Gradient of the vertices, 3 numbers for each column of the problem, with
   * its scratch file. To be called when the stream has been read to its end; null if it is not
   * wanted. */
  std::unique_ptr<Solution> takeVertexGradients();

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

/**
 * Writes a mesh with the solution of a problem, the columns of SolvedMesh, and removes the
 * solution's checkpoint.
 * @param mesh the mesh of the solution, read once, and once more if the description selects parts
 * of it
 * @param problem the problem of the solution
 * @param solution the solution
 * @param path the file to write; see writeMesh()
 * @param results what else to compute; also what the description asks for
 * @return the report of the solution, completed by SolvedMesh::finish(), with a note for each thing
 * that the format cannot hold
 * @throws Error as SolvedMesh and writeMesh() do
 */
SMG_EXPORT Report write(const StoredMesh& mesh, const ProblemDescription& problem,
  Solution& solution, const std::filesystem::path& path, const ResultOptions& results = {});

/**
 * The stream of a mesh with a solution as vertex columns, which replace those of the same names.
 * Values of integer columns are rounded to the nearest integer that the type holds (see
 * Report::clipped).
 */
class SMG_EXPORT ReplacedColumns : public MeshSource
{
public:
  /**
   * Opens the stream. The solution must outlive it.
   * @param mesh the mesh of the solution
   * @param solution the solution
   * @param columns the columns; their components are those of the solution, in order
   * @param dropped names of other vertex columns that the stream shall not have
   * @throws Error if the solution has another number of vertices than the mesh, or of columns than
   * the components of `columns`
   */
  ReplacedColumns(const StoredMesh& mesh, Solution& solution, std::vector<ColumnSpec> columns,
    const std::vector<std::string>& dropped = {});
  ~ReplacedColumns() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
