// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Assembly.h"

#include "Solver/Core/Error.h"
#include "Solver/Problem/RowShortfall.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{
namespace
{

/** Rows are made final in batches of this many, to ask for edge targets in one call. */
constexpr std::int64_t BatchRows = 256;

bool allFinite(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

} // namespace

Assembly::Assembly(Pool& pool, const StreamInfo& info, Problem& problem, AssembledRows& rows,
  Components& components, ComponentLabels& labels, RowListener* listener)
  : Type(info.cellType)
  , Check(info.cellType)
  , Given(problem)
  , Columns(problem.columns())
  , Kind(problem.weights())
  , ConnectsFlat(problem.connectsFlatCells())
  , Out(rows)
  , Parts(components)
  , PartLabels(labels)
  , Listener(listener)
  , Stiff(stiffRows(info.cellType, problem.weights()))
  , Points(pool, 3)
  , Values(pool, problem.columns())
  , Sources(pool, problem.columns())
  , Screening(pool)
  , Mass(pool)
  , Prescribed(pool)
  , Labels(pool)
  , Reach(pool)
  , Edges(pool, OpenEdges::usual(info.cellType))
{
  if (problem.hasCells())
  {
    this->Own.emplace(pool, problem, info.cellType);
  }
}

void Assembly::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->addVertices(block);
  this->addCells(block);
  this->finalize(block.finalized);
}

void Assembly::finish()
{
  this->finalize(this->Vertices);
}

void Assembly::addVertices(const MeshBlock& block)
{
  const std::int64_t count = block.vertices();
  if (count == 0)
  {
    return;
  }
  VertexConditions& given = this->Conditions;
  const auto values = static_cast<std::size_t>(count * this->Columns);
  given.dirichlet.assign(static_cast<std::size_t>(count), -1);
  given.value.assign(values, 0.0);
  given.source.assign(values, 0.0);
  given.screening.assign(static_cast<std::size_t>(count), 0.0);
  this->Given.conditions(block, given);
  if (!allFinite(given.value) || !allFinite(given.source))
  {
    throw Error("a value or source of a vertex between " + std::to_string(this->Vertices) +
                " and " + std::to_string(this->Vertices + count - 1) + " is not a finite number");
  }

  for (std::size_t k = 0; k < given.screening.size(); ++k)
  {
    if (!(given.screening[k] >= 0.0 && std::isfinite(given.screening[k])))
    {
      throw Error("the screening of vertex " +
                  std::to_string(this->Vertices + static_cast<std::int64_t>(k)) +
                  " must be a finite number that is not negative");
    }
  }

  const std::int64_t end = this->Vertices + count;
  this->Points.extendRaw(end);
  this->Values.extendRaw(end);
  this->Sources.extendRaw(end);
  this->Screening.extendRaw(end);
  this->Prescribed.extendRaw(end);
  this->Mass.extend(end);
  this->Labels.extendRaw(end);
  this->Edges.extend(end);
  if (this->Own)
  {
    this->Own->extend(end);
  }
  std::copy(block.positions.begin(), block.positions.end(), this->Points.at(this->Vertices));
  std::copy(given.value.begin(), given.value.end(), this->Values.at(this->Vertices));
  std::copy(given.source.begin(), given.source.end(), this->Sources.at(this->Vertices));
  std::copy(given.screening.begin(), given.screening.end(), this->Screening.at(this->Vertices));
  std::ranges::transform(given.dirichlet, this->Prescribed.at(this->Vertices),
    [](std::int32_t condition) { return condition >= 0 ? 1 : 0; });
  std::ranges::fill(this->Labels.range(this->Vertices, end), -1);
  this->Vertices = end;
}

void Assembly::addCells(const MeshBlock& block)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const auto cells = block.corners.size() / corners;
  const Column* flags = nullptr;
  for (const Column& column : block.cellColumns)
  {
    flags = column.spec.name == CellFlagsName ? &column : flags;
  }
  for (std::size_t c = 0; c < cells; ++c)
  {
    const std::int64_t* cell = block.corners.data() + c * corners;
    if (this->Own)
    {
      this->Own->prepare(block, c, this->Points);
    }
    this->addCell(cell, flags ? static_cast<unsigned>(flags->value(c)) : 0U);
  }
  this->Cells += static_cast<std::int64_t>(cells);
}

void Assembly::addCell(const std::int64_t* corners, unsigned flags)
{
  const double* point[4] = {};
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    point[k] = this->Points.at(corners[k]);
  }
  const bool repeated = hasRepeatedCorner(corners, cornersOf(this->Type));
  CellWeights cell = repeated || flags != 0 ? CellWeights{}
                     : this->Own            ? this->Own->cell()
                                            : cellWeights(this->Type, point);
  if (this->Kind == Weights::Cotangent)
  {
    this->Limited += limitWeights(this->Type, point, cell) ? 1 : 0;
  }
  const bool degenerate = cell.measure == 0.0;
  this->Degenerate += degenerate ? 1 : 0;
  if (!degenerate || (this->ConnectsFlat && !repeated && (flags & DuplicateCell) == 0))
  {
    this->connect(corners, cell);
  }
}

/** The corners belong together, with these weights of the edges, which are 0 if the cell is flat.
 */
void Assembly::connect(const std::int64_t* corners, const CellWeights& cell)
{
  std::int32_t label = -1;
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    const std::int32_t other = this->Labels[corners[k]];
    label = label < 0                     ? other
            : other < 0 || other == label ? label
                                          : this->Parts.join(label, other);
  }
  label = label < 0 ? this->Parts.add() : label;
  const double mass = cell.measure / cornersOf(this->Type);
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    this->Labels[corners[k]] = label;
    this->Mass[corners[k]] += mass;
  }

  for (int e = 0; e < edgesOf(this->Type); ++e)
  {
    const int* ends = edgeCorners(this->Type, e);
    const std::int64_t a = corners[ends[0]];
    const std::int64_t b = corners[ends[1]];
    if (cell.measure == 0.0 && !this->hasLength(a, b))
    {
      continue;
    }
    double& weight = this->Edges.weight(a, b);
    weight = this->Kind == Weights::Uniform ? 1.0 : weight + cell.weight[e];
    if (this->Own)
    {
      this->Own->connect(a, b);
    }
  }
}

/** Whether an edge has a weight even in a cell without one. */
bool Assembly::hasLength(std::int64_t a, std::int64_t b) const
{
  return this->Kind == Weights::Uniform ||
         static_cast<float>(cotangentFloor(this->Type, this->Points.at(a), this->Points.at(b))) > 0;
}

void Assembly::finalize(std::int64_t end)
{
  this->Reach.extendRaw(std::max(end, this->Reach.end()));
  const bool targets = this->Given.hasEdgeTargets();
  while (this->Final < end)
  {
    const std::int64_t begin = this->Final;
    const std::int64_t stop = std::min(end, begin + BatchRows);
    this->Neighbours.clear();
    this->RowEnds.clear();
    for (std::int64_t i = begin; i < stop; ++i)
    {
      this->collectRow(i);
    }
    if (targets)
    {
      this->applyEdgeTargets(begin);
    }
    this->LabelBatch.clear();
    std::size_t first = 0;
    for (std::int64_t i = begin; i < stop; ++i)
    {
      const std::size_t last = this->RowEnds[static_cast<std::size_t>(i - begin)];
      const double* target =
        targets ? this->Targets.data() + first * static_cast<std::size_t>(this->Columns) : nullptr;
      this->closeRow(i, this->Neighbours.data() + first, last - first, target);
      if (this->Listener)
      {
        this->Listener->close(this->Points.at(i), this->Reach[i]);
      }
      first = last;
    }
    this->PartLabels.append(this->LabelBatch);
    this->Final = stop;
  }
  while (this->Done < this->Final && this->Reach[this->Done] < this->Final)
  {
    ++this->Done;
  }
  this->Points.release(this->Done);
  this->Values.release(this->Done);
  this->Prescribed.release(this->Done);
  this->Reach.release(this->Done);
  this->Sources.release(this->Final);
  this->Screening.release(this->Final);
  this->Mass.release(this->Final);
  this->Labels.release(this->Final);
  this->Edges.release(this->Final);
  if (this->Own)
  {
    this->Own->release(this->Final);
  }
}

/** Appends the neighbours of vertex i, with the weights as they are stored, to the batch. */
void Assembly::collectRow(std::int64_t i)
{
  this->Edges.take(i, this->Row);
  const OpenEdge* scales = this->Own ? this->Own->takeScales(i).data() : nullptr;
  for (std::size_t e = 0; e < this->Row.size(); ++e)
  {
    const std::int64_t j = this->Row[e].to;
    double weight = this->Row[e].weight;
    if (this->Kind == Weights::Clamped)
    {
      const double floor = (scales ? scales[e].weight : 1.0) *
                           cotangentFloor(this->Type, this->Points.at(i), this->Points.at(j));
      this->Clamped += weight < floor ? 1 : 0;
      weight = std::max(weight, floor);
    }
    if (this->Own && this->Kind != Weights::Uniform)
    {
      this->Own->requireRange(weight, i, j);
    }
    if (!std::isfinite(static_cast<float>(weight)))
    {
      throw Error("the weight of the edge between vertices " + std::to_string(i) + " and " +
                  std::to_string(j) +
                  " is too large: the cells there are almost flat; use uniform weights");
    }
    this->Neighbours.push_back({ j, static_cast<float>(weight) });
  }
  this->RowEnds.push_back(this->Neighbours.size());
  const std::int64_t last = this->Row.empty() ? i : std::max(i, this->Row.back().to);
  this->LastReach = std::max(this->LastReach, last);
  this->Reach[i] = this->LastReach;
}

void Assembly::applyEdgeTargets(std::int64_t begin)
{
  const std::size_t edges = this->Neighbours.size();
  this->From.resize(edges);
  this->To.resize(edges);
  this->FromPoints.resize(3 * edges);
  this->ToPoints.resize(3 * edges);
  this->Targets.assign(edges * static_cast<std::size_t>(this->Columns), 0.0);
  std::int64_t i = begin;
  for (std::size_t e = 0; e < edges; ++e)
  {
    while (e >= this->RowEnds[static_cast<std::size_t>(i - begin)])
    {
      ++i;
    }
    this->From[e] = i;
    this->To[e] = this->Neighbours[e].to;
    std::copy_n(this->Points.at(i), 3, this->FromPoints.data() + 3 * e);
    std::copy_n(this->Points.at(this->To[e]), 3, this->ToPoints.data() + 3 * e);
  }
  EdgeBatch batch{ this->From, this->To, this->FromPoints, this->ToPoints, this->Targets };
  this->Given.edgeTargets(batch);
  if (!allFinite(this->Targets))
  {
    throw Error("an edge target near vertex " + std::to_string(begin) + " is not a finite number");
  }
}

/** Row, right-hand side and initial value of vertex i; target: `Columns` values a neighbour. */
void Assembly::closeRow(
  std::int64_t i, const Neighbour* neighbours, std::size_t count, const double* target)
{
  const double* x = this->Values.at(i);
  this->Out.x.insert(this->Out.x.end(), x, x + this->Columns);
  this->Out.b.resize(this->Out.x.size());
  double* b = this->Out.b.data() + (this->Out.b.size() - static_cast<std::size_t>(this->Columns));
  const std::int32_t label = this->Labels[i] < 0 ? -1 : this->Parts.root(this->Labels[i]);
  this->LabelBatch.push_back(label);

  const bool prescribed = this->Prescribed[i] != 0;
  const double screening = this->Screening[i] * this->Mass[i];
  const bool held = !prescribed && count == 0 && screening == 0.0;
  if (prescribed || held)
  {
    this->PrescribedCount += prescribed ? 1 : 0;
    this->Held += held ? 1 : 0;
    if (label >= 0)
    {
      this->Parts.anchor(label);
    }
    std::copy_n(x, this->Columns, b);
    if (this->Listener)
    {
      this->Listener->constraint(x);
    }
    this->Out.rows.open(0);
    this->Out.rows.close(0, 1.0, -1);
    return;
  }

  double alpha = screening;
  for (int k = 0; k < this->Columns; ++k)
  {
    b[k] = this->Mass[i] * this->Sources.at(i)[k];
  }
  this->Constraint.assign(b, b + this->Columns);
  RowEntry* row = this->Out.rows.open(static_cast<std::int64_t>(count));
  std::int64_t size = 0;
  double squares[2] = { 0.0, 0.0 };
  for (std::size_t e = 0; e < count; ++e)
  {
    const Neighbour& neighbour = neighbours[e];
    const double weight = neighbour.weight;
    const bool known = this->Prescribed[neighbour.to] != 0;
    const double* other = this->Values.at(neighbour.to);
    const auto term = [&](int k)
    {
      return weight * ((known ? other[k] : 0.0) +
                        (target ? target[e * static_cast<std::size_t>(this->Columns) +
                                         static_cast<std::size_t>(k)]
                                : 0.0));
    };
    for (int k = 0; k < this->Columns; ++k)
    {
      b[k] += term(k);
    }
    const std::int64_t delta = neighbour.to - i;
    if (delta > RowEntry::MostDistance || delta < -RowEntry::MostDistance)
    {
      throw Error("vertices " + std::to_string(i) + " and " + std::to_string(neighbour.to) +
                  " share an edge but lie too far apart in the stream: convert the mesh with the "
                  "order bfs");
    }
    if (!known)
    {
      row[size++] = { static_cast<std::int32_t>(delta), neighbour.weight };
      if (this->Listener && target)
      {
        this->Listener->target(target + e * static_cast<std::size_t>(this->Columns));
      }
      continue;
    }
    alpha += weight;
    if (this->Listener)
    {
      this->Listener->link(static_cast<std::int32_t>(delta), neighbour.weight);
      for (int k = 0; k < this->Columns; ++k)
      {
        this->Constraint[static_cast<std::size_t>(k)] += term(k);
      }
    }
  }
  if (this->Kind == Weights::Cotangent)
  {
    const double raise = rowShortfall({ row, static_cast<std::size_t>(size) }, alpha);
    this->Raised += raise > 0.0 ? 1 : 0;
    alpha += raise;
    for (int k = 0; k < this->Columns; ++k)
    {
      b[k] += raise * x[k];
      this->Constraint[static_cast<std::size_t>(k)] += raise * x[k];
    }
  }
  float least = 0.0F;
  for (std::int64_t e = 0; this->Stiff.any() && e < size; ++e)
  {
    least = std::min(least, row[e].weight());
  }
  this->Out.rows.close(size, alpha, -1, this->Stiff(least));
  if (this->Listener)
  {
    this->Listener->constraint(this->Constraint.data());
  }

  const double diagonal = diagonalOf({ row, static_cast<std::size_t>(size) }, alpha);
  for (int k = 0; k < this->Columns; ++k)
  {
    double sum = b[k] - diagonal * x[k];
    for (std::int64_t e = 0; e < size; ++e)
    {
      sum += static_cast<double>(row[e].weight()) * this->Values.at(i + row[e].delta())[k];
    }
    squares[0] += sum * sum;
    squares[1] += b[k] * b[k] + diagonal * diagonal * x[k] * x[k];
  }
  this->InitialSquares += squares[0];
  this->TermSquares += squares[1];
  if (screening > 0.0)
  {
    this->Parts.anchor(label);
  }
  this->Parts.count(label, b, x);
}

} // namespace smg
