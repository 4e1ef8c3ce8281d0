// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Fairing/BoundaryCurves.h"
#include "Solver/Jobs/Fairing/FairingProblem.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Jobs/Fairing/OrientedMesh.h"
#include "Solver/Jobs/Values/VertexSolution.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/FixedVertices.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/Smooth.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** The result of smoothing. */
class FairedValues final : public VertexSolution
{
public:
  FairedValues(const Smoothing& options, int columns)
    : VertexSolution(options, columns, "smoothed")
    , orient(options.orient)
  {
  }

  Orientation* winding() override { return this->orient && this->found ? &*this->found : nullptr; }

  bool orient;                      ///< whether triangles of the result are turned
  std::optional<Orientation> found; ///< how a surface that is wound badly is to be wound
};

/** Smooths a mesh, see smooth(): surveys it, then takes step after step. */
class MeshFairing
{
public:
  /** The options must be valid. Throws Error if they do not fit the mesh. */
  MeshFairing(const StoredMesh& mesh, const Smoothing& options);

  /** To be called once. */
  std::unique_ptr<Solution> run();

private:
  using Part = ProgressPart;
  using Visit = std::function<void(const MeshBlock& block)>;

  bool movesPoints() const { return this->Options.column.empty(); }
  /** Whether there is a boundary that is smoothed as curves. */
  bool hasCurves() const { return this->Curves && !this->Curves->isEmpty(); }

  /** Reads the mesh once. */
  void read(Part part, const Visit& visit);
  void survey(Part part);
  void keepValues(const MeshBlock& block);
  void requireWelded(const StreamCheck& check);
  void orient(Part part);
  void noteCavities(double inwards, double outwards);
  void setSize(const MeshMeasures& measures);
  void holdCurves(Part part);

  void step(int k, Part part);
  void smoothColumn(Part part);
  void findEdges(int k, Part part);
  FairingProblem problem(double t, const VertexFile* surface);
  void solveStep(FairingProblem& problem, const std::string& name, Part part, VertexFile& to);
  void take(
    Solution& solution, const std::vector<Report::Step>& steps, std::int64_t own, VertexFile& to);
  void findNormals(const VertexFile& positions, bool ofHeld, Part part);
  void keepVolume(Part part);
  double sweptVolume(Part part, double& distance);
  std::unique_ptr<Solution> finish();

  /** The mesh, wound so that its bodies have volumes. */
  const StoredMesh& surface() const { return this->Oriented ? *this->Oriented : this->Mesh; }

  const StoredMesh& Mesh;
  std::optional<OrientedMesh> Oriented; ///< of a surface that is wound badly
  Smoothing Options;
  MeshColumns Columns;
  std::optional<NamedColumn> Column; ///< none: the positions
  FixedVertices Held;
  std::unique_ptr<FairedValues> Result; ///< with the current values
  JobRun& Job;                          ///< of the result
  std::optional<BoundaryCurves> Curves;
  VertexFile Next; ///< the values after the current step
  std::optional<VertexFile> Presmoothed, Normals;
  std::vector<double> Values;    ///< of a block
  double Size = 0.0, Time = 0.0; ///< S and t
};

} // namespace smg
