// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/WholeFile.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/FileDescriptor.h"

#include <cerrno>
#include <span>

namespace smg
{

void writeFile(const std::filesystem::path& path, std::string_view text)
{
  FileDescriptor file = FileDescriptor::createBeside(path);
  file.write(0, std::as_bytes(std::span(text)));
  file.renameTo(path);
}

void moveFile(const std::filesystem::path& from, const std::filesystem::path& to)
{
  if (systemCalls().rename(from.c_str(), to.c_str()) != 0)
  {
    FileDescriptor::throwWriteError(to, errno);
  }
}

} // namespace smg
