// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/MovedPoints.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Mesh/AddedColumn.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

namespace smg
{
namespace
{

/** A triangle is collapsed if its smallest stretch is at most this part of its largest. */
constexpr double MinStretch = 1e-3;

/** The edges of a cell from its first corner, over the largest of their components. */
struct Edges
{
  std::array<Vector, 3> e{};
  double size = 0.0;

  template <class Corners>
  Edges(const Corners& corners, int count, Vector Corners::value_type::*position)
  {
    for (int k = 1; k < count; ++k)
    {
      this->e[k - 1] = difference((corners[k].*position).data(), (corners[0].*position).data());
      for (const double component : this->e[k - 1])
      {
        this->size = std::max(this->size, std::fabs(component));
      }
    }
    for (Vector& edge : this->e)
    {
      edge = this->size > 0.0 ? scaled(1.0 / this->size, edge) : Vector{};
    }
  }

  /** Six times the volume. */
  double volume() const { return dot(this->e[0], cross(this->e[1], this->e[2])); }
  /** Twice the area. */
  double area() const
  {
    const Vector normal = cross(this->e[0], this->e[1]);
    return std::sqrt(dot(normal, normal));
  }
};

/** The smallest over the largest stretch of a triangle: of the linear map from `a` to `b`, the
 * singular values s and t, by s t = |b| / |a| and s^2 + t^2, the trace of its Gram matrix. */
double stretchRatio(const Edges& a, const Edges& b)
{
  const double area = a.area();
  const double product = b.area() / area;
  const double squares =
    (dot(a.e[1], a.e[1]) * dot(b.e[0], b.e[0]) - 2.0 * dot(a.e[0], a.e[1]) * dot(b.e[0], b.e[1]) +
      dot(a.e[0], a.e[0]) * dot(b.e[1], b.e[1])) /
    (area * area);
  const double root = std::sqrt(std::max(0.0, squares * squares - 4.0 * product * product));
  return product > 0.0 ? 2.0 * product / (squares + root) : 0.0;
}

/** A number for a sentence, with three digits. */
std::string rounded(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

} // namespace

InvertedCells::InvertedCells(
  const StreamInfo& info, const std::filesystem::path& scratch, std::int64_t memory)
  : Info(info)
  , Rounding(info.doublePositions ? std::numeric_limits<double>::epsilon()
                                  : std::numeric_limits<float>::epsilon())
  , Places(scratch, memory)
{
}

void InvertedCells::add(std::span<const double> rest, const MeshBlock& moved)
{
  for (std::int64_t v = 0; v < moved.vertices(); ++v)
  {
    Place& place = this->Places.at(moved.firstVertex + v);
    std::copy_n(&rest[static_cast<std::size_t>(3 * v)], 3, place.rest.begin());
    std::copy_n(&moved.positions[static_cast<std::size_t>(3 * v)], 3, place.moved.begin());
  }
  const auto count = static_cast<std::size_t>(cornersOf(this->Info.cellType));
  const Column* flags = moved.flags();
  for (std::size_t c = 0; c < moved.corners.size() / count; ++c, ++this->Cells)
  {
    Corners corners;
    for (std::size_t k = 0; k < count; ++k)
    {
      corners[k] = this->Places.get(moved.corners[c * count + k]);
    }
    if (!flags || flags->value(c) == 0.0)
    {
      this->judge(corners, moved, c);
    }
  }
  this->Places.discardBelow(moved.finalized);
}

/** The ratio of Report::Inverted of an inverted cell. */
std::optional<double> InvertedCells::ratio(const Corners& corners) const
{
  const int count = cornersOf(this->Info.cellType);
  const bool isSurface = this->Info.cellType == CellType::Triangle;
  const Edges rest(corners, count, &Place::rest), moved(corners, count, &Place::moved);
  double largest = 0.0;
  for (int k = 0; k < count; ++k)
  {
    for (const double x : corners[k].rest)
    {
      largest = std::max(largest, std::fabs(x));
    }
  }
  // Each corner may be off by the rounding of its coordinates, over faces and edges of about 1.
  const double measure = isSurface ? rest.area() : std::fabs(rest.volume());
  if (!(measure > 16.0 * this->Rounding * largest / rest.size))
  {
    return {};
  }
  const double size = moved.size / rest.size;
  const double ratio =
    isSurface ? stretchRatio(rest, moved) : moved.volume() / rest.volume() * size * size * size;
  const bool isInverted = ratio <= (isSurface ? MinStretch : 0.0);
  return isInverted ? std::optional(ratio == 0.0 ? 0.0 : ratio) : std::nullopt; // no -0
}

void InvertedCells::judge(const Corners& corners, const MeshBlock& block, std::size_t cell)
{
  const std::optional<double> ratio = this->ratio(corners);
  if (!ratio)
  {
    return;
  }
  Report::Inverted one{ .cells = 1, .ratio = *ratio };
  const std::ptrdiff_t numbers = findColumn(block.cellColumns, OriginalCellIdSpec);
  one.worst = numbers < 0
                ? block.firstCell + static_cast<std::int64_t>(cell)
                : block.cellColumns[static_cast<std::size_t>(numbers)].as<std::int64_t>()[cell];
  const int count = cornersOf(this->Info.cellType);
  for (int k = 0; k < count; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      one.place[axis] += corners[k].moved[axis] / count;
    }
  }
  this->join(one);
}

void InvertedCells::join(const Report::Inverted& other)
{
  const std::int64_t cells = this->Found.cells + other.cells;
  if (other.cells > 0 && (this->Found.cells == 0 || other.ratio < this->Found.ratio))
  {
    this->Found = other;
  }
  this->Found.cells = cells;
}

void InvertedCells::finish(Report& report) const
{
  const bool isSurface = this->Info.cellType == CellType::Triangle;
  const std::int64_t cells = this->Info.cells > 0 ? this->Info.cells : this->Cells;
  report.inverted = this->Found;
  report.inverted->share =
    static_cast<double>(this->Found.cells) / static_cast<double>(std::max<std::int64_t>(cells, 1));
  if (this->Found.cells == 0)
  {
    return;
  }
  const auto& [x, y, z] = this->Found.place;
  report.notes.push_back(
    std::string("The deformation ") + (isSurface ? "collapses " : "inverts ") +
    std::to_string(this->Found.cells) + " of " + std::to_string(cells) +
    (isSurface ? " triangles (" : " tetrahedra (") + rounded(100.0 * report.inverted->share) +
    (isSurface ? " %), whose smallest stretch is at most 1/1000 of the largest"
               : " %), where the volume changes its sign or vanishes") +
    ". The worst is cell " +
    nameOfRow(this->Found.worst, findColumn(this->Info.cellColumns, OriginalCellIdSpec) >= 0) +
    ", at (" + rounded(x) + ", " + rounded(y) + ", " + rounded(z) + ") of the deformed mesh: " +
    rounded(this->Found.ratio) + (isSurface ? " of its largest stretch." : " times its volume."));
}

MovedPoints::MovedPoints(std::unique_ptr<MeshSource> source, Solution& positions, Report* report,
  const NormalsOptions& options)
  : Source(std::move(source))
  , Info(this->Source->info())
  , Positions(positions)
  , Judged(report)
{
  this->Info.bounds = {};
  if (report)
  {
    this->Inverted.emplace(this->Info, options.scratch, options.memory / 2);
  }
}

bool MovedPoints::next(MeshBlock& block)
{
  if (!this->Source->next(block))
  {
    if (this->Inverted)
    {
      this->Inverted->finish(*this->Judged);
      this->Inverted.reset();
    }
    return false;
  }
  if (this->Inverted)
  {
    this->Rest = block.positions;
  }
  if (block.vertices() > 0)
  {
    this->Positions.read(block.firstVertex, block.vertices(), block.positions);
  }
  for (std::int64_t v = 0; v < block.vertices() && !this->Info.doublePositions; ++v)
  {
    const std::span<double, 3> position(block.positions.data() + 3 * v, 3);
    std::ranges::copy(
      singlePrecision(position, block.firstVertex + v, "The moved mesh"), position.begin());
  }
  if (this->Inverted)
  {
    this->Inverted->add(this->Rest, block);
  }
  return true;
}

} // namespace smg
