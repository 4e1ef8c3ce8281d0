// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Problem/RegionList.h"
#include "Solver/Problem/Problem.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** The values that are prescribed in a region. */
struct RegionValue
{
  /** One number a column; not used if `position`. */
  std::vector<double> value;
  /** The value is the vertex's own coordinates; there are three columns then. */
  bool position = false;
};

/** What a RegionProblem consists of. */
struct RegionProblemData
{
  Weights weights = Weights::Cotangent;
  int columns = 1;
  double screening = 0.0;
  /** A factor of the cotangent weights, positive: of all cells, or that of each, which stands in
   * the cell column of this name. */
  double conductivity = 1.0;
  std::string conductivityColumn;
  /** A density for each column; empty: none. */
  std::vector<double> source;
  /** Where values are prescribed. Where regions overlap, the later one holds. */
  std::vector<NamedRegion> regions;
  /** The values of each of the regions. */
  std::vector<RegionValue> values;
};

/**
 * A Poisson problem with the values prescribed in regions and a constant source.
 *
 * Vertices are named by the column OriginalId, or by their stream index if the mesh has no such
 * column. The initial guess is the vertex's coordinates if a region prescribes these, else 0.
 */
class RegionProblem : public Problem
{
public:
  /**
   * `mesh` is the mesh the problem is for. `file` is what errors call the problem. Throws Error if
   * the mesh has no column of the conductivity.
   */
  RegionProblem(RegionProblemData data, const StreamInfo& mesh, std::string file = "problem");

  int columns() const override { return this->Data.columns; }
  Weights weights() const override { return this->Data.weights; }
  bool hasCells() const override;
  void cells(CellBatch& batch) override;
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;

  /** The vertex columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const { return this->Regions.vertexColumns(); }

  /** The cell columns that the mesh source must deliver. */
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once, without solving, and throws Error naming the region if a region selects
   * no vertex, or names a vertex that the mesh does not have.
   */
  void check(MeshSource& mesh) const { this->Regions.check(mesh); }

private:
  const Column* conductivityOf(const MeshBlock& block) const;

  std::string File;
  RegionList Regions;     ///< those of the data
  RegionProblemData Data; ///< all but the regions
  bool AnyPosition = false;
};

/**
 * Reads a problem file:
 *
 *     { "weights": "cotangent" | "raw-cotangent" | "uniform", "columns": 3,
 *       "dirichlet": [ { "halfspace": [nx, ny, nz, d], "value": [..] },
 *                      { "box": [x0, y0, z0, x1, y1, z1], "value": [..] },
 *                      { "sphere": [x, y, z, r], "value": "position" },
 *                      { "vertices": [original numbers], "value": [..] } ],
 *       "source": [..], "screening": 0.0, "conductivity": 1.0 | "name of a cell column" }
 *
 * Every key may be left out: cotangent weights, one column, nothing prescribed, no source, no
 * screening and a conductivity of 1. A value or source has as many numbers as there are columns (1
 * to 64). A conductivity, positive, is for cotangent weights alone.
 * @throws Error naming the file and the place in it
 */
RegionProblemData readProblemFileData(const std::filesystem::path& path);

/** The same for a mesh. */
std::unique_ptr<RegionProblem> readProblemFile(
  const std::filesystem::path& path, const StreamInfo& mesh);

} // namespace smg
