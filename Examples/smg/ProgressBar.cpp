// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressBar.h"

#include <csignal>
#include <cstdio>
#include <utility>

#include <unistd.h>

namespace
{

volatile std::sig_atomic_t TheSignal = 0;

void note(int signal)
{
  TheSignal = signal;
}

} // namespace

void catchInterrupts()
{
  // Beyond a limit of the size of files, a write fails as it does on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A closing terminal must not stop a command started with nohup.
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN)
  {
    sigaction(SIGHUP, &action, nullptr);
  }
}

int interruptingSignal()
{
  return TheSignal;
}

ProgressBar::ProgressBar(std::string title, bool quiet, const std::filesystem::path& input)
  : Title(std::move(title))
  , Visible(!quiet)
  , IsTerminal(::isatty(STDERR_FILENO))
{
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(input, unknown);
  this->Mebibytes = unknown ? 0.0 : static_cast<double>(bytes) / (1 << 20);
}

ProgressBar::~ProgressBar()
{
  if (this->Shown >= 0)
  {
    std::fprintf(stderr, "\r\033[K");
  }
}

smg::ProgressFunction ProgressBar::function()
{
  return [this](double fraction)
  {
    this->show(fraction);
    return TheSignal == 0;
  };
}

void ProgressBar::show(double fraction)
{
  if (!this->Visible)
  {
    return;
  }
  if (this->IsTerminal)
  {
    this->draw(fraction);
    return;
  }
  constexpr std::chrono::seconds BetweenLines(10);
  const Time now = std::chrono::steady_clock::now();
  if (now - this->LastLine >= BetweenLines)
  {
    this->LastLine = now;
    std::fprintf(stderr, "smg: %s: %.1f %%%s\n", this->Title.c_str(), fraction * 100.0,
      this->remaining(fraction, now).c_str());
  }
}

void ProgressBar::draw(double fraction)
{
  const int thousandth = static_cast<int>(fraction * 1000.0);
  if (thousandth == this->Shown)
  {
    return;
  }
  this->Shown = thousandth;
  constexpr int Width = 40;
  const std::string done(static_cast<std::size_t>(thousandth * Width / 1000), '#');
  std::fprintf(stderr, "\r%s [%-*s] %5.1f %%%s\033[K", this->Title.c_str(), Width, done.c_str(),
    static_cast<double>(thousandth) / 10.0,
    this->remaining(fraction, std::chrono::steady_clock::now()).c_str());
  std::fflush(stderr);
}

std::string ProgressBar::remaining(double fraction, Time now) const
{
  std::string text;
  char part[64];
  if (this->Mebibytes >= 1.0)
  {
    std::snprintf(
      part, sizeof(part), ", %.0f of %.0f MiB", fraction * this->Mebibytes, this->Mebibytes);
    text += part;
  }
  // An estimate in the first seconds is unreliable.
  const double seconds = std::chrono::duration<double>(now - this->Start).count();
  if (seconds > 2.0 && fraction > 0.02)
  {
    std::snprintf(part, sizeof(part), ", %.0f s left", seconds * (1.0 - fraction) / fraction);
    text += part;
  }
  return text;
}
