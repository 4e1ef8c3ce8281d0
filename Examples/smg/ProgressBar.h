// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <chrono>
#include <filesystem>
#include <string>

/**
 * A progress bar with the time that is left, on standard error, if that is a terminal; stops when
 * the user interrupts.
 */
class ProgressBar
{
public:
  /**
   * `quiet`: never show anything. With the `input`, also the bytes of that file that the work done
   * is worth.
   */
  ProgressBar(std::string title, bool quiet, const std::filesystem::path& input = {});
  /** Clears the line. */
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /** The callback for the library, valid as long as the bar. */
  smg::ProgressFunction function();

private:
  void show(double fraction);
  std::string remaining(double fraction) const;

  std::string Title;
  double Mebibytes = 0; ///< of the input; 0: not known
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  bool Visible;
  int Shown = -1; ///< the last thousandth drawn
};
