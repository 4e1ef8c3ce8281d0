// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/ArrayView.h"
#include "Python/C/streamingmultigrid.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <unistd.h>
#include <utility>

namespace smg
{

/** The status of the exception that is being handled, whose text smg_error() has from now on. */
smg_status failed() noexcept;

/** Calls a function; no exception leaves this. */
template <class Function>
smg_status guarded(Function&& function) noexcept
{
  try
  {
    std::forward<Function>(function)();
    return SMG_OK;
  }
  catch (...)
  {
    return failed();
  }
}

/** Calls a function in which any Error but Cancelled is the fault of an argument. */
template <class Function>
decltype(auto) argument(Function&& function)
{
  try
  {
    return std::forward<Function>(function)();
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const Error& error)
  {
    throw ArgumentError(error.what());
  }
}

/** What a pointer points to; throws ArgumentError, which names it, if it is null. */
template <class T>
T& required(T* pointer, const char* name)
{
  if (!pointer)
  {
    throw ArgumentError(std::string(name) + ": must not be NULL.");
  }
  return *pointer;
}

/** The progress function of the library. If it forks, the child does not go on with the call. */
inline ProgressFunction progressOf(smg_progress progress, void* user)
{
  return progress ? ProgressFunction([=, process = ::getpid()](double done)
                      { return progress(done, user) == 0 && ::getpid() == process; })
                  : ProgressFunction();
}

/** The array; throws ArgumentError, which names it, if that cannot be one. */
ArrayView viewOf(const smg_array* array, const char* name);

/** The JSON of options; NULL or "" is {}. `name` is what errors call it. Throws ArgumentError. */
nlohmann::json optionsText(const char* options, const char* name);

} // namespace smg
