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

/** Calls f(group) for the columns of two vectors, as many at a time as the levels have. */
template <class F>
void LinearEngine::forGroups(std::span<const double> in, std::span<const double> out, F&& f)
{
  const auto vertices = static_cast<std::size_t>(this->vertices());
  if (in.size() != out.size() || in.empty() || in.size() % vertices != 0)
  {
    throw Error("two vectors with as many numbers for each of the " + std::to_string(vertices) +
                " vertices are needed, but there are " + std::to_string(in.size()) + " and " +
                std::to_string(out.size()) + " numbers");
  }
  const std::size_t all = in.size() / vertices, most = static_cast<std::size_t>(this->Columns);
  for (std::size_t first = 0; first < all; first += most)
  {
    f(Group{ first, std::min(most, all - first), all });
  }
}

namespace
{

/** Throws Error if a number of the columns [first, first + count) of `all` is not finite. */
void checkFinite(std::span<const double> values, std::size_t first, std::size_t count,
  std::size_t all, const char* what)
{
  for (std::size_t i = 0; i * all < values.size(); ++i)
  {
    for (const double value : values.subspan(i * all + first, count))
    {
      if (!std::isfinite(value))
      {
        throw Error(std::string(what) + " has a number that is not finite at vertex " +
                    std::to_string(i) + " of the stream");
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
  this->Context.progress = SolveProgress(progress);
  this->Context.beginAgain();
  Report& r = this->Context.report;
  r.converged = true;
  r.relative_to = BestConstant;
  std::vector<double> removed;
  this->forGroups(b, x,
    [&](const Group& group)
    {
      checkFinite(b, group.first, group.count, group.all, "the right-hand side");
      checkFinite(x, group.first, group.count, group.all, "the initial guess");
      const auto share = [&](std::size_t columns)
      { return static_cast<double>(columns) / static_cast<double>(group.all); };
      this->Context.progress.begin(
        stopping, share(group.first), share(group.first + group.count), false);
      this->solve(group, b, x, stopping);
      std::vector<double> taken = std::exchange(r.removed_source, {});
      taken.resize(group.count);
      removed.insert(removed.end(), taken.begin(), taken.end());
      this->read(group, x);
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

/** Columns of vectors that a program gives; the columns that are missing are zero. */
class GivenVectors final : public SystemValues
{
public:
  /** `right`, `initial`: from the first number of the first column on, `all` numbers per vertex. */
  GivenVectors(const double* right, const double* initial, std::size_t all, std::size_t count)
    : Right(right)
    , Initial(initial)
    , All(all)
    , Count(count)
  {
  }

  void give(const SystemRecord& /*record*/, std::int64_t first, std::int64_t count,
    std::span<const double> /*before*/, std::span<double> x, std::span<double> b) override
  {
    const std::size_t columns = b.size() / static_cast<std::size_t>(count);
    std::ranges::fill(x, 0.0);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    {
      const std::size_t from = (static_cast<std::size_t>(first) + k) * this->All;
      std::copy_n(this->Initial + from, this->Count, x.data() + k * columns);
      std::copy_n(this->Right + from, this->Count, b.data() + k * columns);
    }
  }

private:
  const double *Right, *Initial;
  std::size_t All, Count;
};

} // namespace

void LinearEngine::solve(
  const Group& group, std::span<const double> b, std::span<double> x, const Stopping& stopping)
{
  Convergence convergence(stopping, {});
  Iteration iteration(this->Context, this->System.levels(), convergence);
  GivenVectors vectors(b.data() + group.first, x.data() + group.first, group.all, group.count);
  GivenSystem next(this->Context, this->Records, this->System.window(), vectors, this->Columns);
  this->System.restart(next);
  const ColumnResiduals columns = next.residual(this->System.levels());
  this->Context.scales = ColumnScales(columns.references, this->VectorSize);
  convergence = Convergence(stopping, this->Context.scales.of(columns));
  // As for a first pass: see PoissonSolver.
  convergence.begin(
    this->System.levels().residualNorm(), !this->Context.components.shiftsRightSide());
  this->Context.endPass(convergence.initial());
  iteration.run(false);
  Report& r = this->Context.report;
  const std::string name = group.name();
  convergence.addStep(r, name, group.count < group.all ? name + ": " : std::string());
  r.converged = r.converged && convergence.converged();
  this->Context.free.fix(this->System.window(), r);
}

/** Stores the solution, with what the equations leave open. */
void LinearEngine::read(const Group& group, std::span<double> x)
{
  const Ring<double>& solved = this->System.window().x();
  std::vector<double> values(static_cast<std::size_t>(this->Columns));
  if (this->Context.components.floatingComponents() == 0)
  {
    this->store(solved, 1.0, group, x);
    return;
  }
  for (std::int64_t i = 0; i < this->vertices(); ++i)
  {
    std::copy_n(solved.at(i), values.size(), values.begin());
    this->Context.free.complete(i, 1, values);
    std::copy_n(values.begin(), group.count,
      x.begin() +
        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * group.all + group.first));
  }
}

void LinearEngine::precondition(std::span<const double> r, std::span<double> z)
{
  LevelWindow<double>& window = this->System.window();
  this->forGroups(r, z,
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
  this->forGroups(x, y,
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
