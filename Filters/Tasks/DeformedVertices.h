// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Results/VertexNormals.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/** The vertices of a deformed mesh: their positions and normals. */
class DeformedVertices : public Solution
{
public:
  static constexpr int WithNormals = 6; ///< columns of positions and normals

  /** Computes the normals of `mesh` with its vertices moved, and adds the cells that this inverts
   * to the report, if there is one (see MovedMesh::source()). Throws Error and Cancelled. */
  DeformedVertices(std::unique_ptr<Solution> positions, std::unique_ptr<MeshSource> mesh,
    const NormalsOptions& options, Report* report = nullptr);

  std::int64_t vertices() const override { return this->Positions->vertices(); }
  int columns() const override { return WithNormals; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  void removeCheckpoint() override { this->Positions->removeCheckpoint(); }
  const Report& report() const override { return this->Positions->report(); }

private:
  std::unique_ptr<Solution> Positions;
  VertexNormals Normals;
};

} // namespace smg
