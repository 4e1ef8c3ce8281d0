// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Blending/PatchLabels.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Problem/FixedVertices.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/Blend.h"
#include "smg/Column.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The vertex columns of a mesh that are blended. */
class BlendedColumns
{
public:
  /** Checks the names. Throws Error. */
  BlendedColumns(const BlendDescription& description, const StreamInfo& mesh, MeshColumns& columns);

  const std::vector<ColumnSpec>& specs() const { return this->Specs; }
  /** The components of all columns. */
  int components() const { return this->Components; }

  /** Reads the values of the vertices of a block. Throws Error if one is not finite. */
  void read(const MeshBlock& block, std::span<double> values) const;

private:
  void add(const std::string& name, const BlendDescription& description, const StreamInfo& mesh);

  MeshColumns& Columns;
  std::vector<NamedColumn> Named;
  std::vector<ColumnSpec> Specs;
  int Components = 0;
};

/**
 * The gradients of the original values around the vertices of a mesh stream: for each vertex the
 * sum over those of its cells that lie in one patch, weighted with their areas or volumes. They are
 * found in one reading of the mesh, kept in a file, and used in later readings.
 */
class PatchGradients
{
public:
  /** `open` accounts for what is kept of open vertices. */
  PatchGradients(const VertexStorage& storage, Pool& open, CellType type, int columns);

  /** Adds a block; `values` has its patches and values: PatchedValues::startBlock() has been
   * called. */
  void add(const MeshBlock& block, const PatchedValues& values);
  /** To be called after the last block. */
  void finish();

  /** Reads the gradients of the vertices of the next block; the first block restarts it. */
  void startBlock(const MeshBlock& block);
  /** Sets the gradients of a cell, x, y, z for each column, to the mean over the cells around its
   * corners, weighted by area or volume; 0 if there is none. */
  void average(std::span<const std::int64_t> corners, std::vector<double>& gradients) const;

private:
  void addCell(std::span<const std::int64_t> corners, const PatchedValues& values);
  void append(std::int64_t end);

  CellType Type;
  std::size_t Columns;
  VertexFile File; ///< for each vertex the measure of its cells and the weighted gradients
  OpenValues<double> Points, Sums;
  OpenValues<double> Known;               ///< sums from the file, in later readings
  std::int64_t Vertices = 0, Written = 0; ///< numbers of vertices: added, and in the file
};

/** The largest step of each column: the largest difference, over its components, between the ends
 * of an edge that is not in one patch. */
class SeamSteps
{
public:
  /** The components of `columns`, one after the other, are the values of a vertex. */
  explicit SeamSteps(const std::vector<ColumnSpec>& columns);

  /** Adds the edges of a cell. */
  void add(std::span<const std::int64_t> corners, const PatchedValues& values);

  /** The number of edges between patches; an edge counts once for each of its cells. */
  std::int64_t edges() const { return this->Edges; }
  /** The number of cells that are not in one patch. */
  std::int64_t cells() const { return this->Cells; }
  /** One for each column; 0 without such edges. */
  std::vector<double> largest() const;

private:
  std::vector<int> Components; ///< of each column
  std::vector<double> Steps;   ///< of each component
  std::int64_t Edges = 0, Cells = 0;
};

/**
 * The problem of blend() for the correction v = u - c: -div(grad v - r) + s v = 0 with r = q - grad
 * c, which is 0 except in cells between patches. Solving for the correction confines rounding to
 * it: values do not change at all where there is no correction.
 */
class BlendProblem : public Problem
{
public:
  /** Throws Error if the description is not valid. */
  BlendProblem(const BlendDescription& description, const StreamInfo& mesh);
  BlendProblem(const BlendProblem&) = delete;
  BlendProblem& operator=(const BlendProblem&) = delete;

  /** The columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const { return this->OfMesh.vertexColumns(); }
  std::vector<std::string> cellColumns() const { return this->OfMesh.cellColumns(); }
  /** The columns that are blended. */
  const std::vector<ColumnSpec>& specs() const { return this->Blended.specs(); }
  PatchLabels& patches() { return this->Patches; }
  /** Accounts for what is kept of open vertices. */
  Pool& memory() { return this->OfMesh.memory(); }

  /** To be called with all blocks of the stream, followed by endPreparing(): finds the patches, the
   * bounds and what is held. Scratch files are created in `scratch`. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  /** Throws Error if a held part is empty. */
  void endPreparing();

  /** Adds a block to the gradients inside the patches. */
  void addTo(PatchGradients& gradients, const MeshBlock& block);
  /** From then on, aims at these gradients in cells between patches, instead of 0. */
  void average(PatchGradients& gradients) { this->Gradients = &gradients; }

  /** From then on, appends the original values of each block to `originals`. */
  void keepIn(VertexFile& originals) { this->Originals = &originals; }
  /** The steps between patches in the original values, once all cells have been asked for. */
  const SeamSteps& steps() const { return this->Steps; }

  int columns() const override { return this->Blended.components(); }
  int vectorSize() const override { return this->columns(); }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasCells() const override { return true; }
  void cells(CellBatch& batch) override;
  std::int64_t bytes() const override { return this->OfMesh.memory().used(); }

private:
  MeshColumns OfMesh;
  BlendedColumns Blended;
  PatchLabels Patches;
  PatchedValues Open;
  SeamSteps Steps;
  std::vector<double> Mean; ///< gradients of a cell between patches
  FixedVertices Held;
  StreamCheck Check;
  Vector Low, High; ///< the corners of the bounding box
  double Anchor;
  double Screening = 0.0;
  VertexFile* Originals = nullptr;
  PatchGradients* Gradients = nullptr;
};

} // namespace smg
