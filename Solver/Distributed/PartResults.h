// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Problem/Selection.h"
#include "smg/DistributedSolver.h"

#include <utility>

namespace smg
{

/** See DistributedSolver::evaluate(). */
void evaluatePart(const SharedVertices& vertices, const MeshPart& part, Problem& problem,
  const ResultOptions& options, DistributedSolution& solution);

/** Answers what selections ask about the parts of a mesh on several processes. */
class PartsOfMesh final : public MeshParts
{
public:
  PartsOfMesh(const SharedVertices& vertices, CellType type)
    : Vertices(vertices)
    , Type(type)
  {
  }

  void sum(std::span<std::int64_t> counts) override { this->Vertices.team().sum(counts); }
  void join(std::span<std::uint8_t> marks) override;
  void nearest(std::span<double> distances, std::span<std::int64_t> vertices) override;
  FacetSet innerFacets(const OpenFacets& facets) override;

private:
  const SharedVertices& Vertices;
  CellType Type;
};

/** The part of a mesh as a stream of one block, which may be empty. */
class PartSource final : public MeshSource
{
public:
  explicit PartSource(const MeshPart& part)
    : Part(part)
  {
  }

  const StreamInfo& info() const override { return this->Part.info; }
  bool next(MeshBlock& block) override
  {
    if (std::exchange(this->Read, true))
    {
      return false;
    }
    block = this->Part.block;
    return true;
  }

private:
  const MeshPart& Part;
  bool Read = false;
};

} // namespace smg
