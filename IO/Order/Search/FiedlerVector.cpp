// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/FiedlerVector.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

// The Fiedler vector of a weighted graph, by a hierarchy of coarser graphs and LOBPCG (Knyazev
// 2001) for one vector on each of them. As an order needs no more than a few digits, iterations end
// when the eigenvalue hardly decreases. Time and memory are linear in the edges for each iteration;
// results have the same bits in every run, since all sums are taken in the order of the nodes by
// one thread.

namespace smg
{
namespace
{

/** Graphs of at most this many nodes are solved directly. */
constexpr std::uint32_t DirectNodes = 48;

/** The second eigenvector of a small graph by a dense solver. */
std::vector<double> directly(const WeightedGraph& graph)
{
  // L x = lambda D x, where D has the masses, becomes an ordinary symmetric problem: D^-1/2 L
  // D^-1/2 has the same eigenvalues, and the eigenvectors D^1/2 x.
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

/** Solves on the coarser graph and improves the result on this one. */
std::vector<double> solve(const WeightedGraph& graph, const std::function<void()>& poll)
{
  if (graph.nodes() <= DirectNodes)
  {
    return directly(graph);
  }
  std::vector<double> vector(graph.nodes());
  {
    // In a block of its own: the coarser graph is released before the iterations on this one.
    std::vector<std::uint32_t> groups;
    const WeightedGraph coarse = coarsen(graph, groups);
    // A star becomes one node, which tells nothing: any initial vector does then.
    const std::vector<double> start =
      coarse.nodes() < 2 ? std::vector<double>() : solve(coarse, poll);
    for (std::uint32_t i = 0; i < graph.nodes(); ++i)
    {
      vector[i] = start.empty() ? i : start[groups[i]];
    }
  }
  return Lobpcg(graph, std::move(vector)).run(poll);
}

constexpr int MaxIterations = 300;
/** The iteration ends when the eigenvalue has decreased by less than this share twice in
 * succession. */
constexpr double MinGain = 1e-5;
/** With fewer nodes the time of an iteration is negligible. */
constexpr std::uint32_t PolledNodes = 4096;

double plainDot(const std::vector<double>& a, const std::vector<double>& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += a[i] * b[i];
  }
  return sum;
}

void add(std::vector<double>& to, double factor, const std::vector<double>& values)
{
  for (std::size_t i = 0; i < to.size(); ++i)
  {
    to[i] += factor * values[i];
  }
}

void scale(std::vector<double>& values, double factor)
{
  for (double& value : values)
  {
    value *= factor;
  }
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

Lobpcg::Lobpcg(const WeightedGraph& graph, std::vector<double> start)
  : Graph(graph)
  , Diagonal(graph.nodes(), 0.0)
{
  for (std::uint32_t i = 0; i < graph.nodes(); ++i)
  {
    this->Mass += graph.masses[i];
    graph.forEachEdge(i, [&](std::uint32_t, float weight) { this->Diagonal[i] += weight; });
  }
  this->Current.values = std::move(start);
  for (Direction* direction : { &this->Current, &this->Residual, &this->Previous })
  {
    direction->values.resize(graph.nodes());
    direction->image.resize(graph.nodes());
  }
}

double Lobpcg::dot(const std::vector<double>& a, const std::vector<double>& b) const
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += this->Graph.masses[i] * a[i] * b[i];
  }
  return sum;
}

void Lobpcg::removeMean(std::vector<double>& values) const
{
  double mean = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    mean += this->Graph.masses[i] * values[i];
  }
  mean /= this->Mass;
  for (double& value : values)
  {
    value -= mean;
  }
}

void Lobpcg::applyLaplacian(const std::vector<double>& values, std::vector<double>& image) const
{
  for (std::uint32_t i = 0; i < this->Graph.nodes(); ++i)
  {
    double sum = this->Diagonal[i] * values[i];
    this->Graph.forEachEdge(
      i, [&](std::uint32_t other, float weight) { sum -= weight * values[other]; });
    image[i] = sum;
  }
}

bool Lobpcg::normalise(Direction& direction) const
{
  const double square = this->dot(direction.values, direction.values);
  if (!(square > 0) || !std::isfinite(square))
  {
    return false;
  }
  scale(direction.values, 1 / std::sqrt(square));
  scale(direction.image, 1 / std::sqrt(square));
  return true;
}

bool Lobpcg::orthogonalise(Direction& direction, const Direction& against) const
{
  const double factor = this->dot(direction.values, against.values);
  // Of a nearly parallel direction only rounding errors would remain.
  if (!(1 - factor * factor > 1e-12))
  {
    return false;
  }
  add(direction.values, -factor, against.values);
  add(direction.image, -factor, against.image);
  return this->normalise(direction);
}

bool Lobpcg::residual(double eigenvalue)
{
  for (std::uint32_t i = 0; i < this->Graph.nodes(); ++i)
  {
    // The residual of L x = lambda M x, preconditioned by the diagonal of the Laplacian.
    const double r =
      this->Current.image[i] - eigenvalue * this->Graph.masses[i] * this->Current.values[i];
    this->Residual.values[i] = r / this->Diagonal[i];
  }
  this->removeMean(this->Residual.values);
  this->applyLaplacian(this->Residual.values, this->Residual.image);
  return this->normalise(this->Residual) && this->orthogonalise(this->Residual, this->Current);
}

double Lobpcg::minimise(bool withPrevious)
{
  // The Rayleigh quotient is minimised in the space of the current vector, the residual and the
  // last step. The directions are orthonormal, so the problem has the size of that space and is an
  // ordinary one.
  const std::array<Direction*, 3> space{ &this->Current, &this->Residual, &this->Previous };
  const int count = withPrevious ? 3 : 2;
  Eigen::MatrixXd matrix(count, count);
  for (int i = 0; i < count; ++i)
  {
    for (int j = 0; j < count; ++j)
    {
      matrix(i, j) = plainDot(space[std::size_t(i)]->values, space[std::size_t(j)]->image);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  const Eigen::VectorXd least = solver.eigenvectors().col(0);
  const double previous = withPrevious ? least(2) : 0;
  for (const auto part : { &Direction::values, &Direction::image })
  {
    // The step without its component along the current vector is the next conjugate direction.
    // Images are combined in the same way, so the Laplacian is applied once in an iteration, to the
    // residual.
    scale(this->Previous.*part, previous);
    add(this->Previous.*part, least(1), this->Residual.*part);
    scale(this->Current.*part, least(0));
    add(this->Current.*part, 1, this->Previous.*part);
  }
  return solver.eigenvalues()(0);
}

std::vector<double> Lobpcg::run(const std::function<void()>& poll)
{
  const bool isPolled = poll && this->Graph.nodes() >= PolledNodes;
  this->removeMean(this->Current.values);
  this->applyLaplacian(this->Current.values, this->Current.image);
  if (!this->normalise(this->Current))
  {
    return std::move(this->Current.values);
  }
  double eigenvalue = plainDot(this->Current.values, this->Current.image);
  bool withPrevious = false;
  int idle = 0;
  for (int iteration = 0; iteration < MaxIterations && idle < 2; ++iteration)
  {
    if (isPolled)
    {
      poll();
    }
    if (!this->residual(eigenvalue))
    {
      break;
    }
    // A direction that has become parallel to the others is left out of this iteration.
    withPrevious = withPrevious && this->normalise(this->Previous) &&
                   this->orthogonalise(this->Previous, this->Current) &&
                   this->orthogonalise(this->Previous, this->Residual);
    const double before = eigenvalue;
    eigenvalue = this->minimise(withPrevious);
    withPrevious = true;
    idle = eigenvalue > before * (1 - MinGain) ? idle + 1 : 0;
    this->normalise(this->Current);
  }
  this->removeMean(this->Current.values);
  return std::move(this->Current.values);
}

} // namespace smg
