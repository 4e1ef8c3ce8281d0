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
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted()
{
  return TheSignal != 0;
}
