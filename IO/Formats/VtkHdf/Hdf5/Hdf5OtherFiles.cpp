// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/Hdf5OtherFiles.h"

#include "IO/Files/InQuotes.h"
#include "IO/Files/NearbyFile.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5Handle.h"
#include "smg/Error.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace smg
{
namespace
{

[[noreturn]] void refuse(
  const std::string& name, const std::string& object, const std::string& reason)
{
  throw Error(name + ": " + inQuotes(object) + ' ' + reason + '.');
}

/** Whether a dataset has its numbers in the file itself or, with `virtualToo`, in virtual parts. */
bool isStored(hid_t properties, bool virtualToo)
{
  return H5Pget_external_count(properties) == 0 &&
         (virtualToo || H5Pget_layout(properties) != H5D_VIRTUAL);
}

/** A text that HDF5 gives by a function of its size and place. */
template <class Get>
std::string textOf(Get&& get)
{
  const ssize_t length = get(nullptr, 0);
  std::vector<char> text(static_cast<std::size_t>(std::max<ssize_t>(length, 0)) + 1);
  get(text.data(), text.size());
  return text.data();
}

void checkSource(hid_t file, const std::string& name, const std::string& object)
{
  checkLinks(file, name, object);
  const Hdf5Handle<H5Dclose> set(H5Dopen2(file, object.c_str(), H5P_DEFAULT));
  const Hdf5Handle<H5Pclose> properties(set.valid() ? H5Dget_create_plist(set.id()) : -1);
  if (!properties.valid() || !isStored(properties.id(), false))
  {
    refuse(name, object, "has its numbers elsewhere, which is not followed any further");
  }
}

} // namespace

bool checkLinks(std::int64_t file, const std::string& name, const std::string& object)
{
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = object.find('/', end + 1);
    const std::string path = object.substr(0, end);
    H5L_info_t link{};
    if (H5Lget_info(file, path.c_str(), &link, H5P_DEFAULT) < 0)
    {
      return false;
    }
    if (link.type != H5L_TYPE_HARD)
    {
      refuse(name, path, "is a link, which is not followed: write all data into the file itself");
    }
  }
  return true;
}

void checkSources(std::int64_t dataset, const std::string& name, const std::string& object)
{
  const Hdf5Handle<H5Pclose> properties(H5Dget_create_plist(dataset));
  if (!properties.valid() || !isStored(properties.id(), true))
  {
    refuse(name, object, "has its numbers in a file without structure, which is not read");
  }
  if (H5Pget_layout(properties.id()) != H5D_VIRTUAL)
  {
    return;
  }
  const hid_t list = properties.id();
  const Hdf5Handle<H5Fclose> own(H5Iget_file_id(dataset));
  const std::filesystem::path path =
    textOf([&](char* text, std::size_t size) { return H5Fget_name(own.id(), text, size); });
  std::size_t count = 0;
  H5Pget_virtual_count(list, &count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string source = textOf(
      [&](char* text, std::size_t size) { return H5Pget_virtual_filename(list, i, text, size); });
    const std::string part = textOf(
      [&](char* text, std::size_t size) { return H5Pget_virtual_dsetname(list, i, text, size); });
    if (source == ".")
    {
      checkSource(own.id(), name, part);
      continue;
    }
    const std::filesystem::path other = nearbyFile(path.parent_path(), source);
    const Hdf5Handle<H5Fclose> file(
      other.empty() ? -1 : H5Fopen(other.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    if (!file.valid())
    {
      refuse(name, object,
        "lies in " + inQuotes(source) +
          ": only HDF5 files in the same folder, or below it, are read");
    }
    checkSource(file.id(), other.string(), part);
  }
}

} // namespace smg
