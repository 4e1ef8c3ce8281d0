// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkObject.h"

#include <string>

namespace smg
{

/** Issues a warning of an object, but not repeatedly while its cause persists. */
class WarnOnce
{
public:
  explicit WarnOnce(vtkObject& object)
    : Object(object)
  {
  }

  /** Warns, unless this was the last warning. */
  void warn(const std::string& sentence)
  {
    if (this->Last != sentence)
    {
      vtkWarningWithObjectMacro(&this->Object, << sentence);
      this->Last = sentence;
    }
  }

  /** Allows the last warning to be issued again. */
  void forget() { this->Last.clear(); }

private:
  vtkObject& Object;
  std::string Last;
};

} // namespace smg
