// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartMemory.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

// The limits of control groups are those of the programs in them.

namespace smg::testing
{
namespace
{

constexpr std::int64_t MiB = std::int64_t(1) << 20;

/** Files as those of a system. */
class System
{
public:
  System() { this->write("proc/meminfo", "MemTotal: 9000000 kB\nMemAvailable:  8192000 kB\n"); }

  void write(const std::string& name, const std::string& text) const
  {
    const std::filesystem::path file = this->Folder / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  void writeGroup(const std::string& folder, const std::string& limit, std::int64_t usage) const
  {
    this->write("sys/fs/cgroup" + folder + "/memory.max", limit + "\n");
    this->write("sys/fs/cgroup" + folder + "/memory.current", std::to_string(usage) + "\n");
  }
  std::int64_t freeMebibytes() const { return freeMemory(this->Folder.path()) / MiB; }

private:
  TemporaryFolder Folder;
};

} // namespace

TEST(FreeMemory, IsThatOfTheMachineWithoutLimits)
{
  const System system;
  EXPECT_EQ(system.freeMebibytes(), 8000);
  system.write("proc/self/cgroup", "0::/user.slice/a b:c\n");
  system.writeGroup("/user.slice", "max", 5 * MiB);
  EXPECT_EQ(system.freeMebibytes(), 8000);
  EXPECT_GT(freeMemory(), MiB);
}

TEST(FreeMemory, IsNotKnownWithoutTheFilesOfLinux)
{
  const TemporaryFolder empty;
  EXPECT_EQ(freeMemory(empty.path()), 0);
}

TEST(FreeMemory, IsWhatTheGroupAndThoseAroundItLeave)
{
  const System system;
  system.write("proc/self/cgroup", "0::/job/step: 1/task\n");
  system.writeGroup("/job/step: 1", std::to_string(1000 * MiB), 300 * MiB);
  EXPECT_EQ(system.freeMebibytes(), 700);
  // Files that the group has read count as free.
  system.write("sys/fs/cgroup/job/step: 1/memory.stat",
    "anon 1\nactive_file 7\ninactive_file " + std::to_string(100 * MiB) + "\n");
  EXPECT_EQ(system.freeMebibytes(), 800);
  system.writeGroup("/job", std::to_string(400 * MiB), 350 * MiB);
  EXPECT_EQ(system.freeMebibytes(), 50);
  system.writeGroup("/job/step: 1/task", "1000", 2000);
  EXPECT_EQ(system.freeMebibytes(), 0);
}

TEST(FreeMemory, IsThatOfAContainerWhoseGroupIsTheRoot)
{
  const System system;
  system.write("proc/self/cgroup", "0::/not/here\n");
  system.writeGroup("", std::to_string(600 * MiB), 100 * MiB);
  EXPECT_EQ(system.freeMebibytes(), 500);
}

TEST(FreeMemory, KnowsTheFirstVersionOfControlGroups)
{
  const System system;
  system.write("proc/self/cgroup", "5:cpu,cpuacct:/job\n4:memory:/job/step\n0::/\n");
  const std::string folder = "sys/fs/cgroup/memory/job/step/memory.";
  system.write(folder + "limit_in_bytes", std::to_string(900 * MiB));
  system.write(folder + "usage_in_bytes", std::to_string(500 * MiB));
  system.write(
    folder + "stat", "inactive_file 1\ntotal_inactive_file " + std::to_string(200 * MiB) + "\n");
  EXPECT_EQ(system.freeMebibytes(), 600);
}

} // namespace smg::testing
