// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/LinearEngine.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Engine/GivenSystem.h"
#include "Solver/Multigrid/Engine/Iteration.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

// The order of all sums is that of a first pass and of the passes after it. So a solution has the
// bits of smg::solve() in core, whatever was solved before, and an exception leaves nothing behind
// that the next call would see.

namespace smg
{
namespace
{

/** Removes sentences that are there already. */
void removeRepetitions(std::vector<std::string>& sentences)
{
  std::vector<std::string> first;
  for (std::string& sentence : sentences)
  {
    if (std::ranges::find(first, sentence) == first.end())
    {
      first.push_back(std::move(sentence));
    }
  }
  sentences = std::move(first);
}

} // namespace

LinearEngine::LinearEngine(CompiledOperators operators, int columns, const SolveOptions& options)
  : Columns(columns)
  , System(std::move(operators), columns, options)
  , Context(this->System.context())
  , Records(this->Context.pool, KeptRowSums::None)
{
  if (this->Context.scratch)
  {
    this->Records.useScratch(*this->Context.scratch, this->Context.traffic);
  }
}

void LinearEngine::build(MeshSource& mesh, Problem& problem)
{
  this->Context.beginReport();
  this->Context.progress.beginFirst();
  this->Context.mayMeasureFlow = true;
  this->VectorSize = problem.vectorSize();
  this->System.build(mesh, problem, &this->Records);
  this->Records.finish();
  this->Context.finishReport();
  this->Context.progress.finish();
}

std::string LinearEngine::Group::name() const
{
  const std::string from = std::to_string(this->first + 1);
  return this->count == 1 ? "column " + from
                          : "columns " + from + " to " + std::to_string(this->first + this->count);
}

/** The numbers of a vertex in two vectors. Throws Error unless they have as many for each. */
std::size_t LinearEngine::columnsOf(std::span<const double> in, std::span<const double> out) const
{
  const auto vertices = static_cast<std::size_t>(this->vertices());
  if (in.size() != out.size() || in.empty() || in.size() % vertices != 0)
  {
    throw Error("two vectors with as many numbers for each of the " + std::to_string(vertices) +
                " vertices are needed, but there are " + std::to_string(in.size()) + " and " +
                std::to_string(out.size()) + " numbers");
  }
  return in.size() / vertices;
}

/** Calls f(group) for `all` columns, as many at a time as the levels have. */
template <class F>
void LinearEngine::forGroups(std::size_t all, F&& f)
{
  const auto most = static_cast<std::size_t>(this->Columns);
  for (std::size_t first = 0; first < all; first += most)
  {
    f(Group{ first, std::min(most, all - first), all });
  }
}

namespace
{

/** Throws Error if a number of the columns [first, first + count) of `all` is not finite; the
 * values begin with those of a vertex of the stream. */
void checkFinite(std::span<const double> values, std::size_t first, std::size_t count,
  std::size_t all, const char* what, std::int64_t vertex = 0)
{
  for (std::size_t i = 0; i * all < values.size(); ++i)
  {
    for (const double value : values.subspan(i * all + first, count))
    {
      if (!std::isfinite(value))
      {
        throw Error(std::string(what) + " has a number that is not finite at vertex " +
                    std::to_string(vertex + static_cast<std::int64_t>(i)) + " of the stream");
      }
    }
  }
}

} // namespace

/** Copies columns to a vector of the finest level; those that a group lacks are zero. */
void LinearEngine::load(
  std::span<const double> values, const Group& group, const char* what, Ring<double>& to)
{
  checkFinite(values, group.first, group.count, group.all, what);
  double* lanes = to.range(0, this->vertices()).data();
  const double* of = values.data() + group.first;
  for (std::int64_t i = 0; i < this->vertices(); ++i, of += group.all, lanes += to.lanes())
  {
    std::copy_n(of, group.count, lanes);
    std::fill(lanes + group.count, lanes + to.lanes(), 0.0);
  }
}

/** The inverse of load(), times a factor. */
void LinearEngine::store(
  const Ring<double>& from, double factor, const Group& group, std::span<double> values)
{
  const double* lanes = from.range(0, this->vertices()).data();
  double* of = values.data() + group.first;
  for (std::int64_t i = 0; i < this->vertices(); ++i, of += group.all, lanes += from.lanes())
  {
    for (std::size_t k = 0; k < group.count; ++k)
    {
      of[k] = factor * lanes[k];
    }
  }
}

void LinearEngine::solve(std::span<const double> b, std::span<double> x, const Stopping& stopping,
  const ProgressFunction& progress)
{
  const auto all = static_cast<std::int64_t>(this->columnsOf(b, x));
  // Calls f(place in a block, place in a vector) for its vertices.
  const auto forVertices = [all](const VectorBlock& block, auto&& f)
  {
    for (std::int64_t i = 0; i < block.count; ++i)
    {
      f(i * block.columns, (block.first + i) * all + block.column);
    }
  };
  const auto give = [&](
                      const VectorBlock& block, std::span<double> right, std::span<double> initial)
  {
    forVertices(block,
      [&](std::int64_t to, std::int64_t from)
      {
        std::copy_n(b.begin() + from, block.columns, right.begin() + to);
        std::copy_n(x.begin() + from, block.columns, initial.begin() + to);
      });
  };
  const auto take = [&](const VectorBlock& block, std::span<const double> solution)
  {
    forVertices(block, [&](std::int64_t from, std::int64_t to)
      { std::copy_n(solution.begin() + from, block.columns, x.begin() + to); });
  };
  this->solve({ all, give, take }, stopping, progress);
}

void LinearEngine::solve(
  const LinearVectors& vectors, const Stopping& stopping, const ProgressFunction& progress)
{
  this->Context.progress = SolveProgress(progress);
  this->Context.beginAgain();
  Report& r = this->Context.report;
  r.converged = true;
  r.relative_to = BestConstant;
  std::vector<double> removed;
  this->forGroups(static_cast<std::size_t>(vectors.columns),
    [&](const Group& group)
    {
      const auto share = [&](std::size_t columns)
      { return static_cast<double>(columns) / static_cast<double>(group.all); };
      this->Context.progress.begin(
        stopping, share(group.first), share(group.first + group.count), false);
      this->solve(group, vectors, stopping);
      std::vector<double> taken = std::exchange(r.removed_source, {});
      taken.resize(group.count);
      removed.insert(removed.end(), taken.begin(), taken.end());
      this->take(group, vectors);
    });
  if (std::ranges::any_of(removed, [](double sum) { return sum != 0.0; }))
  {
    r.removed_source = std::move(removed);
  }
  // A single problem has no steps.
  if (r.steps.size() == 1)
  {
    r.steps.clear();
  }
  r.seconds.solve = this->Context.seconds();
  this->Context.finishReport();
  removeRepetitions(r.notes);
  removeRepetitions(r.warnings);
  this->Context.progress.finish();
}

namespace
{

/** The columns of a group as a system; the columns that it lacks are zero. */
class GroupValues final : public SystemValues
{
public:
  GroupValues(const GivenVectors& give, std::size_t first, std::size_t count)
    : Give(give)
    , First(static_cast<std::int64_t>(first))
    , Count(static_cast<std::int64_t>(count))
  {
  }

  void give(const SystemRecord& /*record*/, std::int64_t first, std::int64_t count,
    std::span<const double> /*before*/, std::span<double> x, std::span<double> b) override
  {
    const std::int64_t columns = static_cast<std::int64_t>(b.size()) / count;
    this->X.assign(static_cast<std::size_t>(count * this->Count), 0.0);
    this->B = this->X;
    this->Give({ first, count, this->First, this->Count }, this->B, this->X);
    const auto all = static_cast<std::size_t>(this->Count);
    checkFinite(this->B, 0, all, all, "the right-hand side", first);
    checkFinite(this->X, 0, all, all, "the initial guess", first);
    std::ranges::fill(x, 0.0);
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::copy_n(this->X.begin() + i * this->Count, this->Count, x.begin() + i * columns);
      std::copy_n(this->B.begin() + i * this->Count, this->Count, b.begin() + i * columns);
    }
  }

private:
  const GivenVectors& Give;
  std::int64_t First, Count;
  std::vector<double> X, B;
};

} // namespace

void LinearEngine::solve(const Group& group, const LinearVectors& vectors, const Stopping& stopping)
{
  Convergence convergence(stopping, {});
  Iteration iteration(this->Context, this->System.levels(), convergence);
  GroupValues values(vectors.give, group.first, group.count);
  GivenSystem next(this->Context, this->Records, this->System.window(), values, this->Columns);
  this->System.restart(next);
  const ColumnResiduals columns = next.residual(this->System.levels());
  this->Context.scales = ColumnScales(columns.references, this->VectorSize);
  this->System.begin(convergence, stopping, this->Context.scales.of(columns));
  iteration.run(false);
  Report& r = this->Context.report;
  const std::string name = group.name();
  convergence.addStep(r, name, group.count < group.all ? name + ": " : std::string());
  r.converged = r.converged && convergence.converged();
  this->Context.free.fix(this->System.window(), r);
}

/** Gives the solution, with what the equations leave open. */
void LinearEngine::take(const Group& group, const LinearVectors& vectors)
{
  const auto count = static_cast<std::int64_t>(group.count);
  std::vector<double> values, taken;
  for (std::int64_t first = 0; first < this->vertices(); first += RowBlock::Nodes)
  {
    const std::int64_t n = std::min(RowBlock::Nodes, this->vertices() - first);
    values.resize(static_cast<std::size_t>(n * this->Columns));
    taken.resize(static_cast<std::size_t>(n * count));
    this->Context.readCompleted(this->System.window(), first, n, values);
    unpad(values.data(), this->Columns, static_cast<int>(count), n, taken.data());
    vectors.take({ first, n, static_cast<std::int64_t>(group.first), count }, taken);
  }
}

void LinearEngine::precondition(std::span<const double> r, std::span<double> z)
{
  LevelWindow<double>& window = this->System.window();
  this->forGroups(this->columnsOf(r, z),
    [&](const Group& group)
    {
      this->load(r, group, "the residual", window.b());
      double largest = 0.0;
      for (const double value : window.b().range(0, window.nodes()))
      {
        largest = std::max(largest, std::fabs(value));
      }
      this->System.levels().runSymmetric(largest);
      this->store(window.x(), 1.0, group, z);
    });
}

/** Adds w_ij x_j of the neighbours with rows of the identity to b. */
void LinearEngine::addKnown(LevelWindow<double>& window)
{
  this->Records.startPass();
  for (std::int64_t i = 0; i < window.nodes();)
  {
    const SystemRecord record = this->Records.next();
    addKnownValues(record.first(), record.links(), window.columns(), window.x(), window.b());
    i = record.end();
  }
  this->Records.endPass();
}

/** With b = 0 the residual is -A x; the neighbours whose rows are those of the identity are part of
 * b. */
void LinearEngine::multiply(std::span<const double> x, std::span<double> y)
{
  LevelWindow<double>& window = this->System.window();
  this->forGroups(this->columnsOf(x, y),
    [&](const Group& group)
    {
      this->load(x, group, "the vector", window.x());
      std::ranges::fill(window.b().range(0, window.nodes()), 0.0);
      this->addKnown(window);
      this->System.levels().finest().residualAll(window.b().at(0));
      this->store(window.b(), -1.0, group, y);
    });
}

} // namespace smg
