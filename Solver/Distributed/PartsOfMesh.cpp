// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartsOfMesh.h"

#include "Solver/Distributed/SharedFacets.h"

#include <limits>
#include <vector>

namespace smg
{

void PartsOfMesh::join(std::span<std::uint8_t> marks)
{
  this->Vertices.collect(std::span<const std::uint8_t>(marks),
    [&](std::int64_t vertex, std::uint8_t mark)
    { marks[static_cast<std::size_t>(vertex)] |= mark; });
  this->Vertices.copyFromOwners(marks, 1);
}

void PartsOfMesh::nearest(std::span<double> distances, std::span<std::int64_t> vertices)
{
  std::vector<double> least(distances.begin(), distances.end());
  this->Vertices.team().least(least);
  std::vector<std::int64_t> ids(vertices.size(), std::numeric_limits<std::int64_t>::max());
  for (std::size_t n = 0; n < ids.size(); ++n)
  {
    if (vertices[n] >= 0 && distances[n] == least[n])
    {
      ids[n] = this->Vertices.id(vertices[n]);
    }
  }
  this->Vertices.team().least(ids);
  for (std::size_t n = 0; n < ids.size(); ++n)
  {
    distances[n] = least[n];
    vertices[n] = this->Vertices.find(ids[n]);
  }
}

FacetSet PartsOfMesh::innerFacets(const OpenFacets& facets)
{
  return smg::innerFacets(this->Vertices, this->Type, facets);
}

} // namespace smg
