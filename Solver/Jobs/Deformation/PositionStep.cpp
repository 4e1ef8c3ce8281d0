// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/PositionStep.h"

#include "Solver/Multigrid/Cycle/LevelWindow.h"

#include <algorithm>
#include <cmath>

// The second system of a deformation begins in the pass that finishes the first one. Vertices go
// through three states, in stream order: loaded; turned, when the upward part of the last V-cycle
// of the rotations has finished them, so that their frame s R - I is known; and done, when all
// neighbours are turned as well and the right-hand side has been computed. Only then may the
// downward part of the positions use them.
//
// A row needs the frames and positions at rest of its neighbours, including held ones, which the
// rows of the matrix omit: SystemRecord lists these edges, and how far the neighbours of a group of
// rows reach. The terms of a row are summed in the order of its entries and rows follow in
// ascending order, so that the sums have the same bits for any schedule. The memory is the window
// between loading and releasing; the time is linear in the number of edges.

namespace smg
{
namespace
{

/** Values per node in the window, of either problem: four columns of rotations and scale, or three
 * of positions and a padding. */
constexpr int Stride = 4;

/** Sums over the edges of a row. With b_i = sum_j w_ij ((s_i R_i - I) + (s_j R_j - I)) / 2 (p_i -
 * p_j), the frame of vertex i can be applied to a sum, once per row. */
struct EdgeSums
{
  double edges[3] = {};  ///< w_ij (p_i - p_j)
  double sizes[3] = {};  ///< the same of the magnitudes
  double turned[3] = {}; ///< w_ij (s_j R_j - I) (p_i - p_j)

  void add(double weight, const double* from, const double* to, const Frame& frame)
  {
    const double d[3] = { weight * (from[0] - to[0]), weight * (from[1] - to[1]),
      weight * (from[2] - to[2]) };
    for (int r = 0; r < 3; ++r)
    {
      this->edges[r] += d[r];
      this->sizes[r] += std::fabs(d[r]);
      this->turned[r] += frame.change(r, d);
    }
  }
};

} // namespace

void PositionStep::startPass()
{
  this->Rest.startPass();
  this->Records.startPass();
}

void PositionStep::endPass()
{
  this->Rest.endPass();
  this->Records.endPass();
}

/** Loads the positions at rest, and the displacements of held vertices; the downward part starts
 * with displacements of 0. */
void PositionStep::load()
{
  const std::int64_t loaded = this->Window.loaded();
  this->Records.load(loaded);
  while (this->Points.end() < loaded)
  {
    const RestBlock block = this->Rest.next();
    const std::int64_t first = block.first();
    this->Points.extendRaw(block.end());
    this->Motions.extendRaw(block.end());
    std::copy(block.points().begin(), block.points().end(), this->Points.at(first));
    for (const RestBlock::Held& held : block.held())
    {
      const std::int64_t i = first + held.node;
      for (int c = 0; c < Columns; ++c)
      {
        this->Motions.at(i)[c] = held.target[static_cast<std::size_t>(c)] - this->Points.at(i)[c];
      }
    }
    LevelWindow<double>::State& state = this->Window.down();
    std::ranges::fill(state.x.range(first, block.end()), 0.0);
    std::ranges::fill(state.b.range(first, block.end()), 0.0);
  }
}

/** Turns all vertices below `final`, then completes rows as far as their neighbours are turned. */
std::int64_t PositionStep::fill(std::int64_t final)
{
  this->turn(final);
  // A row needs its farthest neighbour to be turned.
  const std::int64_t end = this->Records.reachable(this->Done, this->Turned);
  while (this->Done < end)
  {
    const SystemRecord& record = this->Records.of(this->Done);
    this->closeRows(record, std::min(end, record.end()));
  }
  this->release();
  return this->Done;
}

/** Computes the frames of vertices below `end`, whose rotation and scale are final. */
void PositionStep::turn(std::int64_t end)
{
  this->Frames.extendRaw(end);
  const Ring<double>& x = this->Window.up().x;
  for (; this->Turned < end; ++this->Turned)
  {
    this->Frames[this->Turned] = frameOf(x.at(this->Turned));
  }
}

/** Processes the rows from Done to `end`, which are in one block. */
void PositionStep::closeRows(const SystemRecord& record, std::int64_t end)
{
  // Links are listed by ascending node and consumed in this order.
  if (this->Done == record.first())
  {
    this->NextLink = 0;
  }
  this->Window.forRange(this->Done, end, this->Window.down(),
    [&](const auto& a, const BlockPart<double>& part)
    {
      const RowBlock::Header& h = part.header();
      forRuns<double>(h, a, part.nodes,
        [&](const auto& arrays, BlockRange nodes, auto /*isSpecial*/)
        {
          for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
          {
            this->closeRow(record, h.first + k, RowView(h, arrays, k));
          }
        });
    });
  this->Done = end;
}

/** Computes right-hand side and first residual of vertex i, which has this row. */
template <class Row>
void PositionStep::closeRow(const SystemRecord& record, std::int64_t i, const Row& row)
{
  const std::int64_t k = i - record.first();
  const std::span<const KnownLink> links = record.links();
  if (row.size() == 0 && (this->NextLink == links.size() || links[this->NextLink].node != k))
  {
    // Held, or without a weighted cell: u stays 0.
    return;
  }
  const double* point = this->Points.at(i);
  const double* x = this->Window.up().x.at(i);
  EdgeSums sums;
  double held[3] = {}; // w_ij u_j of held neighbours
  double rotation[Stride];
  // The final residual b - A x of the rotations, whose rows pass by here for the last time. Their b
  // contains the held neighbours.
  for (int c = 0; c < Stride; ++c)
  {
    rotation[c] = this->Window.up().b.at(i)[c] - row.diagonal * x[c];
  }
  for (std::int64_t e = 0; e < row.size(); ++e)
  {
    const std::int64_t j = i + row.delta(e);
    const double weight = row.weight(e);
    sums.add(weight, point, this->Points.at(j), this->Frames[j]);
    for (int c = 0; c < Stride; ++c)
    {
      rotation[c] += weight * x[row.delta(e) * Stride + c];
    }
  }
  for (; this->NextLink < links.size() && links[this->NextLink].node == k; ++this->NextLink)
  {
    const KnownLink& link = links[this->NextLink];
    const std::int64_t j = i + link.delta;
    sums.add(link.weight, point, this->Points.at(j), this->Frames[j]);
    for (int c = 0; c < Columns; ++c)
    {
      held[c] += link.weight * this->Motions.at(j)[c];
    }
  }

  const Frame& frame = this->Frames[i];
  double* b = this->Window.down().b.at(i);
  for (int c = 0; c < Columns; ++c)
  {
    b[c] = 0.5 * (frame.change(c, sums.edges) + sums.turned[c]) + held[c];
    this->InitialSquares += b[c] * b[c];
    // Edges cancel in the sum: its rounding is relative to their magnitudes.
    this->TermSquares += b[c] * b[c] + sums.sizes[c] * sums.sizes[c];
  }
  for (const double r : rotation)
  {
    this->RotationSquares += r * r;
  }
}

/** Releases vertices that no row from Done on needs. */
void PositionStep::release()
{
  this->Unneeded = this->Records.reachable(this->Unneeded, this->Done);
  this->Records.release(this->Unneeded);
  const std::int64_t first = this->Records.first();
  this->Points.release(first);
  this->Motions.release(first);
  this->Frames.release(first);
}

} // namespace smg
