// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/EdgeWeights.h"

#include "Testing/Support/CellWeights.h"
#include "smg/Error.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace smg::testing
{
namespace
{

bool before(const EdgeWeight& a, const EdgeWeight& b)
{
  return std::pair(a.from, a.to) < std::pair(b.from, b.to);
}

/** The minimum weight of an edge with these ends. */
double floorOf(CellType type, const double* p, const double* q)
{
  using Point = Eigen::Map<const Eigen::Vector3d>;
  return type == CellType::Triangle ? 5e-4 : 1e-4 * (Point(p) - Point(q)).norm();
}

} // namespace

EdgeWeights::EdgeWeights(const StreamInfo& info, Weights kind, bool connectsFlat)
  : Type(info.cellType)
  , Kind(kind)
  , ConnectsFlat(connectsFlat)
{
  if (info.vertices > std::numeric_limits<std::int32_t>::max())
  {
    throw Error("The direct solver takes meshes of less than 2^31 vertices; this one has " +
                std::to_string(info.vertices) + ".");
  }
  this->Mass = Eigen::VectorXd::Zero(info.vertices);
}

void EdgeWeights::add(const MeshBlock& block, const std::vector<double>& positions)
{
  const int size = cornersOf(this->Type);
  const int(*pairs)[2] = this->Type == CellType::Triangle ? TrianglePairs : TetrahedronPairs;
  const int pairCount = this->Type == CellType::Triangle ? 3 : 6;
  const auto flags = std::find_if(block.cellColumns.begin(), block.cellColumns.end(),
    [](const Column& column) { return column.spec.name == CellFlagsName; });
  for (std::size_t c = 0; c < block.corners.size() / size; ++c)
  {
    const std::int64_t* corners = &block.corners[size * c];
    std::array<const double*, 4> points{};
    for (int k = 0; k < size; ++k)
    {
      points[k] = &positions[3 * corners[k]];
    }
    CellWeights cell = cellWeights(this->Type, points);
    const auto flag = static_cast<unsigned>(flags != block.cellColumns.end() ? flags->value(c) : 0);
    if (cell.size == 0.0 || flag != 0)
    {
      ++this->DegenerateCells;
      if (!this->ConnectsFlat || (flag & DuplicateCell) != 0 ||
          std::set<std::int64_t>(corners, corners + size).size() < std::size_t(size))
      {
        continue;
      }
      cell = {};
    }
    for (int k = 0; k < size; ++k)
    {
      this->Mass[corners[k]] += cell.size / size;
    }
    for (int pair = 0; pair < pairCount; ++pair)
    {
      const auto [from, to] = std::minmax(corners[pairs[pair][0]], corners[pairs[pair][1]]);
      if (cell.size == 0.0 && this->Kind == Weights::Clamped &&
          static_cast<float>(floorOf(this->Type, &positions[3 * from], &positions[3 * to])) == 0)
      {
        continue;
      }
      this->Edges.push_back(
        { static_cast<std::int32_t>(from), static_cast<std::int32_t>(to), cell.weight[pair] });
    }
  }
}

void EdgeWeights::finish(const std::vector<double>& positions)
{
  // Stable: the cells of an edge are summed in stream order.
  std::stable_sort(this->Edges.begin(), this->Edges.end(), before);
  auto end = this->Edges.begin();
  for (auto edge = this->Edges.begin(); edge != this->Edges.end();)
  {
    EdgeWeight sum = *edge;
    for (++edge; edge != this->Edges.end() && !before(sum, *edge); ++edge)
    {
      sum.weight += edge->weight;
    }
    const double floor = floorOf(
      this->Type, &positions[3 * std::size_t(sum.from)], &positions[3 * std::size_t(sum.to)]);
    if (this->Kind == Weights::Uniform)
    {
      sum.weight = 1.0;
    }
    else if (this->Kind == Weights::Clamped && sum.weight < floor)
    {
      sum.weight = floor;
      ++this->ClampedWeights;
    }
    *end++ = sum;
  }
  this->Edges.erase(end, this->Edges.end());
}

} // namespace smg::testing
