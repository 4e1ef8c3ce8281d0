// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/PositionedFile.h"

#include "Solver/Core/Error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace smg
{

PositionedFile::PositionedFile(std::filesystem::path path)
  : Path(std::move(path))
  , Temporary(this->Path.string() + ".part" + std::to_string(::getpid()))
{
  this->Descriptor =
    ::open(this->Temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (this->Descriptor < 0)
  {
    this->fail("made");
  }
}

PositionedFile::~PositionedFile()
{
  if (this->Descriptor >= 0)
  {
    ::close(this->Descriptor);
  }
  if (!this->Temporary.empty())
  {
    std::error_code ignored;
    std::filesystem::remove(this->Temporary, ignored);
  }
}

void PositionedFile::write(std::int64_t offset, std::span<const std::byte> bytes)
{
  while (!bytes.empty())
  {
    const ssize_t written = ::pwrite(this->Descriptor, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno != EINTR)
    {
      this->fail("written");
    }
    if (written > 0)
    {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      offset += written;
    }
  }
}

void PositionedFile::finish()
{
  const int descriptor = this->Descriptor;
  this->Descriptor = -1;
  if (::close(descriptor) != 0)
  {
    this->fail("written");
  }
  if (::rename(this->Temporary.c_str(), this->Path.c_str()) != 0)
  {
    this->fail("renamed");
  }
  this->Temporary.clear();
}

void PositionedFile::fail(const char* what) const
{
  throw Error(
    this->Path.string() + ": the file cannot be " + what + ": " + std::strerror(errno) + '.');
}

} // namespace smg
