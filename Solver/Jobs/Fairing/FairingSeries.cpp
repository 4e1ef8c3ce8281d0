// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/FairingSeries.h"

#include "Solver/Multigrid/Engine/GivenSystem.h"
#include "Solver/Multigrid/Engine/Iteration.h"
#include "Solver/Multigrid/Extended.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

// Divided by t, the diagonals have the masses m / t besides the edges (FairingProblem). So the
// right-hand side of a further step is that part of the diagonal times the values before, and the
// known values stay what they are.

namespace smg
{
namespace
{

class SmoothedValues final : public SystemValues
{
public:
  explicit SmoothedValues(FreeComponents& components)
    : Open(components)
  {
  }

  void give(const SystemRecord& record, std::int64_t first, std::int64_t count,
    std::span<const double> /*before*/, std::span<double> x, std::span<double> b) override
  {
    // The constants of components that are held loosely are not in the iterates.
    this->Open.complete(first, count, x);
    const std::size_t columns = x.size() / static_cast<std::size_t>(count);
    const std::int64_t from = first - record.first();
    const std::span<const double> masses = record.rowSums();
    for (std::size_t k = 0; k < x.size() && !masses.empty(); ++k)
    {
      b[k] = masses[static_cast<std::size_t>(from) + k / columns] * x[k];
    }
    for (const std::int16_t node : record.known())
    {
      if (node >= from && node < from + count)
      {
        const auto place =
          static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node - from) * columns);
        std::copy_n(x.begin() + place, columns, b.begin() + place);
      }
    }
  }

private:
  FreeComponents& Open;
};

} // namespace

FairingSeries::FairingSeries(CellType cells, int columns, int steps, const SolveOptions& options)
  : Columns(columns)
  , Steps(steps)
  , StoppingRule{ options.tolerance, options.maxCycles }
  , Current(this->StoppingRule, {})
  , System(compiled(Extended::forCells(cells)), columns, options)
  , Context(this->System.context())
  , Records(this->Context.pool, KeptRowSums::Own)
{
  if (steps > 1 && this->Context.scratch)
  {
    this->Records.useScratch(*this->Context.scratch, this->Context.traffic);
  }
}

std::unique_ptr<Solution> FairingSeries::run(MeshSource& mesh, FairingProblem& first)
{
  Report& r = this->Context.report;
  this->Context.beginReport();
  this->Context.mayMeasureFlow = true;
  this->beginProgress(1);
  this->begin(this->System.build(mesh, first, this->Steps > 1 ? &this->Records : nullptr));
  this->Records.finish();
  r.converged = true;
  for (int step = 1; step <= this->Steps; ++step)
  {
    Iteration(this->Context, this->System.levels(), this->Current).run(step < this->Steps);
    step < this->Steps ? this->advance(step) : this->end(step);
  }
  r.relative_to = MeshAtRest;
  this->Context.free.fix(this->System.window(), first, r);
  r.seconds.solve = this->Context.seconds() - r.seconds.build;
  this->Context.finishReport();
  this->Context.progress.finish();
  return this->System.takeSolution();
}

/** Ends a step and begins the next one, in one pass. */
void FairingSeries::advance(int step)
{
  this->Context.free.prepare();
  SmoothedValues values(this->Context.free);
  GivenSystem next(this->Context, this->Records, this->System.window(), values, this->Columns,
    this->Current.reference());
  this->System.advance(next);
  // A constant that is added to the values is added to those of the next step.
  this->Context.free.setExcess(next.meansBefore());
  if (!this->Current.done())
  {
    this->Current.add(next.normBefore(this->Context.scales));
  }
  this->end(step);
  this->beginProgress(step + 1);
  this->begin(next.residual(this->System.levels()));
}

/** To be called after the pass that begins a step, with the residual of its initial values. */
void FairingSeries::begin(const ColumnResiduals& residual)
{
  FirstResidual first = residual.alone();
  // Later steps change little: they are measured against the first one, as their errors are.
  this->Reference = std::max(this->Reference, first.reference);
  first.reference = this->Reference;
  this->System.begin(this->Current, this->StoppingRule, first);
}

void FairingSeries::end(int step)
{
  Report& r = this->Context.report;
  this->Current.addStep(r, "step " + std::to_string(step), "");
  r.converged = r.converged && this->Current.converged();
}

void FairingSeries::beginProgress(int step)
{
  const double all = this->Steps;
  this->Context.progress.begin(this->StoppingRule, (step - 1) / all, step / all, step == 1);
}

} // namespace smg
