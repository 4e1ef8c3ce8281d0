// SPDX-License-Identifier: BSD-3-Clause
#include "Python/C/Call.h"

#include "IO/Description/JsonNode.h"
#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

namespace smg
{
namespace
{

/** The text of smg_error(). One that does not fit into the memory is replaced. */
thread_local std::string LastError;
thread_local const char* LastErrorText = "";

void remember(const char* text) noexcept
{
  try
  {
    LastError = oneLine(text);
    LastErrorText = LastError.c_str();
  }
  catch (...)
  {
    LastErrorText = "the system is out of memory";
  }
}

smg_status failedWith(smg_status status, const char* text) noexcept
{
  remember(text);
  return status;
}

} // namespace

smg_status failed() noexcept
{
  try
  {
    throw;
  }
  catch (const Cancelled& error)
  {
    return failedWith(SMG_CANCELLED, error.what());
  }
  catch (const MemoryError& error)
  {
    return failedWith(SMG_MEMORY, error.what());
  }
  catch (const ArgumentError& error)
  {
    return failedWith(SMG_INVALID, error.what());
  }
  catch (const std::bad_alloc&)
  {
    return failedWith(
      SMG_MEMORY, "the system is out of memory: lower the memory limit or close other programs");
  }
  catch (const std::exception& error)
  {
    return failedWith(SMG_FAILED, error.what());
  }
  catch (...)
  {
    return failedWith(SMG_FAILED, "an unknown error");
  }
}

ArrayView viewOf(const smg_array* array, const char* name)
{
  const smg_array& given = required(array, name);
  if (given.type < SMG_INT8 || given.type > SMG_FLOAT64)
  {
    throw ArgumentError(std::string(name) + ": has a type that does not exist.");
  }
  const bool lacksData = given.rows > 0 && !given.data;
  if (given.rows < 0 || given.columns < 1 || lacksData)
  {
    throw ArgumentError(
      std::string(name) + (given.rows < 0       ? ": the number of rows is below 0."
                            : given.columns < 1 ? ": must have one or more columns."
                                                : ": must have data: the pointer is null."));
  }
  return { given.data, static_cast<ScalarType>(given.type), given.rows, given.columns,
    given.row_stride, given.column_stride };
}

nlohmann::json optionsText(const char* options, const char* name)
{
  if (!options || !*options)
  {
    return nlohmann::json::object();
  }
  return argument([&] { return readJsonText(options, name); });
}

} // namespace smg

const char* smg_version(void)
{
  return SMG_VERSION;
}

const char* smg_error(void)
{
  return smg::LastErrorText;
}

void smg_remove_folder(const char* folder)
{
  smg::guarded(
    [&]
    {
      std::error_code unsaid;
      std::filesystem::remove_all(folder ? folder : "", unsaid);
    });
}
