// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace smg
{

/** An error that is thrown on all processes with the same text. */
class SMG_EXPORT TeamError : public Error
{
public:
  using Error::Error;
};

/** The processes that solve a problem together. A failure of one of them ends the work of all with
 * the same error: every collective operation begins with agree(), in which a process that has
 * failed takes part as well. A process may therefore throw only between two such operations. */
class SMG_EXPORT Team
{
public:
  /** Duplicates the communicator; called by all of its processes, like the destructor. */
  explicit Team(MPI_Comm communicator);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  MPI_Comm communicator() const { return this->Processes; }
  int rank() const { return this->Rank; }
  int size() const { return this->Size; }

  /** Runs `work` on every process. Throws TeamError, or Cancelled, on all of them if it throws on
   * one. */
  template <class Work>
  void run(Work&& work);

  /** Throws TeamError, or Cancelled, on all processes if one has failed. */
  void agree() { this->agree(nullptr, false); }

  /** Replaces each number by the sum, or by the smallest or largest one, over all processes. */
  void sum(std::span<double> values);
  void sum(std::span<std::int64_t> values);
  void least(std::span<double> values);
  void least(std::span<std::int64_t> values);
  void largest(std::span<double> values);

  /** Throws Error on all processes unless `value` is the same on each. `what` names it in the
   * message. */
  void requireSame(const std::string& what, std::string_view value);

  /** Sends to[p] to each process p; returns what each process sent. */
  template <class T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& to);
  /** The items of all processes, one process after the other. */
  template <class T>
  std::vector<T> gather(const std::vector<T>& items);

private:
  void agree(const char* failure, bool cancelled);
  [[noreturn]] void fail(const char* failure, bool cancelled);
  /** Numbers of items for each process and where they begin. layout() throws Error if they are too
   * many for a message. */
  struct Layout
  {
    std::vector<int> counts, begins;
    std::size_t total = 0;
  };
  Layout layout(const std::vector<std::size_t>& counts) const;
  void exchangeBytes(const void* from, const Layout& sent, void* to, const Layout& received,
    std::size_t itemBytes) const;
  std::vector<std::size_t> exchangeCounts(const std::vector<std::size_t>& counts) const;
  std::vector<std::size_t> gatherCounts(std::size_t count) const;
  void gatherBytes(
    const void* from, int count, void* to, const Layout& received, std::size_t itemBytes) const;

  MPI_Comm Processes = MPI_COMM_NULL;
  int Rank = 0, Size = 1;
  bool Over = false; ///< all processes know of the failure
};

template <class Work>
void Team::run(Work&& work)
{
  this->Over = false;
  try
  {
    work();
    this->agree();
  }
  catch (const std::exception& error)
  {
    // Once all know of a failure, a further one, for instance of memory for its message, concerns
    // this process alone: the others have ended their work and would not answer.
    if (this->Over)
    {
      throw;
    }
    const bool isMemory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    const bool isCancelled = dynamic_cast<const Cancelled*>(&error) != nullptr;
    this->fail(isMemory ? nullptr : error.what(), isCancelled);
  }
}

template <class T>
std::vector<std::vector<T>> Team::exchange(const std::vector<std::vector<T>>& to)
{
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::size_t> counts(to.size());
  std::vector<T> sent;
  for (std::size_t p = 0; p < to.size(); ++p)
  {
    counts[p] = to[p].size();
    sent.insert(sent.end(), to[p].begin(), to[p].end());
  }
  // What may throw comes before agree(): the layouts, and the memory for what is received.
  const Layout mine = this->layout(counts);
  this->agree();
  const Layout others = this->layout(this->exchangeCounts(counts));
  std::vector<T> received(others.total);
  this->agree();
  this->exchangeBytes(sent.data(), mine, received.data(), others, sizeof(T));
  std::vector<std::vector<T>> from(to.size());
  for (std::size_t p = 0; p < from.size(); ++p)
  {
    const auto begin = received.begin() + others.begins[p];
    from[p].assign(begin, begin + others.counts[p]);
  }
  return from;
}

template <class T>
std::vector<T> Team::gather(const std::vector<T>& items)
{
  static_assert(std::is_trivially_copyable_v<T>);
  this->agree();
  const Layout all = this->layout(this->gatherCounts(items.size()));
  std::vector<T> received(all.total);
  this->agree();
  this->gatherBytes(items.data(), static_cast<int>(items.size()), received.data(), all, sizeof(T));
  return received;
}

} // namespace smg
