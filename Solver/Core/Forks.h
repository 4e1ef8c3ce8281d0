// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <functional>
#include <map>
#include <mutex>
#include <pthread.h>
#include <string>
#include <unistd.h>
#include <utility>

// A child of fork() has the memory of its parent, but of its threads only the one that forked, and
// no right to the files that its parent has made. Objects with threads, files or a lock say here
// what becomes of them.

namespace smg
{

/** What is done with an object when the process forks; an empty function does nothing. */
struct ForkActions
{
  std::function<void()> hold;    ///< before, until one of the others: nothing else may change it
  std::function<void()> release; ///< after, in the parent
  std::function<void()> inherit; ///< after, in the child, which has a single thread
};

/** The objects of this process with their actions. */
class ForkedObjects
{
public:
  /** Those of this library; they live as long as the process. */
  static ForkedObjects& all()
  {
    static ForkedObjects& objects = *new ForkedObjects;
    return objects;
  }

  void add(const void* object, ForkActions actions)
  {
    const std::lock_guard lock(this->Mutex);
    this->Actions[object] = std::move(actions);
  }
  void remove(const void* object) noexcept
  {
    const std::lock_guard lock(this->Mutex);
    this->Actions.erase(object);
  }

private:
  ForkedObjects()
  {
    pthread_atfork(
      []
      {
        all().Mutex.lock();
        all().run(&ForkActions::hold);
      },
      []
      {
        all().run(&ForkActions::release);
        all().Mutex.unlock();
      },
      []
      {
        all().run(&ForkActions::inherit);
        all().Mutex.unlock();
      });
  }

  void run(std::function<void()> ForkActions::*action)
  {
    for (const auto& [object, actions] : this->Actions)
    {
      if (actions.*action)
      {
        (actions.*action)();
      }
    }
  }

  std::mutex Mutex;
  std::map<const void*, ForkActions> Actions;
};

/** The process that made an object whose memory a forked child would share with it: rings are
 * mapped files in memory. */
class OwnProcess
{
public:
  /** Throws Error in a forked child. `what` is the object, for the message. */
  void require(const char* what) const
  {
    if (::getpid() != this->Maker)
    {
      throw Error(std::string("The process was forked: its parent has the memory of ") + what +
                  "; make it again in the child.");
    }
  }

private:
  pid_t Maker = ::getpid();
};

/** A mutex of the whole process, which no other thread holds in a forked child. */
class ForkedMutex : public std::mutex
{
public:
  ForkedMutex()
  {
    ForkedObjects::all().add(
      this, { [this] { this->lock(); }, [this] { this->unlock(); }, [this] { this->unlock(); } });
  }
  ~ForkedMutex() { ForkedObjects::all().remove(this); }
};

} // namespace smg
