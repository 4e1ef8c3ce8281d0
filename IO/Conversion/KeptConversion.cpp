// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/KeptConversion.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/MeshFile.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/SystemCalls.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <string>
#include <thread>

namespace smg
{

namespace
{

/** Lets one process at a time convert a file, if the file system supports locks. */
class InputLock
{
public:
  explicit InputLock(const std::filesystem::path& path)
    : File(systemCalls().open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC, 0))
  {
  }
  ~InputLock()
  {
    if (this->File >= 0)
    {
      systemCalls().close(this->File);
    }
  }
  InputLock(const InputLock&) = delete;
  InputLock& operator=(const InputLock&) = delete;

  /** Waits while another process has the lock. Throws Cancelled. */
  void wait(const ProgressFunction& progress) const
  {
    Progress waiting(progress);
    while (this->File >= 0 && ::flock(this->File, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
      waiting.update(0.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

private:
  int File;
};

/** The absolute path of a file as printable ASCII: a file name need not be UTF-8. */
std::string plainPath(const std::filesystem::path& path)
{
  static constexpr char Digits[] = "0123456789abcdef";
  std::string name;
  for (const char c : std::filesystem::canonical(path).string())
  {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 0x20 && byte < 0x7f && byte != '%')
    {
      name += c;
    }
    else
    {
      name += { '%', Digits[byte >> 4], Digits[byte & 15] };
    }
  }
  return name;
}

/** The origin stored in a file; empty if it has none or is not a complete .vsm file. */
std::string toldOrigin(const std::filesystem::path& path)
{
  try
  {
    return nlohmann::json::parse(VsmReader(path).header()).value("origin", std::string());
  }
  catch (const std::exception&)
  {
    return {};
  }
}

} // namespace

std::string originOf(const std::filesystem::path& in, const ConversionOptions& options)
{
  const CoupledGroups& coupled = options.coupled;
  return plainPath(in) + ' ' + std::to_string(std::filesystem::file_size(in)) + " bytes of " +
         std::to_string(std::filesystem::last_write_time(in).time_since_epoch().count()) +
         " in order " + std::string(nameOf(options.order)) +
         (options.cells == CellChoice::Only         ? ""
           : options.cells == CellChoice::Triangles ? ", triangles"
                                                    : ", tetrahedra") +
         (options.weld ? ", welded " + nlohmann::json(*options.weld).dump() : "") +
         (options.orient ? ", oriented" : "") +
         (options.timeStep != 0 ? ", time step " + std::to_string(options.timeStep) : "") +
         (options.partition ? ", partition " + std::to_string(*options.partition) : "") +
         (coupled.periodic.empty() && coupled.interfaces.empty()
             ? ""
             : ", coupled " + nlohmann::json{ coupled.periodic, coupled.interfaces }.dump());
}

bool isKept(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options)
{
  std::error_code absent;
  return std::filesystem::is_regular_file(in, absent) &&
         std::filesystem::is_regular_file(out, absent) && toldOrigin(out) == originOf(in, options);
}

std::optional<ConversionReport> convertToKeep(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options, bool overwrite)
{
  if (lowerSuffix(out) != ".vsm")
  {
    throw Error(out.string() + ": a conversion that is kept is a .vsm file: choose a name that "
                               "ends so.");
  }
  std::error_code absent;
  if (!std::filesystem::is_regular_file(in, absent))
  {
    throw Error(in.string() + ": there is no such file to convert.");
  }
  checkIsNotInput(in, out);
  const InputLock lock(in);
  lock.wait(options.progress);
  ConversionOptions conversion = options;
  conversion.origin = originOf(in, options);
  if (std::filesystem::exists(out))
  {
    const std::string told = toldOrigin(out);
    if (told == conversion.origin)
    {
      return std::nullopt;
    }
    if (!overwrite && !told.starts_with(plainPath(in) + ' '))
    {
      throw Error(out.string() + " is there already and was not made from " +
                  in.filename().string() +
                  " by this converter: choose another name, or set Overwrite.");
    }
  }
  const ConversionReport report = convert(in, out, conversion);
  // Only programs that convert the same file wait for each other.
  if (toldOrigin(out) != conversion.origin)
  {
    throw Error(out.string() +
                ": another program has written a file of this name meanwhile: choose "
                "another name, or run this again.");
  }
  return report;
}

} // namespace smg
