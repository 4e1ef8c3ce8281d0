// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/MeshMeasures.h"

#include "Solver/Core/Vector.h"
#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>

// Measures of a mesh stream, each from one reading in windows of open vertices: extent, mean edge
// and volumes of the bodies; normals at vertices; and the volume that a moving surface sweeps. All
// sums run over the cells in the order of the stream, so that blocks do not change a bit.

namespace smg
{

void MeshMeasures::add(const MeshBlock& block)
{
  this->Points.release(this->Finalized);
  this->Finalized = block.finalized;
  if (block.vertices() > 0)
  {
    this->Points.extendRaw(block.firstVertex + block.vertices());
    std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
    this->Open.extend(block.firstVertex + block.vertices());
    if (block.firstVertex == 0)
    {
      std::copy_n(block.positions.begin(), 3, this->Origin.begin());
    }
  }
  for (std::size_t k = 0; k < block.positions.size(); ++k)
  {
    this->Low[k % 3] = std::min(this->Low[k % 3], block.positions[k]);
    this->High[k % 3] = std::max(this->High[k % 3], block.positions[k]);
  }
  forAllCells(this->Type, block,
    [this](const std::int64_t* corners, unsigned flags, std::size_t /*c*/)
    { this->addCell(corners, flags); });
  this->Open.close(block.finalized, [this](const Body& body) { this->addBody(body); });
}

void MeshMeasures::finish()
{
  this->Open.closeAll([this](const Body& body) { this->addBody(body); });
}

void MeshMeasures::addCell(const std::int64_t* corners, unsigned flags)
{
  std::int64_t root = this->Open.find(corners[0]);
  for (int k = 1; k < cornersOf(this->Type); ++k)
  {
    root = this->Open.join(root, corners[k]);
  }
  Body& body = this->Open.sums(root);
  ++body.cells;
  if (hasRepeatedCorner(corners, cornersOf(this->Type)))
  {
    return;
  }
  if (flags == 0)
  {
    this->addLengths(corners);
  }
  // Only triangles enclose volumes that their winding may turn.
  if (this->Type == CellType::Triangle && (flags == 0 || this->OfAllCells))
  {
    body.volume += this->sixfoldVolume(corners);
  }
}

void MeshMeasures::addLengths(const std::int64_t* corners)
{
  for (int e = 0; e < edgesOf(this->Type); ++e)
  {
    const int* ends = edgeCorners(this->Type, e);
    const Vector edge =
      difference(this->Points.at(corners[ends[0]]), this->Points.at(corners[ends[1]]));
    // An inner edge counts in each of its cells: to count it once would take a table of edges.
    this->Lengths += std::sqrt(dot(edge, edge));
    ++this->Edges;
  }
}

/** That of the tetrahedron from the first vertex of the mesh: nearer than the origin of
 * coordinates, which may be far away, so that less cancels. */
double MeshMeasures::sixfoldVolume(const std::int64_t* corners) const
{
  const auto corner = [&](int k)
  { return difference(this->Points.at(corners[k]), this->Origin.data()); };
  return dot(corner(0), cross(corner(1), corner(2)));
}

/** Adds a body whose cells have all come. */
void MeshMeasures::addBody(const Body& body)
{
  if (body.cells == 0)
  {
    ++this->Isolated;
    return;
  }
  ++this->Bodies;
  this->Largest = std::max(this->Largest, body.cells);
  this->Volume += body.volume / 6.0;
  this->TurnedVolume += std::max(0.0, -body.volume / 6.0);
}

double MeshMeasures::diagonal() const
{
  return this->High[0] < this->Low[0]
           ? 0.0
           : std::hypot(this->High[0] - this->Low[0], this->High[1] - this->Low[1],
               this->High[2] - this->Low[2]);
}

double MeshMeasures::meanEdge() const
{
  return this->Edges == 0 ? 0.0 : this->Lengths / static_cast<double>(this->Edges);
}

void PointNormals::add(const MeshBlock& block, std::span<const std::uint8_t> held)
{
  this->Points.startBlock(block);
  this->Sums.extend(block.firstVertex + block.vertices());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    // The fourth number tells held vertices.
    this->Sums.at(block.firstVertex + static_cast<std::int64_t>(i))[3] = held[i];
  }
  forUnflaggedCells(CellType::Triangle, block,
    [this](const std::int64_t* corners, std::size_t /*c*/) { this->addCell(corners); });
  this->write(block.finalized);
}

/** Adds the unit normal of a triangle, times its angle at each corner, to the sums there. */
void PointNormals::addCell(const std::int64_t* corners)
{
  Vector edge[3]; // opposite to each corner
  for (int k = 0; k < 3; ++k)
  {
    edge[k] =
      difference(this->Points.at(corners[(k + 2) % 3]), this->Points.at(corners[(k + 1) % 3]));
  }
  const Vector area = cross(edge[0], edge[1]);
  const double size = std::sqrt(dot(area, area));
  if (!(size > 0.0))
  {
    return;
  }
  for (int k = 0; k < 3; ++k)
  {
    // Sine and cosine of the angle times the same product of lengths; exact for flat and for right
    // angles alike.
    const double angle = std::atan2(size, -dot(edge[(k + 1) % 3], edge[(k + 2) % 3]));
    double* sum = this->Sums.at(corners[k]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum[axis] += angle * area[axis] / size;
    }
  }
}

/** Writes the unit normals of the vertices below `finalized`, in stream order. */
void PointNormals::write(std::int64_t finalized)
{
  this->Units.clear();
  for (std::int64_t v = this->Normals.vertices(); v < finalized; ++v)
  {
    const double* sum = this->Sums.at(v);
    // Zero for held vertices, and for vertices that have only flat triangles.
    const double size = sum[3] != 0.0 ? 0.0 : std::hypot(sum[0], sum[1], sum[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Units.push_back(size > 0.0 ? sum[axis] / size : 0.0);
    }
  }
  if (!this->Units.empty())
  {
    this->Normals.append(this->Units);
    this->Sums.release(this->Normals.vertices());
  }
}

void PointNormals::finish()
{
  this->write(this->Sums.end());
}

namespace
{

/** The area vector of the triangle with the corners a + c b: the coefficients of 1, c and c^2. */
std::array<Vector, 3> areaVector(const Vector* a, const Vector* b)
{
  const auto edge = [](const Vector* of, int k) { return difference(of[k].data(), of[0].data()); };
  const Vector mixed1 = cross(edge(a, 1), edge(b, 2));
  const Vector mixed2 = cross(edge(b, 1), edge(a, 2));
  return { scaled(0.5, cross(edge(a, 1), edge(a, 2))),
    { 0.5 * (mixed1[0] + mixed2[0]), 0.5 * (mixed1[1] + mixed2[1]), 0.5 * (mixed1[2] + mixed2[2]) },
    scaled(0.5, cross(edge(b, 1), edge(b, 2))) };
}

} // namespace

/** Adds the polynomial of one triangle to the sum. */
void SweptVolume::add(const double* const* x, const double* const* y, const double* const* n)
{
  Vector before[3], half[3], after[3], normal[3], halfNormal[3], still[3] = {};
  Vector move{}, direction{}; // the mean of the corners
  for (int k = 0; k < 3; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      before[k][axis] = x[k][axis];
      after[k][axis] = y[k][axis];
      half[k][axis] = 0.5 * (x[k][axis] + y[k][axis]);
      normal[k][axis] = n[k][axis];
      halfNormal[k][axis] = 0.5 * n[k][axis];
      move[axis] += (y[k][axis] - x[k][axis]) / 3.0;
      direction[axis] += n[k][axis] / 3.0;
    }
  }
  // The volume is the integral over time of the mean velocity, y + c n - x, times the area vector.
  // That is quadratic in time, so that Simpson's rule integrates it exactly.
  const std::array<Vector, 3> first = areaVector(before, still);
  const std::array<Vector, 3> middle = areaVector(half, halfNormal);
  const std::array<Vector, 3> last = areaVector(after, normal);
  for (std::size_t power = 0; power < 3; ++power)
  {
    Vector mean;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mean[axis] = (first[power][axis] + 4.0 * middle[power][axis] + last[power][axis]) / 6.0;
    }
    this->Coefficients[power] += dot(move, mean);
    this->Coefficients[power + 1] += dot(direction, mean);
  }
}

double SweptVolume::at(double c) const
{
  const auto& a = this->Coefficients;
  return a[0] + c * (a[1] + c * (a[2] + c * a[3]));
}

double SweptVolume::slope(double c) const
{
  const auto& a = this->Coefficients;
  return a[1] + c * (2.0 * a[2] + c * 3.0 * a[3]);
}

/** Newton's method from 0: the cubic is nearly linear over the small distances that are looked
 * for. */
std::optional<double> SweptVolume::root(double most) const
{
  constexpr int Iterations = 50;
  double c = 0.0;
  for (int i = 0; i < Iterations && this->at(c) != 0.0; ++i)
  {
    // A slope of 0 gives infinity or NaN, which fails the test below.
    const double step = this->at(c) / this->slope(c);
    if (!(std::fabs(c - step) <= most))
    {
      return std::nullopt;
    }
    c -= step;
    if (std::fabs(step) <= 1e-12 * std::fabs(c) + 1e-15 * most)
    {
      return c;
    }
  }
  return this->at(c) == 0.0 ? std::optional(c) : std::nullopt;
}

} // namespace smg
