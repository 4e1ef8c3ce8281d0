// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/State.h"

#include "Solver/Files/Checksum.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>

// Writing and reading the state of a checkpoint: one sequence of values, whose layout is the list
// of members that both directions share (exchange()).
//
// The bytes are treated in pages of 64 KiB. The checksum after a page covers the page and the
// checksum before it, so one number stands for everything up to there, and neither side has more
// than a page in memory; the reader also has one checksum per page.
//
// The reader believes nothing before it is checked: a count is compared with the bytes that are
// left before memory is allocated for it, so a damaged state ends with an Error and not with a huge
// allocation. Writing and reading are linear in the size of the state.

namespace smg
{

StateReader::StateReader(FileDescriptor file, std::int64_t offset, std::int64_t bytes, Pool& pool)
  : File(std::move(file))
  , Begin(offset)
  , Next(offset)
  , End(offset)
  , Memory(&pool)
{
  if (bytes < 0 || bytes != this->File.size() - offset)
  {
    this->fail("its size differs from that in its header");
  }
  // What the state holds goes to the memory of the computation: more than its limit cannot be
  // restored.
  if (bytes > pool.limit())
  {
    throw Error(this->File.path().string() +
                ": is the checkpoint of a computation with a larger memory limit: repeat its "
                "command to continue it, or remove the folder to begin anew.");
  }
  this->End += bytes;
}

std::uint64_t StateReader::checksum()
{
  std::uint64_t sum = 0;
  this->Sums.clear();
  std::vector<std::byte> page(StatePages::Bytes);
  for (std::int64_t at = this->Begin; at < this->End;)
  {
    const auto bytes = std::min<std::int64_t>(this->End - at, StatePages::Bytes);
    page.resize(static_cast<std::size_t>(bytes));
    this->File.read(at, page);
    sum = StatePages::add(sum, page);
    // Kept for checkPage(): the bytes are read again when the values are restored.
    this->Sums.push_back(sum);
    at += bytes;
  }
  return sum;
}

void StateReader::part(std::string_view name)
{
  std::string found;
  this->get(found);
  if (found != name)
  {
    this->fail("it lacks the part '" + std::string(name) + "'");
  }
}

void StateReader::read(std::span<std::byte> bytes)
{
  this->require(static_cast<std::int64_t>(bytes.size()) <= this->left());
  // Values may be longer than a page, and may begin and end anywhere in one.
  while (!bytes.empty())
  {
    if (this->PageUsed == this->Page.size())
    {
      this->Page.resize(
        static_cast<std::size_t>(std::min<std::int64_t>(this->left(), StatePages::Bytes)));
      this->File.read(this->Next, this->Page);
      this->PageUsed = 0;
      this->checkPage();
    }
    const std::size_t part = std::min(bytes.size(), this->Page.size() - this->PageUsed);
    std::copy_n(
      this->Page.begin() + static_cast<std::ptrdiff_t>(this->PageUsed), part, bytes.begin());
    this->PageUsed += part;
    this->Next += static_cast<std::int64_t>(part);
    bytes = bytes.subspan(part);
  }
}

/** Compares the page in memory with what checksum() found there: a disk that returns different
 * bytes at the second reading would otherwise restore a state that nobody has checked. Without
 * checksum() there is nothing to compare with. */
void StateReader::checkPage() const
{
  const auto page = static_cast<std::size_t>(this->Next - this->Begin) / StatePages::Bytes;
  if (page < this->Sums.size() &&
      StatePages::add(page > 0 ? this->Sums[page - 1] : 0, this->Page) != this->Sums[page])
  {
    this->fail("it differs from read to read");
  }
}

std::size_t StateReader::count(std::size_t itemBytes)
{
  std::uint64_t items = 0;
  this->get(items);
  this->require(items <= static_cast<std::uint64_t>(this->left()) / itemBytes);
  // Items of fewer bytes than `itemBytes` do not exist, so the count cannot exceed what the file
  // holds.
  return static_cast<std::size_t>(items);
}

void StateReader::fail(const std::string& reason) const
{
  throw Error(this->File.path().string() + ": the checkpoint is damaged, " + reason +
              ": remove its folder to begin anew.");
}

std::uint64_t StatePages::add(std::uint64_t checksum, std::span<const std::byte> page)
{
  const std::array<std::uint64_t, 2> both{ checksum, smg::checksum(page) };
  return smg::checksum(std::as_bytes(std::span(both)));
}

void StateWriter::write(std::span<const std::byte> bytes)
{
  while (!bytes.empty())
  {
    const std::size_t part = std::min(bytes.size(), StatePages::Bytes - this->Page.size());
    this->Page.insert(this->Page.end(), bytes.begin(), bytes.begin() + part);
    bytes = bytes.subspan(part);
    // Pages are full except for the last one: the reader cuts the bytes at the same places.
    if (this->Page.size() == StatePages::Bytes)
    {
      this->finish();
    }
  }
}

/** Writes the page in memory, full or not. As the last call it completes bytes() and checksum(). */
void StateWriter::finish()
{
  if (!this->Page.empty())
  {
    this->File.write(this->End, this->Page);
    this->Checksum = StatePages::add(this->Checksum, this->Page);
    this->End += static_cast<std::int64_t>(this->Page.size());
    this->Page.clear();
  }
}

} // namespace smg
