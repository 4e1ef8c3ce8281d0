// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/FiedlerVector.h"

#include "IO/Order/Search/ConjugateIteration.h"

#include <Eigen/Dense>

#include <cmath>
#include <cstdint>
#include <utility>

namespace smg
{

namespace
{

/** Graphs of at most this many nodes are solved directly. */
constexpr std::uint32_t DirectNodes = 48;

std::vector<double> directly(const WeightedGraph& graph)
{
  // D^-1/2 L D^-1/2, where D contains the masses, has the same eigenvalues.
  const std::uint32_t count = graph.nodes();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    graph.forEachEdge(i,
      [&](std::uint32_t j, float weight)
      {
        matrix(i, j) -= weight / std::sqrt(double(graph.masses[i]) * graph.masses[j]);
        matrix(i, i) += weight / double(graph.masses[i]);
      });
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  std::vector<double> vector(count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    vector[i] = solver.eigenvectors()(i, 1) / std::sqrt(double(graph.masses[i]));
  }
  return vector;
}

std::vector<double> solve(const WeightedGraph& graph, const std::function<void()>& poll)
{
  if (graph.nodes() <= DirectNodes)
  {
    return directly(graph);
  }
  std::vector<double> vector(graph.nodes());
  {
    std::vector<std::uint32_t> groups;
    const WeightedGraph coarse = coarsen(graph, groups);
    // A star becomes one node without information: any initial vector is suitable then.
    const std::vector<double> start =
      coarse.nodes() < 2 ? std::vector<double>() : solve(coarse, poll);
    for (std::uint32_t i = 0; i < graph.nodes(); ++i)
    {
      vector[i] = start.empty() ? i : start[groups[i]];
    }
  }
  return ConjugateIteration(graph, std::move(vector)).run(poll);
}

} // namespace

std::vector<double> fiedlerVector(const WeightedGraph& graph, const std::function<void()>& poll)
{
  if (graph.nodes() < 2)
  {
    return std::vector<double>(graph.nodes(), 0.0);
  }
  return solve(graph, poll);
}

} // namespace smg
