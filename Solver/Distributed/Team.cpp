// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/Team.h"

#include "Solver/Files/Checksum.h"

#include <algorithm>
#include <climits>
#include <cstdio>

// The processes of a solve, and how a failure of one becomes a failure of all.
//
// A process that throws and leaves would let the others wait for ever in the next collective call.
// Therefore every collective call begins with agree(), one reduction over all processes: either all
// go on, or all throw the same error. What may fail on one process alone, above all the allocation
// of much memory, comes before it.
//
// Cost: one reduction of an integer for each collective call, which is small beside what it guards.

namespace smg
{
namespace
{

/** A type of messages with items of `bytes` bytes. Counts and begins of a message are int in MPI:
 * they count items, not bytes, and so reach further. */
class ItemType
{
public:
  explicit ItemType(std::size_t bytes)
  {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &this->Type);
    MPI_Type_commit(&this->Type);
  }
  ~ItemType() { MPI_Type_free(&this->Type); }
  ItemType(const ItemType&) = delete;
  ItemType& operator=(const ItemType&) = delete;
  operator MPI_Datatype() const { return this->Type; }

private:
  MPI_Datatype Type = MPI_DATATYPE_NULL;
};

template <class T>
void reduce(std::span<T> values, MPI_Datatype type, MPI_Op operation, MPI_Comm processes)
{
  // Counts of MPI are int: longer arrays are reduced in pieces.
  constexpr std::size_t Most = std::size_t(1) << 28;
  for (std::size_t first = 0; first < values.size(); first += Most)
  {
    const auto count = static_cast<int>(std::min(Most, values.size() - first));
    MPI_Allreduce(MPI_IN_PLACE, values.data() + first, count, type, operation, processes);
  }
}

} // namespace

/** A communicator of its own: messages of the program or of other libraries cannot be mixed up with
 * those of the solve. */
Team::Team(MPI_Comm communicator)
{
  MPI_Comm_dup(communicator, &this->Processes);
  MPI_Comm_rank(this->Processes, &this->Rank);
  MPI_Comm_size(this->Processes, &this->Size);
}

Team::~Team()
{
  // After MPI_Finalize() no function of MPI may be called, and the communicator is gone.
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized)
  {
    MPI_Comm_free(&this->Processes);
  }
}

/** Finds out whether a process has failed, and throws the error of the first one on all of them.
 * `failure` is the reason of this process; null: it has not failed. `cancelled`: its failure is
 * that the user has cancelled. */
void Team::agree(const char* failure, bool cancelled)
{
  // The smallest rank among those that have failed; the number of processes if none has.
  int first = failure ? this->Rank : this->Size;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, this->Processes);
  if (first == this->Size)
  {
    return;
  }
  // All processes leave their work with the exception below; run() must not report it once more.
  this->Over = true;
  // On the stack: a process without memory must take part, too, or the others would wait for it.
  struct
  {
    int isCancelled;
    char text[4092];
  } message = { cancelled ? 1 : 0, {} };
  if (first == this->Rank)
  {
    std::snprintf(message.text, sizeof(message.text), "%s", failure);
  }
  MPI_Bcast(&message, sizeof(message), MPI_BYTE, first, this->Processes);
  if (message.isCancelled != 0)
  {
    throw Cancelled();
  }
  throw TeamError(message.text);
}

/** Reports the failure of this process to all others, which are in agree() or will come to it. For
 * a lack of memory the text is made without allocating. */
void Team::fail(const char* failure, bool cancelled)
{
  char text[80];
  std::snprintf(text, sizeof(text), "process %d of %d is out of memory", this->Rank, this->Size);
  this->agree(failure ? failure : text, cancelled);
  std::terminate(); // agree() throws
}

void Team::sum(std::span<double> values)
{
  this->agree();
  reduce(values, MPI_DOUBLE, MPI_SUM, this->Processes);
}

void Team::sum(std::span<std::int64_t> values)
{
  this->agree();
  reduce(values, MPI_INT64_T, MPI_SUM, this->Processes);
}

void Team::least(std::span<double> values)
{
  this->agree();
  reduce(values, MPI_DOUBLE, MPI_MIN, this->Processes);
}

void Team::least(std::span<std::int64_t> values)
{
  this->agree();
  reduce(values, MPI_INT64_T, MPI_MIN, this->Processes);
}

void Team::largest(std::span<double> values)
{
  this->agree();
  reduce(values, MPI_DOUBLE, MPI_MAX, this->Processes);
}

/** One reduction for the smallest and the largest checksum: the latter is the smallest of the
 * negative ones. Without the last bit the checksum is not negative, so its sign can be changed. */
void Team::requireSame(const std::string& what, std::string_view value)
{
  const auto sum = static_cast<std::int64_t>(checksum(std::as_bytes(std::span(value))) >> 1);
  std::int64_t ends[2] = { sum, -sum };
  this->least(ends);
  if (ends[0] != -ends[1])
  {
    throw Error("the processes do not have the same " + what +
                ": give all of them the same files and options");
  }
}

/** Where the items of each process begin in one message. */
Team::Layout Team::layout(const std::vector<std::size_t>& counts) const
{
  Layout layout;
  for (const std::size_t count : counts)
  {
    if (layout.total + count > INT_MAX)
    {
      throw Error("the parts of the mesh share too many vertices for one message: use more "
                  "processes");
    }
    layout.begins.push_back(static_cast<int>(layout.total));
    layout.counts.push_back(static_cast<int>(count));
    layout.total += count;
  }
  return layout;
}

std::vector<std::size_t> Team::exchangeCounts(const std::vector<std::size_t>& counts) const
{
  const ItemType number(sizeof(std::size_t));
  std::vector<std::size_t> received(counts.size());
  MPI_Alltoall(counts.data(), 1, number, received.data(), 1, number, this->Processes);
  return received;
}

void Team::exchangeBytes(const void* from, const Layout& sent, void* to, const Layout& received,
  std::size_t itemBytes) const
{
  const ItemType item(itemBytes);
  MPI_Alltoallv(from, sent.counts.data(), sent.begins.data(), item, to, received.counts.data(),
    received.begins.data(), item, this->Processes);
}

std::vector<std::size_t> Team::gatherCounts(std::size_t count) const
{
  const ItemType number(sizeof(std::size_t));
  std::vector<std::size_t> counts(static_cast<std::size_t>(this->Size));
  MPI_Allgather(&count, 1, number, counts.data(), 1, number, this->Processes);
  return counts;
}

void Team::gatherBytes(
  const void* from, int count, void* to, const Layout& received, std::size_t itemBytes) const
{
  const ItemType item(itemBytes);
  MPI_Allgatherv(
    from, count, item, to, received.counts.data(), received.begins.data(), item, this->Processes);
}

} // namespace smg
