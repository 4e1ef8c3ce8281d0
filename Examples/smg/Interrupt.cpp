// SPDX-License-Identifier: BSD-3-Clause
#include "Interrupt.h"

#include <csignal>

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

bool interrupted()
{
  return TheSignal != 0;
}
