// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressBar.h"

#include "Interrupt.h"

#include <cstdio>
#include <utility>

#include <unistd.h>

ProgressBar::ProgressBar(std::string title, bool quiet)
  : Title(std::move(title))
  , Visible(!quiet && ::isatty(STDERR_FILENO))
{
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
    return !interrupted();
  };
}

void ProgressBar::show(double fraction)
{
  const int thousandth = static_cast<int>(fraction * 1000.0);
  if (!this->Visible || thousandth == this->Shown)
  {
    return;
  }
  this->Shown = thousandth;
  constexpr int Width = 40;
  const std::string done(static_cast<std::size_t>(thousandth * Width / 1000), '#');
  std::fprintf(stderr, "\r%s [%-*s] %5.1f %%", this->Title.c_str(), Width, done.c_str(),
    static_cast<double>(thousandth) / 10.0);
  std::fflush(stderr);
}
