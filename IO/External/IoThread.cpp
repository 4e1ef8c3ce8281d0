// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/IoThread.h"

#include "smg/Error.h"

#include <csignal>
#include <string>
#include <system_error>
#include <utility>

namespace smg
{

namespace
{

constexpr std::size_t StackBytes = std::size_t(512) << 10;

/** Blocks signals, which are for the threads of the program: a thread inherits the mask of its
 * creator. */
class BlockedSignals
{
public:
  BlockedSignals()
  {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &this->Before);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &this->Before, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

private:
  sigset_t Before{};
};

} // namespace

IoThread::~IoThread()
{
  this->join();
}

void IoThread::start(std::function<void()> body)
{
  this->Body = std::move(body);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, StackBytes);
  const BlockedSignals blocked;
  const int error = pthread_create(
    &this->Thread, &attributes,
    [](void* self) -> void*
    {
      static_cast<IoThread*>(self)->Body();
      return nullptr;
    },
    this);
  pthread_attr_destroy(&attributes);
  if (error != 0)
  {
    throw Error(
      "A thread for disk work cannot be started: " + std::generic_category().message(error) + ".");
  }
  this->Started = true;
}

void IoThread::join()
{
  if (std::exchange(this->Started, false))
  {
    pthread_join(this->Thread, nullptr);
  }
}

} // namespace smg
