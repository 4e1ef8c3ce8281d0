// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/RotationProblem.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The first problem of a deformation: rotation vectors and logarithms of scales, harmonic between
// the handles. Both enter the equations linearly and without ambiguity, unlike unit quaternions,
// whose signs are arbitrary. Their initial value is 0, no rotation, which components of the mesh
// without handles keep.

namespace smg
{

void RotationProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  this->At.clear(vertices);
  this->Given.at(block, this->At);
  checkSize(this->At, block.vertices());
  for (std::size_t k = 0; k < vertices; ++k)
  {
    // Of a free vertex only the mask counts; its other numbers may be anything.
    if (this->At.mask[k] == 0)
    {
      continue;
    }
    const std::int64_t i = block.firstVertex + static_cast<std::int64_t>(k);
    checkHeld(this->At, k, i);
    // There is one Dirichlet condition, number 0.
    conditions.dirichlet[k] = 0;
    double* value = conditions.value.data() + Columns * k;
    std::copy_n(this->At.rotation.data() + 3 * k, 3, value);
    value[3] = this->At.logScale[k];
    // The target belongs to the second problem, for which it is kept.
    if (this->TakeTarget)
    {
      this->TakeTarget(i, this->At.target.data() + 3 * k);
    }
    this->Shared += this->At.mask[k] > 1 ? 1 : 0;
  }
}

void checkSize(const VertexHandles& handles, std::int64_t vertices)
{
  const auto n = static_cast<std::size_t>(vertices);
  if (handles.mask.size() != n || handles.target.size() != 3 * n ||
      handles.rotation.size() != 3 * n || handles.logScale.size() != n)
  {
    throw Error("the handles of " + std::to_string(handles.mask.size()) +
                " vertices were given for " + std::to_string(n) +
                ": a mask, a target, a rotation and a scale are needed for each");
  }
}

/** Names the vertex by its stream index: handles need not know any other number. */
void checkHeld(const VertexHandles& handles, std::size_t k, std::int64_t i)
{
  // A scale of 1e20: beyond it, the coarse levels, which have single precision, would overflow.
  constexpr double LargestLogScale = 46.0;
  const auto finite = [k](const std::vector<double>& v)
  { return std::isfinite(v[3 * k]) && std::isfinite(v[3 * k + 1]) && std::isfinite(v[3 * k + 2]); };
  const double logScale = handles.logScale[k];
  const char* wrong = !finite(handles.target)     ? "target"
                      : !finite(handles.rotation) ? "rotation"
                      : !std::isfinite(logScale)  ? "scale"
                                                  : nullptr;
  if (wrong)
  {
    throw Error(std::string("the ") + wrong + " that a handle gives to vertex " +
                std::to_string(i) + " is not a finite number");
  }
  if (std::fabs(logScale) > LargestLogScale)
  {
    throw Error("the scale that a handle gives to vertex " + std::to_string(i) +
                " is e to the power of " + std::to_string(logScale) +
                ": use one between 1e-20 and 1e20");
  }
}

} // namespace smg
