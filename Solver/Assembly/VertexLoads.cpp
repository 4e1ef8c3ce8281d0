// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/VertexLoads.h"

namespace smg
{

VertexLoads::VertexLoads(Pool& pool, CellType type, int columns)
  : Type(type)
  , Columns(columns)
  , Alpha(pool)
  , Load(pool, columns)
{
}

void VertexLoads::extend(std::int64_t vertices)
{
  this->Alpha.extend(vertices);
  this->Load.extend(vertices);
}

void VertexLoads::reserve(std::int64_t vertices)
{
  this->Alpha.reserveMore(vertices);
  this->Load.reserveMore(vertices);
}

void VertexLoads::release(std::int64_t first)
{
  this->Alpha.release(first);
  this->Load.release(first);
}

void VertexLoads::add(
  const std::int64_t* corners, const double* const* points, const ProblemCells& cells)
{
  const int count = cornersOf(this->Type);
  const double measure = cells.weights().measure;
  const double mass = measure / count;
  const double* source = cells.source();
  double* loads[4] = {};
  for (int c = 0; c < count; ++c)
  {
    this->Alpha[corners[c]] += mass * cells.screening();
    loads[c] = this->Load.at(corners[c]);
    for (int k = 0; k < this->Columns; ++k)
    {
      loads[c][k] += mass * source[k];
    }
  }
  addFieldLoads(cells, this->Type, points, this->Columns, loads);
}

void VertexLoads::add(const BoundaryFacet& facet, double area)
{
  const int count = BoundaryFacet::cornersOf(this->Type);
  const double share = area / count;
  for (int c = 0; c < count; ++c)
  {
    double* load = this->Load.at(facet.corners[c]);
    for (int k = 0; facet.flux >= 0 && k < this->Columns; ++k)
    {
      load[k] += share * facet.fluxValue[c * this->Columns + k];
    }
    if (facet.robin < 0)
    {
      continue;
    }
    const double alpha = share * facet.coefficient[c];
    this->Alpha[facet.corners[c]] += alpha;
    for (int k = 0; k < this->Columns; ++k)
    {
      load[k] += alpha * facet.ambient[c * this->Columns + k];
    }
  }
}

} // namespace smg
