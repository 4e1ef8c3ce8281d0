// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/FirstPass.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/Iteration.h"
#include "Solver/Multigrid/Engine/Pass.h"
#include "Solver/Multigrid/Extended.h"

namespace smg
{

// The parts of a solve with the default operator set, instantiated once in the library, for solve()
// and deform(). Programs with operators of their own instantiate the templates for these.
extern template class Level<double, GaussSeidel>;
extern template class Level<float, GaussSeidel>;
extern template class Hierarchy<GaussSeidel>;
extern template class FirstPass<Extended>;
extern template class Pass<GaussSeidel>;
extern template class Iteration<GaussSeidel>;

} // namespace smg
