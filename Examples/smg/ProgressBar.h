// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <chrono>
#include <filesystem>
#include <string>

/** A progress bar with the remaining time on standard error, if that is a terminal; cancels the
 * work on an interrupt. */
class ProgressBar
{
public:
  /** `quiet`: show nothing. With an `input`, the bar also shows the corresponding number of bytes
   * of that file. */
  ProgressBar(std::string title, bool quiet, const std::filesystem::path& input = {});
  /** Clears the line. */
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /** The callback for the library, valid during the lifetime of the bar. */
  smg::ProgressFunction function();

private:
  void show(double fraction);
  std::string remaining(double fraction) const;

  std::string Title;
  double Mebibytes = 0; ///< of the input; 0: unknown
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  bool Visible;
  int Shown = -1; ///< the last thousandth drawn
};
