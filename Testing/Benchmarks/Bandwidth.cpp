// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Bandwidth.h"

#include "Solver/Core/Timer.h"
#include "smg/Error.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace smg::benchmark
{
namespace
{

/** An unnamed scratch file, deleted when the program ends. */
class NamelessFile
{
public:
  explicit NamelessFile(const std::filesystem::path& folder)
    : Folder(folder)
    , Number(open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600))
  {
    this->check(this->Number >= 0);
  }
  ~NamelessFile() { close(this->Number); }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  void write(const std::vector<char>& block, std::int64_t offset) const
  {
    this->check(pwrite(this->Number, block.data(), block.size(), offset) ==
                static_cast<ssize_t>(block.size()));
  }
  void read(std::vector<char>& block, std::int64_t offset) const
  {
    this->check(pread(this->Number, block.data(), block.size(), offset) ==
                static_cast<ssize_t>(block.size()));
  }
  void sync() const { this->check(fdatasync(this->Number) == 0); }
  void dropFromCache() const
  {
    this->check(posix_fadvise(this->Number, 0, 0, POSIX_FADV_DONTNEED) == 0);
  }

private:
  void check(bool isDone) const
  {
    if (!isDone)
    {
      throw Error("A scratch file in " + this->Folder.string() +
                  " cannot be used: " + std::strerror(errno) + ".");
    }
  }

  std::filesystem::path Folder;
  int Number;
};

void triad(double* a, const double* b, const double* c, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    a[i] = b[i] + 3.0 * c[i];
  }
}

} // namespace

double memoryBandwidth(int threads, std::int64_t bytes)
{
  const std::size_t part = static_cast<std::size_t>(bytes) / sizeof(double) / threads;
  const std::size_t count = part * threads;
  std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
  double best = 0.0;
  constexpr int Runs = 10;
  for (int run = 0; run < Runs; ++run)
  {
    const Timer timer;
    std::vector<std::jthread> others;
    for (int t = 1; t < threads; ++t)
    {
      others.emplace_back(triad, &a[t * part], &b[t * part], &c[t * part], part);
    }
    triad(a.data(), b.data(), c.data(), part);
    others.clear();
    best = std::max(best, static_cast<double>(3 * count * sizeof(double)) / timer.seconds());
  }
  if (a.front() != 7.0 || a.back() != 7.0)
  {
    throw Error("The triad is wrong: this is a bug in the program.");
  }
  return best;
}

FileBandwidth fileBandwidth(const std::filesystem::path& folder, std::int64_t bytes)
{
  // About the size of a block of rows in the solver.
  std::vector<char> block(std::size_t(1) << 16, 'x');
  const auto step = static_cast<std::int64_t>(block.size());
  const std::int64_t end = std::max<std::int64_t>(1, bytes / step) * step;
  const NamelessFile file(folder);
  const auto read = [&]
  {
    const Timer timer;
    for (std::int64_t offset = 0; offset < end; offset += step)
    {
      file.read(block, offset);
    }
    return static_cast<double>(end) / timer.seconds();
  };
  FileBandwidth answer;
  const Timer writing;
  for (std::int64_t offset = 0; offset < end; offset += step)
  {
    file.write(block, offset);
  }
  answer.cachedWrite = static_cast<double>(end) / writing.seconds();
  file.sync();
  answer.diskWrite = static_cast<double>(end) / writing.seconds();
  answer.cachedRead = read();
  file.dropFromCache();
  answer.diskRead = read();
  return answer;
}

} // namespace smg::benchmark
