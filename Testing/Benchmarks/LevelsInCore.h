// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Extended.h"
#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "Testing/Support/MemorySource.h"

namespace smg::benchmark
{

/** The levels of a solve in core, between two passes. */
class LevelsInCore
{
public:
  static constexpr int Columns = 3;

  /** `linear`: whether rows of P that cancel may reproduce linear functions (LinearRows). */
  LevelsInCore(const testing::StreamMesh& mesh, int sweeps, bool linear = true)
    : Run(Columns, options(sweeps))
    , Levels(this->Run, Columns, compiledRelaxation<GaussSeidel>)
  {
    testing::MemorySource source(mesh);
    FixedEndsProblem problem(source.info());
    CompiledOperators operators = compiled(Extended::forCells(mesh.cellType));
    // Without positions rows stay as they are.
    operators.readsPositions = operators.readsPositions && linear;
    FirstPass(this->Run, this->Levels, operators).run(source, problem);
    this->Levels.startPass(false);
  }

  int count() { return static_cast<int>(this->Levels.storage().sizes.size()); }
  const Report::Level& size(int l)
  {
    return this->Levels.storage().sizes[static_cast<std::size_t>(l)];
  }
  Level<double>& finest() { return this->Levels.finest(); }
  /** Level l, from 1 on. */
  Level<float>& coarse(int l)
  {
    return *this->Levels.storage().coarse[static_cast<std::size_t>(l - 1)];
  }

  /** Calls f with level l. */
  template <class F>
  void with(int l, F&& f)
  {
    l == 0 ? f(this->finest()) : f(this->coarse(l));
  }

private:
  static SolveOptions options(int sweeps)
  {
    SolveOptions options;
    options.inCore = true;
    options.memoryLimit = std::int64_t(1) << 40;
    options.sweeps = sweeps;
    options.coreNodes = std::int64_t(1) << 40;
    options.threads = 1;
    return options;
  }

  SolveContext Run;
  Hierarchy Levels;
};

} // namespace smg::benchmark
