// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/FinestRows.h"

#include <algorithm>

namespace smg::shi2006
{

FinestRows::FinestRows(Pool& pool, const StreamInfo& info, Problem& problem, Components& components,
  ComponentLabels& labels, Level& level)
  : Finest(level)
  , Rows(pool)
  , State(pool, this->Resident, 0, problem.columns())
  , Assembled(pool, info, problem, this->Rows, this->State, components, labels, this)
{
}

void FinestRows::add(const MeshBlock& block)
{
  this->Assembled.add(block);
  this->take();
}

void FinestRows::finish()
{
  this->Assembled.finish();
  this->take();
}

void FinestRows::target(const double* target)
{
  Ring<double>& targets = this->Finest.target;
  const std::int64_t edge = targets.end();
  targets.extendRaw(edge + 1);
  std::copy_n(target, targets.lanes(), targets.at(edge));
}

/** Moves the rows that are final to the level. */
void FinestRows::take()
{
  Level& level = this->Finest;
  const int columns = level.columns();
  const std::int64_t begin = level.nodes();
  const std::int64_t end = this->Rows.end();
  level.node.extendRaw(end);
  level.value.extendRaw(end);
  level.rightSide.extendRaw(end);
  for (std::int64_t i = begin; i < end; ++i)
  {
    const auto row = this->Rows.row(i);
    Edge* edge = level.edges.open(static_cast<std::int64_t>(row.size()));
    for (const RowEntry& entry : row)
    {
      *edge++ = { i + entry.delta, entry.weight };
    }
    level.edges.close(static_cast<std::int64_t>(row.size()));
    level.node[i] = { this->Rows.alpha(i), this->Rows.diagonal(i) };
    std::copy_n(this->State.x().at(i), columns, level.value.at(i));
    std::copy_n(this->State.b().at(i), columns, level.rightSide.at(i));
  }
  level.target.extend(level.edges.start(end)); // without edge targets: zero
  this->Rows.release(end, end);
  this->State.x().release(end);
  this->State.b().release(end);
}

void sumConstraints(Level& finest)
{
  const int columns = finest.columns();
  finest.constraint.extendRaw(finest.nodes());
  for (std::int64_t i = 0; i < finest.nodes(); ++i)
  {
    double* xi = finest.constraint.at(i);
    std::copy_n(finest.rightSide.at(i), columns, xi);
    const Edge* edge = finest.edges.row(i);
    const double* target = finest.target.at(finest.edges.start(i));
    for (std::int64_t e = 0; e < finest.edges.size(i); ++e, target += columns)
    {
      for (int k = 0; k < columns; ++k)
      {
        xi[k] -= edge[e].weight * target[k];
      }
    }
  }
}

} // namespace smg::shi2006
