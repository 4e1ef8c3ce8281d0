// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/PositionStep.h"

#include "Solver/Multigrid/Cycle/PatchRelaxation.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

constexpr int Stride = 4;

/** Sums over the edges of a row. */
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

void PositionStep::load()
{
  const std::int64_t loaded = this->Window.loaded();
  while (this->Points.end() < loaded)
  {
    this->Blocks.push_back(this->Rest.next());
    const RestBlock& block = this->Blocks.back();
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

void PositionStep::advance(std::int64_t final)
{
  this->turn(final);
  while (this->Done < this->Points.end())
  {
    const auto number =
      static_cast<std::size_t>((this->Done - this->Blocks.front().first()) / RowBlock::Nodes);
    const RestBlock& block = this->Blocks[number];
    const RestBlock::Header& h = block.header();
    const std::int64_t group = (this->Done - h.first) / RowBlock::Group;
    if (h.reach[static_cast<std::size_t>(group)] >= this->Turned)
    {
      break;
    }
    this->closeGroup(
      block, h.first + std::min<std::int64_t>(h.nodes, (group + 1) * RowBlock::Group));
  }
  this->release();
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
void PositionStep::closeGroup(const RestBlock& block, std::int64_t end)
{
  if (this->Done == block.first())
  {
    this->NextLink = 0;
  }
  this->Window.forRange(this->Done, end, this->Window.down(),
    [&](const auto& h, const auto& a, BlockRange nodes, double*, double*)
    {
      const auto closeRows = [&](const auto& arrays, BlockRange rows)
      {
        for (std::int64_t k = rows.begin; k < rows.end; ++k)
        {
          this->closeRow(block, h, arrays, k);
        }
      };
      visitNodes(
        h, a, nodes, [&](BlockRange rows) { closeRows(a, rows); },
        [&](const RowBlock::Special& node)
        {
          visitSpecial<double>(h, a, node,
            [&](const auto& rows) {
              closeRows(rows, { node.node, node.node + 1 });
            });
        });
    });
  this->Done = end;
}

/** Computes right-hand side and first residual of node k of the block. */
template <class Arrays>
void PositionStep::closeRow(
  const RestBlock& block, const RowBlock::Header& h, const Arrays& a, std::int64_t k)
{
  const std::int64_t i = h.first + k;
  const BlockRange row = entriesOf(h, a, k);
  const std::span<const RestBlock::Link> links = block.links();
  if (row.begin == row.end && (this->NextLink == links.size() || links[this->NextLink].node != k))
  {
    return; // held, or without a weighted cell: u stays 0
  }
  const double* point = this->Points.at(i);
  const double* x = this->Window.up().x.at(i);
  EdgeSums sums;
  double held[3] = {}; // w_ij u_j of held neighbours
  double rotation[Stride];
  for (int c = 0; c < Stride; ++c)
  {
    rotation[c] = this->Window.up().b.at(i)[c] - a.diagonal[k] * x[c];
  }
  for (std::int64_t e = row.begin; e < row.end; ++e)
  {
    const std::int64_t j = i + a.delta[e];
    const double weight = a.weight[e];
    sums.add(weight, point, this->Points.at(j), this->Frames[j]);
    for (int c = 0; c < Stride; ++c)
    {
      rotation[c] += weight * x[static_cast<std::int64_t>(a.delta[e]) * Stride + c];
    }
  }
  for (; this->NextLink < links.size() && links[this->NextLink].node == k; ++this->NextLink)
  {
    const RestBlock::Link& link = links[this->NextLink];
    const std::int64_t j = i + link.delta;
    sums.add(link.weight, point, this->Points.at(j), this->Frames[j]);
    for (int c = 0; c < Columns; ++c)
    {
      held[c] += static_cast<double>(link.weight) * this->Motions.at(j)[c];
    }
  }

  const Frame& frame = this->Frames[i];
  double* b = this->Window.down().b.at(i);
  for (int c = 0; c < Columns; ++c)
  {
    b[c] = 0.5 * (frame.change(c, sums.edges) + sums.turned[c]) + held[c];
    this->InitialSquares += b[c] * b[c];
    this->TermSquares += b[c] * b[c] + sums.sizes[c] * sums.sizes[c];
  }
  for (const double r : rotation)
  {
    this->RotationSquares += r * r;
  }
}

/** Releases blocks that no row from Done on needs. */
void PositionStep::release()
{
  while (!this->Blocks.empty())
  {
    const RestBlock::Header& h = this->Blocks.front().header();
    const auto group = static_cast<std::size_t>((h.nodes - 1) / RowBlock::Group);
    const std::int64_t end = h.first + h.nodes;
    if (end > this->Done || h.reach[group] >= this->Done)
    {
      break;
    }
    this->Points.release(end);
    this->Motions.release(end);
    this->Frames.release(end);
    this->Blocks.pop_front();
  }
}

} // namespace smg
