// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <string>

/** A progress bar on standard error, if that is a terminal; stops when the user interrupts. */
class ProgressBar
{
public:
  /** `quiet`: never show anything. */
  ProgressBar(std::string title, bool quiet);
  /** Clears the line. */
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /** The callback for the library, valid as long as the bar. */
  smg::ProgressFunction function();

private:
  void show(double fraction);

  std::string Title;
  bool Visible;
  int Shown = -1; ///< the last thousandth drawn
};
