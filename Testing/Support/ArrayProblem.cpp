// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/ArrayProblem.h"

#include <algorithm>

namespace smg::testing
{
namespace
{

/** Copies tuples [first, first + to.size() / components) where there are any. */
template <class T>
void copyTuples(const std::vector<T>& from, std::int64_t first, int components, std::vector<T>& to)
{
  if (!from.empty())
  {
    std::copy_n(from.begin() + first * components, to.size(), to.begin());
  }
}

} // namespace

void ArrayProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  for (std::size_t v = 0; v < conditions.dirichlet.size() && !this->Prescribed.empty(); ++v)
  {
    const std::size_t vertex = static_cast<std::size_t>(block.firstVertex) + v;
    conditions.dirichlet[v] = this->Prescribed[vertex] != 0 ? 0 : -1;
  }
  copyTuples(this->Value, block.firstVertex, this->Columns, conditions.value);
  copyTuples(this->Source, block.firstVertex, this->Columns, conditions.source);
  std::ranges::fill(conditions.screening, this->Screening);
}

void ArrayProblem::edgeTargets(EdgeBatch& batch)
{
  for (std::size_t e = 0; e < batch.from.size(); ++e)
  {
    this->Target(&batch.fromPoint[3 * e], &batch.toPoint[3 * e], &batch.target[this->Columns * e]);
  }
}

ArrayProblem fixedEnds(const StreamMesh& mesh, double fraction, bool start)
{
  double low = mesh.positions[2];
  double high = low;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    low = std::min(low, mesh.positions[3 * v + 2]);
    high = std::max(high, mesh.positions[3 * v + 2]);
  }
  const double margin = fraction * (high - low);

  ArrayProblem problem;
  problem.Columns = 3;
  problem.Prescribed.resize(mesh.vertices(), 0);
  problem.Value.resize(3 * mesh.vertices(), 0.0);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double z = mesh.positions[3 * v + 2];
    problem.Prescribed[v] = z <= low + margin || z >= high - margin;
    if (problem.Prescribed[v] || start)
    {
      std::copy_n(mesh.positions.begin() + 3 * v, 3, problem.Value.begin() + 3 * v);
    }
  }
  return problem;
}

} // namespace smg::testing
