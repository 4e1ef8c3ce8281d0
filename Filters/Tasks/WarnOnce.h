// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "IO/Vtk/PropertyNames.h"
#include "Solver/Core/Text.h"

#include "vtkAlgorithm.h"
#include "vtkObject.h"

#include <string>

namespace smg
{

/** Issues a warning of an object, but not repeatedly while its cause persists. */
class WarnOnce
{
public:
  explicit WarnOnce(vtkAlgorithm& object)
    : Object(object)
  {
  }

  /** Warns, unless this was the last warning; "": the cause has gone. */
  void warn(const std::string& sentence)
  {
    if (sentence.empty())
    {
      this->forget();
    }
    else if (this->Last != sentence)
    {
      const std::string said = withProperties(oneLine(sentence), this->Object);
      vtkWarningWithObjectMacro(&this->Object, << said);
      this->Last = sentence;
    }
  }

  /** Allows the last warning to be issued again. */
  void forget() { this->Last.clear(); }

private:
  vtkAlgorithm& Object;
  std::string Last;
};

/** Warns of a solve that has not converged but `mustConverge`, and of what else a user must not
 * miss. */
inline void warnOf(vtkObject& object, const SolveSummary& summary, bool mustConverge)
{
  for (const std::string& warning : summary.facts.warnings)
  {
    vtkWarningWithObjectMacro(&object, << oneLine(warning) << '.');
  }
  if (summary.error.empty() && !summary.facts.converged && mustConverge)
  {
    vtkWarningWithObjectMacro(
      &object, << "The solve did not converge: after " << summary.facts.cycles
               << " cycles the relative residual is " << summary.facts.residual()
               << "; raise Maximum Cycles or Tolerance.");
  }
}

} // namespace smg
