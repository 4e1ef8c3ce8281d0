// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/FirstPass.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/Iteration.h"
#include "Solver/Engine/Pass.h"
#include "Solver/Operators/Extended.h"

namespace smg
{

// The parts of a solve with the default operator set, instantiated once in the library for solve()
// and deform().
extern template class Level<double, GaussSeidel>;
extern template class Level<float, GaussSeidel>;
extern template class Hierarchy<GaussSeidel>;
extern template class FirstPass<Extended>;
extern template class Pass<GaussSeidel>;
extern template class Iteration<GaussSeidel>;

} // namespace smg
