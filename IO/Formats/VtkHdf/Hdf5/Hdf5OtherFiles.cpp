// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/Hdf5OtherFiles.h"

#include "IO/Files/InQuotes.h"
#include "smg/Error.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

namespace smg
{
namespace
{

void requireBeside(
  const std::filesystem::path& other, const std::string& name, const std::string& object)
{
  if (other.is_absolute() || std::ranges::find(other, "..") != other.end())
  {
    throw Error(name + ": " + inQuotes(object) + " lies in " + inQuotes(other.string()) +
                ": only files in the same folder, or below it, are read.");
  }
}

/** The target file of an external link of `bytes` bytes. */
std::string targetOf(hid_t file, const std::string& link, std::size_t bytes)
{
  std::vector<char> value(bytes);
  const char* target = nullptr;
  const char* object = nullptr;
  const bool found =
    H5Lget_val(file, link.c_str(), value.data(), value.size(), H5P_DEFAULT) >= 0 &&
    H5Lunpack_elink_val(value.data(), value.size(), nullptr, &target, &object) >= 0;
  return found ? target : std::string("..");
}

} // namespace

void checkLinks(std::int64_t file, const std::string& name, const std::string& object)
{
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = object.find('/', end + 1);
    const std::string path = object.substr(0, end);
    H5L_info_t link{};
    if (H5Lget_info(file, path.c_str(), &link, H5P_DEFAULT) < 0)
    {
      return; // no such object
    }
    if (link.type == H5L_TYPE_EXTERNAL)
    {
      requireBeside(targetOf(file, path, link.u.val_size), name, path);
    }
  }
}

void checkSources(std::int64_t properties, const std::string& name, const std::string& dataset)
{
  if (H5Pget_layout(properties) == H5D_VIRTUAL)
  {
    std::size_t count = 0;
    H5Pget_virtual_count(properties, &count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const ssize_t length = H5Pget_virtual_filename(properties, i, nullptr, 0);
      std::vector<char> source(static_cast<std::size_t>(std::max<ssize_t>(length, 0)) + 1);
      H5Pget_virtual_filename(properties, i, source.data(), source.size());
      requireBeside(source.data(), name, dataset);
    }
  }
  const int external = H5Pget_external_count(properties);
  for (int i = 0; i < external; ++i)
  {
    std::array<char, 4096> source{};
    H5Pget_external(
      properties, static_cast<unsigned>(i), source.size() - 1, source.data(), nullptr, nullptr);
    requireBeside(source.data(), name, dataset);
  }
}

} // namespace smg
