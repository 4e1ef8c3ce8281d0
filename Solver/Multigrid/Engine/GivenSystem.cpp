// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/GivenSystem.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/Transfer.h"
#include "Solver/Multigrid/Engine/AssemblyReport.h"
#include "Solver/Multigrid/Engine/FirstPass.h"

#include <algorithm>
#include <cmath>

// A vertex is taken when its values before are final: its b and x are given then. Its row is closed
// when all neighbours are taken: known neighbours are added to b, and the residual to the sums. It
// is complete, so that the downward part may change x, when the rows of all neighbours are closed.
// Rows are closed in ascending order and groups, so that no sum depends on the schedule. Memory:
// the records of the window.

namespace smg
{

GivenSystem::GivenSystem(SolveContext& context, SystemRecords& records, LevelWindow<double>& window,
  SystemValues& values, int columns, double scale)
  : Context(context)
  , Records(records)
  , Window(window)
  , Values(values)
  , Columns(columns)
  , Scale(scale)
  , First(columns)
  , SquaresBefore(static_cast<std::size_t>(columns))
  , OfRow(this->SquaresBefore.size())
{
}

void GivenSystem::startPass()
{
  this->Context.components.restartCounts();
  this->Records.startPass();
}

void GivenSystem::load()
{
  this->Records.load(this->Window.loaded());
}

void GivenSystem::endPass()
{
  this->Records.endPass();
}

std::int64_t GivenSystem::fill(std::int64_t final)
{
  this->take(final);
  const std::int64_t end = this->Records.reachable(this->Closed, this->Taken);
  while (this->Closed < end)
  {
    this->closeRows(std::min(end, this->Records.of(this->Closed).end()));
  }
  // The window releases what is complete: rows must not need it any more, as those that have a
  // known neighbour far away do, which is in no entry of theirs.
  this->Complete = this->Records.reachable(this->Complete, this->Closed);
  this->Records.release(this->Complete);
  return this->Complete;
}

/** Takes the values of the vertices below `end`, block by block. */
void GivenSystem::take(std::int64_t end)
{
  const int columns = this->Columns;
  const int stride = this->Window.stride();
  while (this->Taken < end)
  {
    const SystemRecord& record = this->Records.of(this->Taken);
    const std::int64_t count = std::min(end, record.end()) - this->Taken;
    for (std::vector<double>* values : { &this->Before, &this->B })
    {
      values->assign(static_cast<std::size_t>(count * columns), 0.0);
    }
    unpad(this->Window.up().x.at(this->Taken), stride, columns, count, this->Before.data());
    this->X = this->Before;
    this->Values.give(record, this->Taken, count, this->Before, this->X, this->B);
    // Rows of the identity.
    const std::span<const std::int16_t> known = record.known();
    const std::int64_t from = this->Taken - record.first();
    for (auto k = std::ranges::lower_bound(known, from); k != known.end() && *k < from + count; ++k)
    {
      const std::int64_t place = (*k - from) * columns;
      std::copy_n(this->B.begin() + place, columns, this->X.begin() + place);
    }
    LevelWindow<double>::State& state = this->Window.down();
    pad(this->X.data(), columns, count, state.x.at(this->Taken));
    pad(this->B.data(), columns, count, state.b.at(this->Taken));
    this->Taken += count;
  }
}

/** Closes the rows from Closed to `end`, which are in one block. */
void GivenSystem::closeRows(std::int64_t end)
{
  const SystemRecord& record = this->Records.of(this->Closed);
  if (this->Closed == record.first())
  {
    this->NextLink = this->NextKnown = this->Run = 0;
  }
  LevelWindow<double>::State& state = this->Window.down();
  const std::span<const KnownLink> links = record.links();
  const std::size_t begin = this->NextLink;
  while (this->NextLink < links.size() && record.first() + links[this->NextLink].node < end)
  {
    ++this->NextLink;
  }
  addKnownValues(
    record.first(), links.subspan(begin, this->NextLink - begin), this->Columns, state.x, state.b);
  this->Window.forRange(this->Closed, end, state,
    [this](const auto& rows, const BlockPart<double>& part) { this->addRows(rows, part); });
  this->Closed = end;
}

/** Adds the residuals of the rows of a block. */
template <class Arrays>
void GivenSystem::addRows(const Arrays& rows, const BlockPart<double>& part)
{
  const RowBlock::Header& h = part.header();
  const std::span<const std::int16_t> known = this->Records.of(h.first).known();
  forRuns<double>(h, rows, part.nodes,
    [&](const auto& arrays, BlockRange nodes, auto /*isSpecial*/)
    {
      for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
      {
        if (this->NextKnown < known.size() && known[this->NextKnown] == k)
        {
          ++this->NextKnown;
          continue;
        }
        this->addRow(h, arrays, part, k);
        if (this->hasBefore())
        {
          this->addResidualBefore(h, arrays, k);
        }
      }
    });
}

template <class Arrays>
void GivenSystem::addRow(
  const RowBlock::Header& h, const Arrays& arrays, const BlockPart<double>& part, std::int64_t k)
{
  const SystemRecord& record = this->Records.of(h.first);
  const std::span<const SystemRecord::Run> runs = record.runs();
  while (this->Run + 1 < runs.size() && runs[this->Run + 1].begin <= k)
  {
    ++this->Run;
  }
  const double* x = part.x + k * part.stride;
  const double* b = part.b + k * part.stride;
  const double share = record.shares().empty() ? 1.0 : record.shares()[static_cast<std::size_t>(k)];
  const std::span<const double> residual =
    this->First.add(RowView(h, arrays, k), x, b, part.stride, share);
  const std::int32_t label = runs[this->Run].label;
  if (label < 0)
  {
    return;
  }
  Components& components = this->Context.components;
  const bool floats = components.isFloating(components.root(label));
  const double mass =
    floats
      ? this->Context.labels.block(h.first / RowBlock::Nodes).masses[static_cast<std::size_t>(k)]
      : 0.0;
  this->First.varying.add(label, RowBlock::rowSumOf(h, arrays, k), mass, b, share);
  if (floats)
  {
    components.count(label, b, x, residual.data(), mass);
    if (this->hasBefore())
    {
      this->addMeanBefore(components.root(label), h.first + k, std::max(-mass, 0.0));
    }
  }
}

/** Adds the values of a vertex of a component that may be held loosely, and then has a weight. */
void GivenSystem::addMeanBefore(std::int32_t root, std::int64_t vertex, double weight)
{
  const auto label = static_cast<std::size_t>(root);
  const auto columns = static_cast<std::size_t>(this->Columns);
  if (this->WeightsBefore.empty())
  {
    this->WeightsBefore.resize(static_cast<std::size_t>(this->Context.components.labels()));
    this->SumsBefore.resize(this->WeightsBefore.size() * columns);
  }
  this->WeightsBefore[label] += weight;
  for (std::size_t k = 0; k < columns; ++k)
  {
    this->SumsBefore[label * columns + k] += weight * this->Window.up().x.at(vertex)[k];
  }
}

std::vector<double> GivenSystem::meansBefore() const
{
  std::vector<double> means = this->SumsBefore;
  const auto columns = static_cast<std::size_t>(this->Columns);
  for (std::size_t k = 0; k < means.size(); ++k)
  {
    const double weight = this->WeightsBefore[k / columns];
    means[k] = weight > 0.0 ? means[k] / weight : 0.0;
  }
  return means;
}

/** The final residual of the system before, whose rows pass by here for the last time. */
template <class Arrays>
void GivenSystem::addResidualBefore(const RowBlock::Header& h, const Arrays& arrays, std::int64_t k)
{
  const LevelWindow<double>::State& before = this->Window.up();
  const std::int64_t stride = this->Window.stride();
  const double* x = before.x.at(h.first + k);
  const double* b = before.b.at(h.first + k);
  const RowView row(h, arrays, k);
  const double share = residualShareOf(h, arrays, k);
  for (std::size_t c = 0; c < this->OfRow.size(); ++c)
  {
    this->OfRow[c] = b[c] - row.diagonal * x[c];
  }
  for (std::int64_t e = 0; e < row.size(); ++e)
  {
    const double weight = row.weight(e);
    const double* other = x + row.delta(e) * stride;
    for (std::size_t c = 0; c < this->OfRow.size(); ++c)
    {
      this->OfRow[c] += weight * other[c];
    }
  }
  for (std::size_t c = 0; c < this->OfRow.size(); ++c)
  {
    this->SquaresBefore[c] += share * this->OfRow[c] * (share * this->OfRow[c]);
  }
}

ColumnResiduals GivenSystem::residual(Hierarchy& hierarchy)
{
  this->Context.components.settle();
  checkSquares(this->First.termSquares(), this->First.anyTerm());
  FirstPass::project(this->Context, hierarchy);
  return FirstPass::residualOf(this->First, this->Context.components);
}

double GivenSystem::normBefore(const ColumnScales& scales) const
{
  return std::sqrt(scales.sum(this->SquaresBefore));
}

} // namespace smg
