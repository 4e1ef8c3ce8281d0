// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/VertexFile.h"

#include <algorithm>

namespace smg
{

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
