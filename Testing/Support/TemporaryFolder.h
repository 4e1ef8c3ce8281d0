// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace smg::testing
{

/** A new empty folder that is removed with its content at the end of the scope. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "smg-test-XXXXXX").string();
    if (!mkdtemp(name.data()))
    {
      throw std::runtime_error("cannot make the folder " + name);
    }
    this->Path = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return this->Path; }
  std::filesystem::path operator/(const std::string& name) const { return this->Path / name; }

  /** Number of files and folders directly in the folder. */
  std::ptrdiff_t entries() const
  {
    return std::distance(std::filesystem::directory_iterator(this->Path), {});
  }

private:
  std::filesystem::path Path;
};

} // namespace smg::testing
