// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Fairing/BoundaryCurves.h"
#include "Solver/Jobs/Fairing/FairingProblem.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Jobs/Fairing/OrientedMesh.h"
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

/** The result of smoothing: values at the vertices, the memory or files that contain them, and the
 * report. */
class FairedValues final : public Solution
{
public:
  FairedValues(const Smoothing& options, int columns)
    : orient(options.orient)
    , memory(options.memoryLimit)
    , scratch(options.inCore ? std::nullopt
                             : std::optional<ScratchFolder>(
                                 std::in_place, options.scratch, options.scratchLimit))
    , storage{ this->memory, this->scratch ? &*this->scratch : nullptr, this->traffic }
    , values(this->storage, columns)
  {
  }

  std::int64_t vertices() const override { return this->values.vertices(); }
  int columns() const override { return this->values.lanes(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> to) override
  {
    checkVertexRange(
      first, count, to.size() / static_cast<std::size_t>(this->columns()), this->vertices());
    this->values.read(first, count, to.data());
  }
  Orientation* winding() override { return this->orient && this->found ? &*this->found : nullptr; }
  const Report& report() const override { return this->total; }

  bool orient; ///< whether triangles of the result are turned
  Pool memory;
  std::optional<ScratchFolder> scratch;
  IoStatistics traffic;
  VertexStorage storage; ///< for further values
  VertexFile values;
  std::optional<Orientation> found; ///< how a surface that is wound badly is to be wound
  Report total;
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
  /** A part of the operation, for its progress. */
  struct Part
  {
    double begin = 0.0, end = 1.0;

    double at(double done) const { return this->begin + done * (this->end - this->begin); }
    Part of(double from, double to) const { return { this->at(from), this->at(to) }; }
  };
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
  void findEdges(int k, Part part);
  FairingProblem problem(double t, const VertexFile* surface);
  void solveStep(FairingProblem& problem, const std::string& name, Part part, VertexFile& to);
  void findNormals(const VertexFile& positions, bool ofHeld, Part part);
  void keepVolume(Part part);
  double sweptVolume(Part part, double& distance);
  std::unique_ptr<Solution> finish();

  /** The mesh, wound so that its bodies have volumes. */
  const StoredMesh& surface() const { return this->Oriented ? *this->Oriented : this->Mesh; }

  const StoredMesh& Mesh;
  std::optional<OrientedMesh> Oriented; ///< of a surface that is wound badly
  Smoothing Options;
  Timer Wall;
  double CpuAtStart = processSeconds();
  MeshColumns Columns;
  std::optional<NamedColumn> Column; ///< none: the positions
  FixedVertices Held;
  std::unique_ptr<FairedValues> Result; ///< with the current values
  std::optional<BoundaryCurves> Curves;
  VertexFile Next; ///< the values after the current step
  std::optional<VertexFile> Presmoothed, Normals;
  std::vector<double> Values;    ///< of a block
  double Size = 0.0, Time = 0.0; ///< S and t
};

} // namespace smg
