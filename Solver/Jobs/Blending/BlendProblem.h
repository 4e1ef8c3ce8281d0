// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Blending/BlendedColumns.h"
#include "Solver/Jobs/Blending/PatchGradients.h"
#include "Solver/Jobs/Blending/PatchedValues.h"
#include "Solver/Jobs/Blending/SeamSteps.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Problem/HeldVertices.h"
#include "smg/Blend.h"
#include "smg/Problem.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * The problem of blend() for the correction v = u - c: -div(grad v - r) + s v = 0, where r is
 * q - grad c: not 0 in cells between patches, and 0 in all others. Thus rounding affects the
 * correction only, and the values do not change where there is none.
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
  /** Between patches, aims at these gradients from then on, instead of 0. */
  void average(PatchGradients& gradients) { this->Gradients = &gradients; }

  /** Passes the values of each block to `originals` from then on. */
  void keepIn(VertexFile& originals) { this->Originals = &originals; }
  /** The steps between patches in the original values, once all cells have been asked for. */
  const SeamSteps& steps() const { return this->Steps; }

  int columns() const override { return this->Blended.components(); }
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
  HeldVertices Held;
  StreamCheck Check;
  Vector Low, High; ///< the corners of the bounding box
  double Anchor;
  double Screening = 0.0;
  VertexFile* Originals = nullptr;
  PatchGradients* Gradients = nullptr;
};

} // namespace smg
