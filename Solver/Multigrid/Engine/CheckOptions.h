// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"
#include "smg/Smooth.h"
#include "smg/Solve.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace smg
{

/** Throws Error with this sentence unless the condition holds. */
void require(bool holds, const std::string& sentence);

/** What smooth() is asked for. */
struct Smoothing : SolveOptions, SmoothingDescription
{
};

/** Throws Error if an option is out of range; the name of the operator set is not checked.
 * solve() does so, too. */
SMG_EXPORT void checkOptions(const SolveOptions& options);
/** The same for the options of a deformation, with the name of the operator set; deform() does
 * so, too. */
SMG_EXPORT void checkOptions(const DeformOptions& options);
/** The same for the options of smoothing; smooth() does so, too. */
SMG_EXPORT void checkOptions(const Smoothing& smoothing);
/** Throws Error, in a sentence that begins with `what`, if the tolerance is
 * SolveOptions::AutomaticTolerance. */
SMG_EXPORT void refuseAutomaticTolerance(const SolveOptions& options, const std::string& what);
/** Throws Error, in a sentence that begins with `who`, as "a blend has", if there is a folder for
 * checkpoints. */
void refuseCheckpoint(const SolveOptions& options, const std::string& who);
/** Throws Error unless the library has the operator set of that name and it supports the other
 * options; solve() does so, too. */
SMG_EXPORT void checkOperators(const SolveOptions& options);
/** Throws Error if the tolerance is SolveOptions::AutomaticTolerance and these weights have no
 * discretisation error; solve() does so, too. */
SMG_EXPORT void checkAutomaticTolerance(const SolveOptions& options, Weights weights);
/** The same, and if the problem or the other options do not permit an automatic tolerance;
 * solve() does so, too. */
SMG_EXPORT void checkAutomaticTolerance(const SolveOptions& options, const Problem& problem);
/** Throws Error if the problem has no column; solve() does so, too. */
SMG_EXPORT void checkProblem(const Problem& problem);

/** Sets the texts of a checkpoint that are empty: of the mesh, and this one of the problem. */
void identify(SolveOptions& options, const StoredMesh& mesh, const std::string& text);

/** Throws Error unless [first, first + count) is a range of a solution of `vertices` vertices and
 * there is room for its values. */
SMG_EXPORT void checkVertexRange(
  std::int64_t first, std::int64_t count, std::size_t room, std::int64_t vertices);

} // namespace smg
