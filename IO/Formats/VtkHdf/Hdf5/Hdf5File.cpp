// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

/** The type of numbers, or none. */
std::optional<ScalarType> scalarTypeOf(hid_t type)
{
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_FLOAT)
  {
    return size == 4   ? std::optional(ScalarType::Float32)
           : size == 8 ? std::optional(ScalarType::Float64)
                       : std::nullopt;
  }
  if (H5Tget_class(type) != H5T_INTEGER)
  {
    return {};
  }
  const bool isSigned = H5Tget_sign(type) == H5T_SGN_2;
  switch (size)
  {
    case 1:
      return isSigned ? ScalarType::Int8 : ScalarType::UInt8;
    case 2:
      return isSigned ? ScalarType::Int16 : ScalarType::UInt16;
    case 4:
      return isSigned ? ScalarType::Int32 : ScalarType::UInt32;
    case 8:
      return isSigned ? ScalarType::Int64 : ScalarType::UInt64;
    default:
      return {};
  }
}

/** Of a dataset created with these properties. */
std::uint64_t chunkBytesOf(hid_t properties, std::size_t numberBytes)
{
  if (H5Pget_layout(properties) != H5D_CHUNKED)
  {
    return 0;
  }
  std::array<hsize_t, H5S_MAX_RANK> extents{};
  const int rank = H5Pget_chunk(properties, H5S_MAX_RANK, extents.data());
  std::uint64_t bytes = numberBytes;
  for (int i = 0; i < rank; ++i)
  {
    if (__builtin_mul_overflow(bytes, extents[static_cast<std::size_t>(i)], &bytes))
    {
      return UINT64_MAX;
    }
  }
  return bytes;
}

/** The filter of a dataset that the library does not have, as "'NAME' (filter 32015 of HDF5)";
 * empty if it has all of them. */
std::string missingFilter(hid_t set)
{
  const Hdf5Handle<H5Pclose> properties(H5Dget_create_plist(set));
  const int filters = properties.valid() ? H5Pget_nfilters(properties.id()) : 0;
  for (int i = 0; i < filters; ++i)
  {
    std::array<char, 64> name{};
    unsigned flags = 0;
    unsigned config = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties.id(), static_cast<unsigned>(i), &flags,
      &values, nullptr, name.size() - 1, name.data(), &config);
    if (filter >= 0 && H5Zfilter_avail(filter) <= 0)
    {
      return (name[0] ? inQuotes(name.data()) + " " : std::string("a filter ")) + "(filter " +
             std::to_string(filter) + " of HDF5)";
    }
  }
  return {};
}

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

std::int64_t Hdf5Shape::components() const
{
  std::int64_t numbers = 1;
  for (std::size_t i = 1; i < this->extents.size(); ++i)
  {
    numbers *= static_cast<std::int64_t>(this->extents[i]);
  }
  return numbers;
}

Hdf5File::Hdf5File(const std::filesystem::path& path, std::string name)
  : Name(std::move(name))
{
  const Hdf5Silence silence;
  const Hdf5Handle<H5Pclose> access(H5Pcreate(H5P_FILE_ACCESS));
  // Some file systems have no locks, and locks of others are irrelevant to a reader.
  H5Pset_file_locking(access.id(), false, true);
  this->File = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id());
  if (this->File < 0)
  {
    this->fail("the HDF5 library cannot open the file: it is not an HDF5 file, or it is truncated "
               "or damaged");
  }
}

Hdf5File::~Hdf5File()
{
  const Hdf5Silence silence;
  H5Fclose(this->File);
}

void Hdf5File::fail(const std::string& sentence) const
{
  throw Error(this->Name + ": " + sentence + '.');
}

bool Hdf5File::exists(const std::string& object) const
{
  const Hdf5Silence silence;
  return checkLinks(this->File, this->Name, object);
}

std::vector<std::string> Hdf5File::datasets(const std::string& group) const
{
  const Hdf5Silence silence;
  std::vector<std::string> names;
  const Hdf5Handle<H5Gclose> handle(H5Gopen2(this->File, group.c_str(), H5P_DEFAULT));
  H5G_info_t info{};
  if (!handle.valid() || H5Gget_info(handle.id(), &info) < 0)
  {
    return names;
  }
  if (info.nlinks > MaxDatasets)
  {
    this->fail("the group " + inQuotes(group) + " has " + std::to_string(info.nlinks) +
               " members, but at most " + std::to_string(MaxDatasets) +
               " arrays are read: write fewer");
  }
  for (hsize_t i = 0; i < info.nlinks; ++i)
  {
    const ssize_t length =
      H5Lget_name_by_idx(handle.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
    if (length <= 0)
    {
      continue;
    }
    if (static_cast<std::uint64_t>(length) > MaxNameBytes)
    {
      this->fail("a name in the group " + inQuotes(group) + " has " + std::to_string(length) +
                 " bytes, but at most " + std::to_string(MaxNameBytes) + " are read: shorten it");
    }
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(
      handle.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    checkLinks(this->File, this->Name, group + '/' + name);
    const Hdf5Handle<H5Dclose> set(H5Dopen2(handle.id(), name.c_str(), H5P_DEFAULT));
    if (set.valid())
    {
      names.push_back(std::move(name));
    }
  }
  return names;
}

Hdf5Shape Hdf5File::shape(const std::string& dataset) const
{
  const Hdf5Silence silence;
  checkLinks(this->File, this->Name, dataset);
  const Hdf5Handle<H5Dclose> set(H5Dopen2(this->File, dataset.c_str(), H5P_DEFAULT));
  if (!set.valid())
  {
    this->fail("the dataset " + inQuotes(dataset) + " is missing");
  }
  checkSources(set.id(), this->Name, dataset);
  const Hdf5Handle<H5Tclose> type(H5Dget_type(set.id()));
  const Hdf5Handle<H5Sclose> space(H5Dget_space(set.id()));
  Hdf5Shape shape;
  shape.type = scalarTypeOf(type.id());
  std::array<hsize_t, H5S_MAX_RANK> extents{};
  const int rank = H5Sget_simple_extent_dims(space.id(), extents.data(), nullptr);
  if (rank < 0)
  {
    this->fail("the dataset " + inQuotes(dataset) + " has no extents");
  }
  std::uint64_t numbers = 1;
  for (int i = 0; i < rank; ++i)
  {
    shape.extents.push_back(extents[static_cast<std::size_t>(i)]);
    if (__builtin_mul_overflow(numbers, shape.extents.back(), &numbers) ||
        numbers > std::uint64_t(INT64_MAX) / 8)
    {
      this->fail("the extents of the dataset " + inQuotes(dataset) + " cannot be right");
    }
  }
  const Hdf5Handle<H5Pclose> properties(H5Dget_create_plist(set.id()));
  shape.chunkBytes = chunkBytesOf(properties.id(), H5Tget_size(type.id()));
  return shape;
}

std::optional<std::string> Hdf5File::text(const std::string& object, const char* attribute) const
{
  const Hdf5Silence silence;
  checkLinks(this->File, this->Name, object);
  const Hdf5Handle<H5Aclose> handle(
    H5Aopen_by_name(this->File, object.c_str(), attribute, H5P_DEFAULT, H5P_DEFAULT));
  if (!handle.valid())
  {
    return {};
  }
  const Hdf5Handle<H5Tclose> type(H5Aget_type(handle.id()));
  const Hdf5Handle<H5Sclose> space(H5Aget_space(handle.id()));
  if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1)
  {
    return {};
  }
  if (H5Tis_variable_str(type.id()) > 0)
  {
    char* value = nullptr;
    if (H5Aread(handle.id(), type.id(), &value) < 0 || !value)
    {
      return {};
    }
    std::string text(value);
    H5free_memory(value);
    return text;
  }
  constexpr std::size_t MaxBytes = 32768;
  std::string text(std::min(H5Tget_size(type.id()), MaxBytes), '\0');
  if (H5Tget_size(type.id()) > MaxBytes || H5Aread(handle.id(), type.id(), text.data()) < 0)
  {
    return {};
  }
  text.resize(std::strlen(text.c_str()));
  return text;
}

std::optional<std::int64_t> Hdf5File::integer(
  const std::string& object, const char* attribute) const
{
  const Hdf5Silence silence;
  checkLinks(this->File, this->Name, object);
  const Hdf5Handle<H5Aclose> handle(
    H5Aopen_by_name(this->File, object.c_str(), attribute, H5P_DEFAULT, H5P_DEFAULT));
  if (!handle.valid())
  {
    return {};
  }
  const Hdf5Handle<H5Sclose> space(H5Aget_space(handle.id()));
  const Hdf5Handle<H5Tclose> type(H5Aget_type(handle.id()));
  std::int64_t value = 0;
  if (H5Sget_simple_extent_npoints(space.id()) != 1 || H5Tget_class(type.id()) != H5T_INTEGER ||
      H5Aread(handle.id(), H5T_NATIVE_INT64, &value) < 0)
  {
    return {};
  }
  return value;
}

std::string Hdf5File::characters(const std::string& dataset) const
{
  constexpr std::uint64_t Most = std::uint64_t(16) << 20;
  const Hdf5Shape shape = this->shape(dataset);
  const Hdf5Silence silence;
  const Hdf5Handle<H5Dclose> set(H5Dopen2(this->File, dataset.c_str(), H5P_DEFAULT));
  const Hdf5Handle<H5Tclose> type(set.valid() ? H5Dget_type(set.id()) : -1);
  const bool areTexts =
    type.valid() && H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) <= 0;
  const auto texts = static_cast<std::uint64_t>(shape.rows() * shape.components());
  const std::uint64_t size = areTexts ? H5Tget_size(type.id()) : 0;
  if (!areTexts || texts > Most || size > Most || texts * size > Most || shape.chunkBytes > Most)
  {
    this->fail("the dataset " + inQuotes(dataset) + " should be a short list of texts");
  }
  std::string all(texts * size, '\0');
  if (H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0)
  {
    this->fail("the dataset " + inQuotes(dataset) + " cannot be read");
  }
  return all;
}

template <class T>
std::vector<T> Hdf5File::shortList(
  const std::string& dataset, ScalarType type, const char* what) const
{
  const Hdf5Shape shape = this->shape(dataset);
  constexpr std::int64_t Most = std::int64_t(1) << 20;
  constexpr std::uint64_t MaxChunkBytes = std::uint64_t(16) << 20;
  const std::int64_t count = shape.rows() * shape.components();
  if (!shape.type || (std::is_integral_v<T> && *shape.type >= ScalarType::Float32) ||
      count > Most || shape.chunkBytes > MaxChunkBytes)
  {
    this->fail("the dataset " + inQuotes(dataset) + " should be a short list of " + what);
  }
  std::vector<T> values(static_cast<std::size_t>(count));
  Hdf5Numbers(*this, dataset, type, 0)
    .read(reinterpret_cast<std::byte*>(values.data()), values.size() * sizeof(T));
  return values;
}

std::vector<std::int64_t> Hdf5File::integers(const std::string& dataset) const
{
  return this->shortList<std::int64_t>(dataset, ScalarType::Int64, "integers");
}

std::vector<double> Hdf5File::reals(const std::string& dataset) const
{
  return this->shortList<double>(dataset, ScalarType::Float64, "numbers");
}

Hdf5Numbers::Hdf5Numbers(
  const Hdf5File& file, std::string dataset, ScalarType type, std::int64_t begin)
  : File(file)
  , Name(std::move(dataset))
  , Type(type)
  , At(begin)
  , Shape(file.shape(this->Name))
{
  const Hdf5Silence silence;
  const Hdf5Handle<H5Pclose> access(H5Pcreate(H5P_DATASET_ACCESS));
  // Rows are read once, sequentially: one chunk is sufficient.
  constexpr std::size_t Slots = 101;
  H5Pset_chunk_cache(access.id(), Slots, this->Shape.chunkBytes + 1, 1.0);
  this->Set = H5Dopen2(file.handle(), this->Name.c_str(), access.id());
  this->Space = this->Set < 0 ? -1 : H5Dget_space(this->Set);
  if (this->Space < 0)
  {
    H5Dclose(this->Set);
    file.fail("the dataset " + inQuotes(this->Name) + " cannot be opened");
  }
}

Hdf5Numbers::~Hdf5Numbers()
{
  const Hdf5Silence silence;
  H5Sclose(this->Space);
  H5Dclose(this->Set);
}

void Hdf5Numbers::readRows(std::byte* values, std::int64_t first, std::int64_t count)
{
  const Hdf5Silence silence;
  std::array<hsize_t, H5S_MAX_RANK> begin{}, extents{};
  std::copy(this->Shape.extents.begin(), this->Shape.extents.end(), extents.begin());
  if (!this->Shape.extents.empty())
  {
    begin[0] = static_cast<hsize_t>(first);
    extents[0] = static_cast<hsize_t>(count);
    if (H5Sselect_hyperslab(
          this->Space, H5S_SELECT_SET, begin.data(), nullptr, extents.data(), nullptr) < 0)
    {
      this->File.fail(
        "the dataset " + inQuotes(this->Name) + " has no row " + std::to_string(first));
    }
  }
  const auto numbers = static_cast<hsize_t>(count * this->Shape.components());
  const Hdf5Handle<H5Sclose> memory(H5Screate_simple(1, &numbers, nullptr));
  if (H5Dread(this->Set, nativeType(this->Type), memory.id(), this->Space, H5P_DEFAULT, values) < 0)
  {
    const std::string filter = missingFilter(this->Set);
    this->File.fail("the dataset " + inQuotes(this->Name) + " cannot be read from row " +
                    std::to_string(first) + " on: " +
                    (filter.empty() ? "the file is damaged"
                                    : "it is compressed by " + filter +
                                        ", which the HDF5 library here does not have: compress it "
                                        "by gzip (h5repack -f GZIP=6)"));
  }
}

void Hdf5Numbers::read(std::byte* values, std::size_t bytes)
{
  const auto size = static_cast<std::int64_t>(sizeOf(this->Type));
  auto left = static_cast<std::int64_t>(bytes) / size;
  const std::int64_t width = this->Shape.components();
  if (this->At + left > this->Shape.rows() * width)
  {
    this->File.fail("the dataset " + inQuotes(this->Name) + " ends before it should, after " +
                    std::to_string(this->Shape.rows()) + " rows");
  }
  while (left > 0)
  {
    const std::int64_t row = this->At / width, within = this->At % width;
    std::int64_t taken = left / width * width;
    if (within == 0 && taken > 0)
    {
      this->readRows(values, row, taken / width);
    }
    else
    {
      this->Row.resize(static_cast<std::size_t>(width * size));
      this->readRows(this->Row.data(), row, 1);
      taken = std::min(left, width - within);
      std::memcpy(values, this->Row.data() + within * size, static_cast<std::size_t>(taken * size));
    }
    values += taken * size;
    this->At += taken;
    left -= taken;
  }
}

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
