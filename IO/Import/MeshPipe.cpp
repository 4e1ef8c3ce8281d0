// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/MeshPipe.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <utility>

#include <poll.h>
#include <unistd.h>

namespace smg
{

namespace
{

/** Milliseconds of silence after which the reader looks around. */
constexpr int Patience = 50;

/** Bytes read at a time, so that a large array gives time to look around, too. */
constexpr std::size_t StepBytes = std::size_t(16) << 20;

} // namespace

void MeshPipeWriter::bytes(const void* data, std::size_t count)
{
  const auto* at = static_cast<const char*>(data);
  while (count > 0)
  {
    const ssize_t written = ::write(this->Descriptor, at, count);
    if (written < 0 && errno != EINTR)
    {
      ::_exit(1);
    }
    const auto step = static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    at += step;
    count -= step;
  }
}

template <class T>
void MeshPipeWriter::vector(std::vector<T>& values)
{
  this->value(static_cast<std::uint64_t>(values.size()));
  this->bytes(values.data(), values.size() * sizeof(T));
  values = std::vector<T>();
}

void MeshPipeWriter::columns(std::vector<Column>& columns)
{
  this->value(static_cast<std::uint64_t>(columns.size()));
  for (Column& column : columns)
  {
    std::vector<char> name(column.spec.name.begin(), column.spec.name.end());
    this->vector(name);
    this->value(column.spec.type);
    this->value(column.spec.components);
    this->vector(column.bytes);
  }
}

void MeshPipeWriter::sendProgress(double done)
{
  this->value(MeshMessage::Progress);
  this->value(done);
}

void MeshPipeWriter::sendFailure(const std::string& sentence)
{
  this->value(MeshMessage::Failure);
  std::vector<char> text(sentence.begin(), sentence.end());
  this->vector(text);
}

void MeshPipeWriter::sendMesh(IndexedMesh mesh)
{
  this->value(MeshMessage::Mesh);
  this->value(mesh.cellType);
  this->value(mesh.doublePositions);
  this->vector(mesh.positions);
  this->vector(mesh.corners);
  this->vector(mesh.originalCells);
  this->columns(mesh.vertexColumns);
  this->columns(mesh.cellColumns);
  this->value(mesh.triangulatedPolygons);
  this->value(mesh.droppedCells);
}

bool MeshPipeReader::bytes(void* data, std::size_t count)
{
  auto* at = static_cast<char*>(data);
  while (count > 0)
  {
    pollfd wanted{ this->Descriptor, POLLIN, 0 };
    if (::poll(&wanted, 1, Patience) <= 0)
    {
      this->Idle();
      continue;
    }
    const ssize_t got = ::read(this->Descriptor, at, std::min(count, StepBytes));
    if (got == 0 || (got < 0 && errno != EINTR))
    {
      return false;
    }
    const auto step = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    at += step;
    count -= step;
  }
  return true;
}

template <class T>
bool MeshPipeReader::vector(std::vector<T>& values)
{
  std::uint64_t size = 0;
  if (!this->value(size))
  {
    return false;
  }
  values.resize(size);
  return this->bytes(values.data(), values.size() * sizeof(T));
}

bool MeshPipeReader::columns(std::vector<Column>& columns)
{
  std::uint64_t size = 0;
  bool good = this->value(size);
  columns.clear();
  for (std::uint64_t i = 0; good && i < size; ++i)
  {
    std::vector<char> name;
    Column column;
    good = this->vector(name) && this->value(column.spec.type) &&
           this->value(column.spec.components) && this->vector(column.bytes);
    column.spec.name.assign(name.begin(), name.end());
    columns.push_back(std::move(column));
  }
  return good;
}

bool MeshPipeReader::next(MeshMessage& message)
{
  return this->value(message);
}

bool MeshPipeReader::receive(std::string& sentence)
{
  std::vector<char> text;
  const bool good = this->vector(text);
  sentence.assign(text.begin(), text.end());
  return good;
}

bool MeshPipeReader::receive(IndexedMesh& mesh)
{
  return this->value(mesh.cellType) && this->value(mesh.doublePositions) &&
         this->vector(mesh.positions) && this->vector(mesh.corners) &&
         this->vector(mesh.originalCells) && this->columns(mesh.vertexColumns) &&
         this->columns(mesh.cellColumns) && this->value(mesh.triangulatedPolygons) &&
         this->value(mesh.droppedCells);
}

} // namespace smg
