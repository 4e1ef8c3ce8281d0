// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/SequentialOutput.h"

#include <utility>

namespace smg
{

namespace
{

constexpr std::size_t OutputBufferBytes = std::size_t(512) << 10;

} // namespace

SequentialOutput::SequentialOutput(std::filesystem::path path)
  : Path(std::move(path))
  , File(FileDescriptor::createBeside(this->Path))
  , Behind(std::make_unique<WriteBehind>(this->File, 0, OutputBufferBytes))
{
}

SequentialOutput::~SequentialOutput() = default;

void SequentialOutput::check()
{
  if (const int error = this->Behind->failed(); error != 0)
  {
    FileDescriptor::throwWriteError(this->Path, error);
  }
}

void SequentialOutput::put(std::span<const std::byte> bytes)
{
  const std::int64_t before = this->Behind->offset() / std::int64_t(OutputBufferBytes);
  this->Behind->put(bytes);
  if (this->Behind->offset() / std::int64_t(OutputBufferBytes) != before)
  {
    this->check();
  }
}

void SequentialOutput::flush()
{
  this->Behind->flush();
  this->check();
}

void SequentialOutput::finish()
{
  this->flush();
  this->Behind.reset();
  this->File.renameTo(this->Path);
}

PositionedFile::PositionedFile(std::filesystem::path path)
  : Path(std::move(path))
  , File(FileDescriptor::createBeside(this->Path))
{
}

void PositionedFile::write(std::int64_t offset, std::span<const std::byte> bytes)
{
  if (const int error = this->File.tryWrite(offset, bytes); error != 0)
  {
    FileDescriptor::throwWriteError(this->Path, error);
  }
}

} // namespace smg
