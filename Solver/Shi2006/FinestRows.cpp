// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/FinestRows.h"

#include <algorithm>

namespace smg::shi2006
{
namespace
{

void append(Ring<double>& to, const double* values)
{
  const std::int64_t end = to.end();
  to.extendRaw(end + 1);
  std::copy_n(values, to.lanes(), to.at(end));
}

} // namespace

FinestRows::FinestRows(Pool& pool, const StreamInfo& info, Problem& problem, Components& components,
  ComponentLabels& labels, Level& level)
  : Finest(level)
  , Made(pool, problem.columns())
  , Rows(pool)
  , State(pool, this->Resident, 0, problem.columns())
  , Assembled(pool, info, problem, this->Made, components, labels, this)
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
  append(this->Finest.target, target);
}

void FinestRows::constraint(const double* sum)
{
  append(this->Finest.constraint, sum);
}

/** Moves the final rows to the level. */
void FinestRows::take()
{
  Level& level = this->Finest;
  const int columns = level.columns();
  this->Made.moveTo(this->Rows, this->State, columns);
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
      *edge++ = { i + entry.delta(), entry.weight() };
    }
    level.edges.close(static_cast<std::int64_t>(row.size()));
    level.node[i] = { this->Rows.alpha(i), this->Rows.diagonal(i) };
    std::copy_n(this->State.x().at(i), columns, level.value.at(i));
  }
  level.target.extend(level.edges.start(end)); // without edge targets: zero
  this->Rows.release(end, end);
  this->State.x().release(end);
  this->State.b().release(end);
}

} // namespace smg::shi2006
