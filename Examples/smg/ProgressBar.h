// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <chrono>
#include <filesystem>
#include <string>

/** Makes SIGINT, SIGTERM and SIGHUP (unless ignored) cancel the running operation with a clean-up,
 * instead of terminating the program. A second signal terminates it. */
void catchInterrupts();
/** The signal that has come since then; 0: none. */
int interruptingSignal();

/** The progress with the remaining time on standard error: a bar if that is a terminal, else a line
 * at most every ten seconds; cancels the work on an interrupt. */
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
  using Time = std::chrono::steady_clock::time_point;

  void show(double fraction);
  void draw(double fraction);
  std::string remaining(double fraction, Time now) const;

  std::string Title;
  double Mebibytes = 0; ///< of the input; 0: unknown
  const Time Start = std::chrono::steady_clock::now();
  Time LastLine = this->Start; ///< written, or the start
  bool Visible;
  bool IsTerminal;
  int Shown = -1; ///< the last thousandth drawn
};
