// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/PositionedFile.h"

#include <utility>

namespace smg
{

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

void PositionedFile::finish()
{
  this->File.renameTo(this->Path);
}

} // namespace smg
