// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkObject.h"

#include <string>

namespace smg
{

/** Lets an object warn of something, but not again and again while that stays so. */
class WarnOnce
{
public:
  explicit WarnOnce(vtkObject& object)
    : Object(object)
  {
  }

  /** Warns, unless that was the last warning. */
  void warn(const std::string& sentence)
  {
    if (this->Last != sentence)
    {
      vtkWarningWithObjectMacro(&this->Object, << sentence);
      this->Last = sentence;
    }
  }

  /** From now on the same is worth a warning again. */
  void forget() { this->Last.clear(); }

private:
  vtkObject& Object;
  std::string Last;
};

} // namespace smg
