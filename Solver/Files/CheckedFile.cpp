// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/CheckedFile.h"

#include "Solver/Files/State.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

// A scratch file that grows at its end, with a checksum in memory for every grain of 16 KiB (0.05 %
// of its bytes). A read anywhere verifies the grains that it touches, so whole grains are read
// once, and a few bytes cost the reading of one grain.

namespace smg
{

void CheckedFile::create(const std::filesystem::path& folder)
{
  this->File = FileDescriptor::createNameless(folder);
}

/** Where a read should stop so that the next one begins with a grain: otherwise both would read and
 * verify the grain that they share. */
std::size_t CheckedFile::untilGrain(std::int64_t offset, std::size_t most)
{
  const std::int64_t end = beginOf(grainAt(offset + static_cast<std::int64_t>(most)));
  return end > offset ? static_cast<std::size_t>(end - offset) : most;
}

void CheckedFile::append(std::span<const std::byte> bytes)
{
  // One write for all bytes; then their checksums, grain by grain.
  this->File.write(this->End, bytes);
  while (!bytes.empty())
  {
    const auto inGrain = static_cast<std::size_t>(this->End - beginOf(grainAt(this->End)));
    const std::span<const std::byte> part =
      bytes.first(std::min(bytes.size(), GrainBytes - inGrain));
    if (inGrain == 0)
    {
      this->Sums.emplace_back();
      this->LastSum.restart();
    }
    // A whole grain at once is the usual and fastest case. Otherwise the checksum of what the last
    // grain has so far is kept up to date, so that the file can be read at any time.
    if (part.size() == GrainBytes)
    {
      this->Sums.back() = checksum(part);
    }
    else
    {
      this->LastSum.add(part);
      this->Sums.back() = this->LastSum.value();
    }
    this->End += std::ssize(part);
    bytes = bytes.subspan(part.size());
  }
}

/** The file keeps its length, and with it its pages in the cache of the system: they are
 * overwritten. */
void CheckedFile::restart()
{
  this->End = 0;
  this->Sums.clear();
}

/** All grains are full except for the last one. */
std::size_t CheckedFile::bytesOf(std::int64_t grain) const
{
  return std::min(GrainBytes, static_cast<std::size_t>(this->End - beginOf(grain)));
}

void CheckedFile::readGrains(std::int64_t first, std::span<std::byte> bytes) const
{
  this->File.read(beginOf(first), bytes);
  for (std::int64_t i = first; !bytes.empty(); ++i)
  {
    const std::size_t size = this->bytesOf(i);
    if (checksum(bytes.first(size)) != this->Sums[static_cast<std::size_t>(i)])
    {
      throwDamagedBlock(this->File.path(), i);
    }
    bytes = bytes.subspan(size);
  }
}

void CheckedFile::read(std::int64_t offset, std::span<std::byte> bytes) const
{
  // A read is cut into stretches of whole grains, which go straight to the caller, and parts of a
  // grain, which are copied from a whole one, since a checksum is of all of it.
  assert(offset >= 0 && offset + std::ssize(bytes) <= this->End);
  while (!bytes.empty())
  {
    const std::int64_t grain = grainAt(offset);
    // The last grain may be short: a read up to the end of the file takes it as a whole one.
    const bool isLast = offset + std::ssize(bytes) == this->End;
    std::size_t part = isLast ? bytes.size() : untilGrain(offset, bytes.size());
    if (offset == beginOf(grain) && (isLast || part >= GrainBytes))
    {
      this->readGrains(grain, bytes.first(part));
    }
    else
    {
      // On the stack: a read allocates nothing, and any number of threads may read at once.
      std::array<std::byte, GrainBytes> whole;
      this->readGrains(grain, std::span(whole).first(this->bytesOf(grain)));
      const auto skipped = static_cast<std::size_t>(offset - beginOf(grain));
      part = std::min(bytes.size(), this->bytesOf(grain) - skipped);
      std::ranges::copy(std::span(whole).subspan(skipped, part), bytes.begin());
    }
    offset += static_cast<std::int64_t>(part);
    bytes = bytes.subspan(part);
  }
}

/** The name is given once, and the content is made durable with it: nothing is appended afterwards,
 * so later states refer to the same bytes. */
void CheckedFile::save(StateWriter& state, const std::filesystem::path& path)
{
  if (!std::exchange(this->IsNamed, true) && this->isOpen())
  {
    this->File.giveName(path);
    this->File.sync();
  }
  state.part(path.filename().string());
  state(this->End, this->Sums);
}

void CheckedFile::load(StateReader& state, const std::filesystem::path& path)
{
  state.part(path.filename().string());
  state(this->End, this->Sums);
  // One checksum for each grain that has begun.
  state.require(this->End >= 0 && std::ssize(this->Sums) ==
                                    grainAt(this->End) + (beginOf(grainAt(this->End)) < this->End));
  this->IsNamed = true;
  // A file without bytes was never created: there is nothing to open.
  if (this->End == 0)
  {
    return;
  }
  this->File = FileDescriptor::openForReading(path);
  // The whole file is read and compared before anything is computed from it.
  const Buffer grain(state.pool(), GrainBytes);
  for (std::int64_t i = 0; i < std::ssize(this->Sums); ++i)
  {
    const std::span<std::byte> bytes = grain.bytes().first(this->bytesOf(i));
    if (this->File.tryRead(beginOf(i), bytes) != 0 ||
        checksum(bytes) != this->Sums[static_cast<std::size_t>(i)])
    {
      state.fail("since " + path.string() + " is");
    }
  }
}

} // namespace smg
