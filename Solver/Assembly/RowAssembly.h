// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/VaryingRightSide.h"
#include "Solver/Core/SimdPack.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Cycle/RowShare.h"
#include "Solver/Multigrid/Setup/LevelRows.h"
#include "Solver/Multigrid/Setup/RowBatch.h"
#include "Solver/Multigrid/Setup/SliverRows.h"
#include "smg/Problem.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Rows of the finest level with their right-hand sides and initial values, and with positions if
 * they are `placed`, which pass from Assembly to the level between two steps. */
struct AssembledRows
{
  AssembledRows(Pool& pool, int columns, bool placed = false)
    : rows(pool, 2 * columns * static_cast<std::int64_t>(sizeof(double)) +
                   (placed ? 3 * static_cast<std::int64_t>(sizeof(float)) : 0))
    , placed(placed)
  {
  }

  RowBatch rows;
  std::vector<double> x, b; ///< `columns` per row
  const bool placed;
  /** If they are placed, 3 per row: positions relative to that of the first vertex, so that single
   * precision does for meshes anywhere. */
  std::vector<float> points;
  /** The scale of the weights of the problem relative to finite elements with K = 1, at the first
   * weighted cell. */
  double weightScale = 1.0;

  void moveTo(LevelRows& level, LevelWindow<double>& window, int columns)
  {
    const std::int64_t begin = level.end();
    const bool isLarge = this->rows.isLarge();
    this->rows.moveTo(level);
    const std::int64_t end = level.end();
    window.extendState(end);
    pad(this->x.data(), columns, end - begin, window.x().at(begin));
    pad(this->b.data(), columns, end - begin, window.b().at(begin));
    this->x.clear();
    this->b.clear();
    if (this->placed && end > begin)
    {
      std::ranges::copy(this->points, level.place(end - begin));
      this->points.clear();
    }
    if (isLarge)
    {
      this->points.shrink_to_fit();
      this->x.shrink_to_fit();
      this->b.shrink_to_fit();
    }
  }
};

/** Consecutive vertices all of whose cells have been added, with what their rows are made of
 * besides the data of OpenVertices: edges and the contributions of sources, screening and the
 * boundary. */
class FinalVertices
{
public:
  struct Vertex
  {
    std::size_t end;    ///< of its edges in `neighbours`
    double rowSum;      ///< contribution to the diagonal
    double weight;      ///< in the means of its component: Components::count()
    std::int64_t reach; ///< the largest neighbour of this and all earlier vertices
    float scale;        ///< see OpenVertices
    std::int32_t label; ///< of its component; or -1
    bool counts;        ///< for the sums of the component, which may float
  };

  std::int64_t first = 0; ///< the first vertex
  std::vector<Vertex> vertices;
  std::vector<RowNeighbour> neighbours; ///< of each vertex, in ascending order
  std::vector<double> targets;          ///< `columns` per neighbour; empty without edge targets
  std::vector<double> loads;            ///< `columns` per vertex: contribution to b
  /** `columns` per vertex: the mean of the jumps of the vertices that have its unknown; empty if
   * there are no jumps. */
  std::vector<double> jumps;

  std::int64_t end() const
  {
    return this->first + static_cast<std::int64_t>(this->vertices.size());
  }
  /** Where the edges of vertex number k begin. */
  std::size_t begin(std::size_t k) const { return k == 0 ? 0 : this->vertices[k - 1].end; }
  /** The bytes of memory that it has. */
  std::int64_t bytes() const
  {
    return static_cast<std::int64_t>(
      this->vertices.capacity() * sizeof(Vertex) +
      this->neighbours.capacity() * sizeof(RowNeighbour) +
      (this->targets.capacity() + this->loads.capacity() + this->jumps.capacity()) *
        sizeof(double));
  }
  /** Removes all vertices; the next one is `next`. */
  void clear(std::int64_t next)
  {
    this->first = next;
    this->vertices.clear();
    this->neighbours.clear();
    this->targets.clear();
    this->loads.clear();
    this->jumps.clear();
  }
};

/** A completed row of the finest level. */
struct AssembledRow
{
  const RowEntry* entries;
  std::span<const double> weights; ///< of the entries
  double diagonal;

  std::int64_t size() const { return static_cast<std::int64_t>(this->weights.size()); }
  double weight(std::int64_t e) const { return this->weights[static_cast<std::size_t>(e)]; }
  std::int64_t delta(std::int64_t e) const { return this->entries[e].delta(); }
};

/** The residual b - A x_0 of the initial values, summed up row by row. */
class InitialResidual
{
public:
  explicit InitialResidual(int columns)
    : varying(columns)
    , OfRow(static_cast<std::size_t>(columns))
    , Squares(OfRow.size())
    , RoundingSquares(OfRow.size())
    , LoadSquares(OfRow.size())
  {
  }

  /**
   * Adds a row, for instance an AssembledRow, whose residual counts as `share` (see commonShare()).
   * `x` and `b` are those of its vertex; the values of neighbours lie `stride` numbers per vertex
   * from `x`. Returns the residual of the row, a number per column.
   */
  template <class Row>
  std::span<const double> add(
    const Row& row, const double* x, const double* b, std::int64_t stride, double share);

  /** ||b - A x_0||^2 with the shares, by column. */
  std::span<const double> squares() const { return this->Squares; }
  /** The sum of the squares of its terms b_i and A_ii x_i. */
  double termSquares() const { return this->TermSquares; }
  /** The same with the shares by which rows count in later residuals (see residualShare()), by
   * column. */
  std::span<const double> roundingSquares() const { return this->RoundingSquares; }
  /** The part of these that is due to the right-hand side alone. */
  std::span<const double> loadSquares() const { return this->LoadSquares; }
  /** Whether any of the terms is not 0, though its square may be. */
  bool anyTerm() const { return this->AnyTerm; }

  /** What the residual is measured against; the rows are to be added to it, too. */
  VaryingRightSide varying;

private:
  std::vector<double> OfRow, Squares, RoundingSquares, LoadSquares; // by column
  double TermSquares = 0.0;
  bool AnyTerm = false;
};

template <class Row>
std::span<const double> InitialResidual::add(
  const Row& row, const double* x, const double* b, std::int64_t stride, double share)
{
  const double rounding = residualShare(share);
  withColumns(static_cast<int>(this->OfRow.size()),
    [&](auto columns)
    {
      double* sum = this->OfRow.data();
      for (int k = 0; k < columns; ++k)
      {
        sum[k] = b[k] - row.diagonal * x[k];
      }
      for (std::int64_t e = 0; e < row.size(); ++e)
      {
        // Values of consecutive vertices are contiguous in the ring: neighbours are found by their
        // distance.
        const double* other = x + stride * row.delta(e);
        for (int k = 0; k < columns; ++k)
        {
          sum[k] += row.weight(e) * other[k];
        }
      }
      for (int k = 0; k < columns; ++k)
      {
        const auto column = static_cast<std::size_t>(k);
        const double loadSquare = b[k] * b[k];
        const double termSquare = loadSquare + row.diagonal * row.diagonal * x[k] * x[k];
        this->Squares[column] += share * share * (sum[k] * sum[k]);
        this->TermSquares += termSquare;
        this->RoundingSquares[column] += rounding * rounding * termSquare;
        this->LoadSquares[column] += rounding * rounding * loadSquare;
        this->AnyTerm = this->AnyTerm || b[k] != 0.0 || x[k] != 0.0;
      }
    });
  return this->OfRow;
}

/**
 * Receives, vertex by vertex, the data of the mesh that the rows of the finest level do not store.
 */
class RowListener
{
public:
  virtual ~RowListener() = default;

  /** Rows follow. The problem has been asked for their vertices already. It may be asked for others
   * on another thread while the rows arrive, but not during this call. */
  virtual void begin() {}
  /** The next vertex, which is free, has an edge to the constrained vertex index + delta. */
  virtual void link(std::int32_t delta, double weight) = 0;
  /** The next vertex is an unknown, whose initial residual counts as `share` (see commonShare());
   * label: of its component, or -1; rowSum: what it has on the diagonal besides its edges. */
  virtual void unknown(double /*share*/, std::int32_t /*label*/, double /*rowSum*/) {}
  /** The target d_ij of the next edge in the row of the next vertex, one value per column. Called
   * only if the problem has edge targets; `target` is valid during the call. */
  virtual void target(const double* /*target*/) {}
  /** The contribution of the source and the constrained neighbours to b of the next vertex, one
   * value per column; b itself if the vertex is not an unknown. `sum` is valid during the call. */
  virtual void constraint(const double* /*sum*/) {}
  /** The next vertex is complete. `point` is its position, `reach` the largest neighbour of this
   * and all earlier vertices. */
  virtual void close(const double* point, std::int64_t reach) = 0;
};

/** Makes a row of the finest level, its right-hand side and initial value from the data of the
 * vertex and its neighbours. */
class RowAssembly
{
public:
  RowAssembly(CellType type, const OpenVertices& vertices, Problem& problem, AssembledRows& rows,
    Components& components, SliverRows stiff, RowListener* listener);

  /** Whether a vertex is not an unknown: prescribed, or without any data that determine it. */
  static bool isKnown(std::int32_t dirichlet, std::size_t neighbours, double rowSum)
  {
    return dirichlet >= 0 || (neighbours == 0 && rowSum == 0.0);
  }

  /** Adds the next row, of vertex number k of `collected`. */
  void close(const FinalVertices& collected, std::size_t k);

  std::int64_t prescribed() const { return this->Prescribed; }
  /** The number of vertices without any data that determine them. */
  std::int64_t held() const { return this->Held; }
  /** See lostDiagonal(). */
  std::int64_t raised() const { return this->Raised; }
  std::int64_t stiff() const { return this->Stiff.found(); }
  /** The residual of the initial values; rows dominated by slivers, screening and the like count as
   * by ordinary edges. */
  const InitialResidual& residual() const { return this->Residual; }

private:
  void place(std::int64_t i);
  void closeKnown(std::int64_t i);
  void addNeighbours(
    std::int64_t i, std::span<const RowNeighbour> neighbours, const double* target);
  void addKnown(
    std::int64_t i, std::int32_t delta, const RowNeighbour& neighbour, const double* target);
  void addUnknown(
    std::int64_t i, std::int32_t delta, const RowNeighbour& neighbour, const double* target);
  void addTarget(double weight, const double* target);
  void addFlow(double weight, std::int64_t i, std::int64_t neighbour);
  void addFlows(std::int64_t i, std::span<const RowNeighbour> neighbours);
  /** The initial values of vertex i: of a correction zeros. */
  const double* initial(std::int64_t i) const
  {
    return this->Vertices.isSolved() ? this->Zeros.data() : this->Vertices.values.at(i);
  }
  void sharpen(std::span<const RowNeighbour> neighbours);
  bool addEdge(std::int64_t i, const RowNeighbour& neighbour, double weight);
  void regularise(std::int64_t i);
  void count(std::int64_t i, const FinalVertices::Vertex& vertex, const double* jumps);
  std::span<const double> weights() const
  {
    return { this->Weight.data(), static_cast<std::size_t>(this->Size) };
  }

  const OpenVertices& Vertices;
  std::size_t Columns;
  CellType Type;
  Weights Kind;
  AssembledRows& Out;
  Components& Parts;
  SliverRows Stiff;
  RowListener* Listener;

  std::array<double, 3> Origin{}; // the first vertex

  // The current row.
  RowEntry* Row = nullptr;
  std::int64_t Size = 0;
  double RowSum = 0.0;
  double Scale = 0.0; // of the weights of its cells
  double Edges = 0.0,
         Ordinary = 0.0; // sums of |weight|: all, and each at most that of regular cells
  double Raise = 0.0;
  // Weights of the first `Size` entries, rounded like these except for those that the row needs in
  // double precision: AnyPrecise says whether there are any.
  std::vector<double> Weight;
  bool AnyPrecise = false;
  float Least = 0.0F;             // the smallest weight of the entries, or 0
  std::vector<double> Zeros;      // `Columns` numbers
  std::vector<double> B;          // `Columns` numbers
  std::vector<double> Constraint; // the part of b not from edges to unknowns
  std::vector<double> Mean;       // `Columns` numbers

  InitialResidual Residual;
  std::int64_t Prescribed = 0, Held = 0, Raised = 0;
};

} // namespace smg
