// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/ExtendedEngine.h"

namespace smg
{

// The kernels are compiled here, with the flags of the library: the same bits on every machine.
template class Level<double, GaussSeidel>;
template class Level<float, GaussSeidel>;
template class Hierarchy<GaussSeidel>;
template class FirstPass<Extended>;
template class Pass<GaussSeidel>;
template class Iteration<GaussSeidel>;

} // namespace smg
