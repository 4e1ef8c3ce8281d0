// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/CheckedFile.h"

#include "Solver/Files/State.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

namespace smg
{

void CheckedFile::create(const std::filesystem::path& folder)
{
  this->File = FileDescriptor::createNameless(folder);
}

std::size_t CheckedFile::untilGrain(std::int64_t offset, std::size_t most)
{
  const std::int64_t end = beginOf(grainAt(offset + static_cast<std::int64_t>(most)));
  return end > offset ? static_cast<std::size_t>(end - offset) : most;
}

void CheckedFile::append(std::span<const std::byte> bytes)
{
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

void CheckedFile::restart()
{
  this->End = 0;
  this->Sums.clear();
}

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
  assert(offset >= 0 && offset + std::ssize(bytes) <= this->End);
  while (!bytes.empty())
  {
    const std::int64_t grain = grainAt(offset);
    const bool isLast = offset + std::ssize(bytes) == this->End;
    std::size_t part = isLast ? bytes.size() : untilGrain(offset, bytes.size());
    if (offset == beginOf(grain) && (isLast || part >= GrainBytes))
    {
      this->readGrains(grain, bytes.first(part));
    }
    else
    {
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
  state.require(this->End >= 0 && std::ssize(this->Sums) ==
                                    grainAt(this->End) + (beginOf(grainAt(this->End)) < this->End));
  this->IsNamed = true;
  if (this->End == 0)
  {
    return;
  }
  this->File = FileDescriptor::openForReading(path);
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

VertexFile::VertexFile(const VertexStorage& storage, int lanes)
  : Memory(&storage.pool)
  , Traffic(&storage.traffic)
  , Lanes(static_cast<std::size_t>(lanes))
{
  if (storage.folder)
  {
    this->File.create(storage.folder->path());
  }
  else
  {
    this->Values = Buffer(storage.pool, 0);
  }
}

void VertexFile::restart()
{
  this->Vertices = 0;
  this->File.restart();
}

void VertexFile::append(std::span<const double> values)
{
  const std::size_t begin = static_cast<std::size_t>(this->Vertices) * this->Lanes * sizeof(double);
  const std::size_t end = begin + values.size_bytes();
  this->Vertices += static_cast<std::int64_t>(values.size() / this->Lanes);
  if (this->File.isOpen())
  {
    this->File.append(std::as_bytes(values));
    this->Traffic->bytesWritten += static_cast<std::int64_t>(values.size_bytes());
    return;
  }
  if (end > this->Values.capacity())
  {
    this->Values.grow(*this->Memory, std::max(end, begin + begin / 8));
  }
  this->Values.resize(end); // what a growth keeps
  std::ranges::copy(std::as_bytes(values), this->Values.data() + begin);
}

void VertexFile::read(std::int64_t first, std::int64_t count, double* values) const
{
  const std::size_t tuple = this->Lanes * sizeof(double);
  const std::size_t begin = static_cast<std::size_t>(first) * tuple;
  const std::size_t bytes = static_cast<std::size_t>(count) * tuple;
  if (!this->File.isOpen())
  {
    std::copy_n(this->Values.data() + begin, bytes, reinterpret_cast<std::byte*>(values));
    return;
  }
  this->File.read(
    static_cast<std::int64_t>(begin), { reinterpret_cast<std::byte*>(values), bytes });
  this->Traffic->bytesRead += static_cast<std::int64_t>(bytes);
}

} // namespace smg
