// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/BoundaryCurves.h"

#include "Solver/Core/Vector.h"
#include "smg/Error.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <utility>

// The boundary of a surface, smoothed as curves: one-dimensional finite elements on the boundary
// edges, by the same time step as the surface. Curves are short compared with the surface, so all
// edges are in memory, and each step factorises its matrix once for the three coordinates (sparse
// LDL^T). Vertices of any number of boundary edges are allowed. The edges come in the order of the
// stream, and the computation is sequential: the same bits in any case.

namespace smg
{

namespace
{

/** Bytes of an edge with its vertices, and of its share in the matrix and the factor, which has
 * little fill-in, since the graph of the matrix consists mostly of cycles. */
constexpr std::int64_t BytesPerEdge = 112, SystemBytesPerEdge = 400;

using CurvePoint = std::array<double, 3>;

Eigen::RowVector3d rowOf(const CurvePoint& position)
{
  return { position[0], position[1], position[2] };
}

/** The equations of a step, with eliminated fixed vertices: held ones, and those without mass,
 * whose edges have no length. */
class CurveSystem
{
public:
  explicit CurveSystem(std::vector<double> masses)
    : Diagonal(std::move(masses))
    , Fixed(this->Diagonal.size())
    , RightSide(static_cast<Eigen::Index>(this->Diagonal.size()), 3)
  {
  }

  void setVertex(std::size_t v, const CurvePoint& position, bool isHeld)
  {
    this->Fixed[v] = isHeld || !(this->Diagonal[v] > 0.0);
    this->Diagonal[v] = this->Fixed[v] ? 1.0 : this->Diagonal[v];
    this->RightSide.row(static_cast<Eigen::Index>(v)) = this->Diagonal[v] * rowOf(position);
  }

  /** To be called when all vertices are set. */
  void addEdge(const std::array<std::int64_t, 2>& ends, double weight,
    const std::vector<CurvePoint>& positions)
  {
    // Both equations of the edge. A fixed neighbour goes to the right-hand side; of two free ones,
    // the entry of the lower triangle is stored.
    for (const auto& [from, to] : { std::pair(ends[0], ends[1]), std::pair(ends[1], ends[0]) })
    {
      const auto place = static_cast<std::size_t>(from);
      const auto other = static_cast<std::size_t>(to);
      if (!this->Fixed[place])
      {
        this->Diagonal[place] += weight;
        if (this->Fixed[other])
        {
          this->RightSide.row(from) += weight * rowOf(positions[other]);
        }
      }
      if (!this->Fixed[place] && !this->Fixed[other] && from > to)
      {
        this->Entries.emplace_back(from, to, -weight);
      }
    }
  }

  /** Replaces the positions by the solution. Throws Error. */
  void solve(std::vector<CurvePoint>& positions)
  {
    const Eigen::Index size = this->RightSide.rows();
    for (Eigen::Index v = 0; v < size; ++v)
    {
      this->Entries.emplace_back(v, v, this->Diagonal[static_cast<std::size_t>(v)]);
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(this->Entries.begin(), this->Entries.end());
    // Symmetric and positive definite: free vertices have a mass.
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(matrix);
    if (factor.info() != Eigen::Success)
    {
      throw Error("the boundary cannot be smoothed as curves: fix it or leave it free");
    }
    const Eigen::MatrixXd solution = factor.solve(this->RightSide);
    for (std::size_t v = 0; v < positions.size(); ++v)
    {
      for (std::size_t axis = 0; !this->Fixed[v] && axis < 3; ++axis)
      {
        positions[v][axis] =
          solution(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(axis));
      }
    }
  }

private:
  std::vector<double> Diagonal;
  std::vector<bool> Fixed;
  Eigen::MatrixXd RightSide;
  std::vector<Eigen::Triplet<double>> Entries; ///< of the lower triangle
};

} // namespace

void BoundaryCurves::add(std::int64_t low, std::int64_t high)
{
  // Accounted for in chunks, not edge by edge.
  constexpr std::int64_t Chunk = 4096;
  if (this->Edges.size() % Chunk == 0)
  {
    this->Memory.acquire(Chunk * BytesPerEdge);
    this->Acquired += Chunk * BytesPerEdge;
  }
  this->Edges.push_back({ low, high });
}

std::size_t BoundaryCurves::place(std::int64_t vertex) const
{
  return static_cast<std::size_t>(
    std::ranges::lower_bound(this->Vertices, vertex) - this->Vertices.begin());
}

/** Numbers the vertices of the edges in ascending order, and measures the edges at rest. */
void BoundaryCurves::begin(const VertexFile& positions)
{
  for (const auto& ends : this->Edges)
  {
    this->Vertices.insert(this->Vertices.end(), ends.begin(), ends.end());
  }
  std::ranges::sort(this->Vertices);
  this->Vertices.erase(
    std::unique(this->Vertices.begin(), this->Vertices.end()), this->Vertices.end());
  this->Positions.resize(this->Vertices.size());
  this->Held.assign(this->Vertices.size(), 0);
  for (std::size_t k = 0; k < this->Vertices.size(); ++k)
  {
    // In ascending order, which suits the vertex file.
    positions.read(this->Vertices[k], 1, this->Positions[k].data());
  }
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    for (std::int64_t& end : this->Edges[e])
    {
      end = static_cast<std::int64_t>(this->place(end));
    }
    this->RestLengths.push_back(this->length(e));
  }
}

void BoundaryCurves::hold(std::int64_t first, std::span<const std::uint8_t> held)
{
  for (std::size_t k = this->place(first);
       k < this->Vertices.size() && this->Vertices[k] - first < std::ssize(held); ++k)
  {
    this->Held[k] = held[static_cast<std::size_t>(this->Vertices[k] - first)];
  }
}

double BoundaryCurves::length(std::size_t edge) const
{
  const auto [a, b] = this->Edges[edge];
  const Vector along = difference(this->Positions[static_cast<std::size_t>(a)].data(),
    this->Positions[static_cast<std::size_t>(b)].data());
  return std::sqrt(dot(along, along));
}

/** A step moves the curves; its system is accounted for only while it exists. */
void BoundaryCurves::step(double t)
{
  const auto bytes = static_cast<std::int64_t>(this->Edges.size()) * SystemBytesPerEdge;
  this->Memory.acquire(bytes);
  this->Acquired += bytes;
  CurveSystem system(this->masses());
  for (std::size_t v = 0; v < this->Vertices.size(); ++v)
  {
    system.setVertex(v, this->Positions[v], this->Held[v] != 0);
  }
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    // 1 / length is the stiffness of a linear element.
    if (this->RestLengths[e] > 0.0)
    {
      system.addEdge(this->Edges[e], t / this->RestLengths[e], this->Positions);
    }
  }
  system.solve(this->Positions);
  this->Memory.release(bytes);
  this->Acquired -= bytes;
}

/** The lumped masses: half the current lengths of the edges of each vertex. */
std::vector<double> BoundaryCurves::masses() const
{
  std::vector<double> masses(this->Vertices.size());
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    for (const std::int64_t end : this->Edges[e])
    {
      masses[static_cast<std::size_t>(end)] += 0.5 * this->length(e);
    }
  }
  return masses;
}

} // namespace smg
