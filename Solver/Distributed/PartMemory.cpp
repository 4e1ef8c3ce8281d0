// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartMemory.h"

#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"
#include "smg/Error.h"

#include <HYPRE_utilities.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

// How much memory a process needs for its part, and how much it can have. hypre allocates the
// matrix and its hierarchy without a limit, so both are known only by measurement (docs/cluster.md)
// and from what the system says.

namespace smg
{

double partMemory(std::int64_t vertices, std::int64_t cells, int columns)
{
  // 1.2 times what was measured: 753 bytes for a vertex of a surface, with its two cells, 1241 for
  // one of a solid, with its six, and 56 for each further column. The first column is in these
  // figures, so 530 + 70 stand for a vertex with one column.
  constexpr double OfVertex = 530.0, OfColumn = 70.0, OfCell = 150.0;
  return static_cast<double>(vertices) * (OfVertex + OfColumn * columns) +
         static_cast<double>(cells) * OfCell;
}

/** hypre counts the entries of the rows of a process, over all levels, by a HYPRE_Int; there are
 * fewer than 64 for each vertex. */
std::int64_t maxPartVertices()
{
  return std::numeric_limits<HYPRE_Int>::max() / 64;
}

void checkPartMemory(std::int64_t vertices, std::int64_t cells, int columns, std::int64_t limit)
{
  const double needed = partMemory(vertices, cells, columns);
  if (needed > static_cast<double>(limit))
  {
    throw MemoryError("the matrix of a process and its hierarchy need about " +
                      mebibytes(static_cast<std::int64_t>(needed)) +
                      ", more than the memory limit of " + mebibytes(limit) +
                      ": raise the memory limit, use more processes, or use the streaming engine");
  }
}

namespace
{

using Path = std::filesystem::path;

/** The number that follows a word at the beginning of a line of a file. Such files have a line for
 * each key. */
std::optional<std::int64_t> numberAfter(const Path& file, std::string_view word)
{
  std::ifstream lines(file);
  for (std::string key; lines >> key;
       lines.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
  {
    std::int64_t number = 0;
    if (key == word && lines >> number)
    {
      return number;
    }
  }
  return {};
}

/** The number that a file begins with; none if it begins with another text, such as "max". */
std::optional<std::int64_t> numberIn(const Path& file)
{
  std::int64_t number = 0;
  return std::ifstream(file) >> number ? std::optional(number) : std::nullopt;
}

/** The names of the files of the two versions of control groups: limit, use, and the part of the
 * use that is files in the page cache, which the kernel gives up before it refuses memory. */
struct GroupFiles
{
  const char *limit, *usage, *cached;
};
constexpr GroupFiles Version1{ "memory.limit_in_bytes", "memory.usage_in_bytes",
  "total_inactive_file" };
constexpr GroupFiles Version2{ "memory.max", "memory.current", "inactive_file" };

/** What the limit of one control group leaves; none if it has no limit or the files are not
 * there. */
std::optional<std::int64_t> freeOfGroup(const Path& folder, const GroupFiles& files)
{
  const std::optional<std::int64_t> limit = numberIn(folder / files.limit);
  const std::optional<std::int64_t> usage = numberIn(folder / files.usage);
  if (!limit || !usage)
  {
    return {};
  }
  const std::int64_t cached = numberAfter(folder / "memory.stat", files.cached).value_or(0);
  return std::max<std::int64_t>(*limit - *usage + cached, 0);
}

/** The least that the limits of a control group and of all groups around it leave: each of them
 * holds. In a container the group may be seen as the root of all. */
std::int64_t freeOfGroups(const Path& mount, Path group, const GroupFiles& files)
{
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  while (true)
  {
    least = std::min(least, freeOfGroup(mount / group, files).value_or(least));
    if (group.empty())
    {
      return least;
    }
    group = group.parent_path();
  }
}

/** What the control groups of this process leave. A line of /proc/self/cgroup is
 * ID:CONTROLLERS:/GROUP; version 2 has one line without controllers, version 1 one for each set of
 * controllers. */
std::int64_t freeOfGroups(const Path& root)
{
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::ifstream lines(root / "proc/self/cgroup");
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream parts(line);
    std::string id, controllers, group;
    std::getline(parts, id, ':');
    std::getline(parts, controllers, ':');
    std::getline(parts, group);
    const Path relative = Path(group).relative_path();
    if (controllers.empty())
    {
      least = std::min(least, freeOfGroups(root / "sys/fs/cgroup", relative, Version2));
    }
    else if ((',' + controllers + ',').find(",memory,") != std::string::npos)
    {
      least = std::min(least, freeOfGroups(root / "sys/fs/cgroup/memory", relative, Version1));
    }
  }
  return least;
}

} // namespace

std::int64_t freeMemory(const std::filesystem::path& root)
{
  // MemAvailable counts page cache that can be given up, in contrast to MemFree.
  const std::optional<std::int64_t> kibibytes = numberAfter(root / "proc/meminfo", "MemAvailable:");
  return kibibytes ? std::min(*kibibytes << 10, freeOfGroups(root)) : 0;
}

double freeMemoryOfProcess(Team& team)
{
  // Processes that share memory are on one machine and share what is free there in equal parts.
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(
    team.communicator(), MPI_COMM_TYPE_SHARED, team.rank(), MPI_INFO_NULL, &machine);
  int processes = 1;
  MPI_Comm_size(machine, &processes);
  MPI_Comm_free(&machine);
  double share = static_cast<double>(freeMemory()) / processes;
  team.least({ &share, 1 });
  return share;
}

} // namespace smg
