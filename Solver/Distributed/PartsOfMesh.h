// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Problem/MeshParts.h"

namespace smg
{

/** What selections ask of the parts of a mesh on several processes. */
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

} // namespace smg
