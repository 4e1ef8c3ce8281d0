// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <hdf5.h>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** A dataset of an HDF5 file. */
struct Hdf5Shape
{
  /** The type of its numbers; none if it holds texts or other data. */
  std::optional<ScalarType> type;
  std::vector<std::uint64_t> extents;
  /** The bytes of a chunk, 0 if it is not stored in chunks. */
  std::uint64_t chunkBytes = 0;

  std::int64_t rows() const
  {
    return this->extents.empty() ? 1 : static_cast<std::int64_t>(this->extents[0]);
  }
  /** The number of values of a row. */
  std::int64_t components() const;
};

/**
 * An HDF5 file for reading, by the C library. Errors are those of this project: they name the file
 * and the object. Objects are identified by their paths, such as "/VTKHDF/Points". Other files to
 * which it refers are read if they are in its folder or below.
 */
class Hdf5File
{
public:
  /**
   * Throws Error if it is not an HDF5 file, or truncated. `name`: the name of the file in errors.
   */
  Hdf5File(const std::filesystem::path& path, std::string name);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  const std::string& name() const { return this->Name; }
  bool exists(const std::string& object) const;
  /** The names of the datasets of a group, in alphabetical order. Throws Error if it has more than
   * MaxDatasets members, or longer names than MaxNameBytes. */
  std::vector<std::string> datasets(const std::string& group) const;
  static constexpr std::uint64_t MaxDatasets = 4096, MaxNameBytes = 1024;
  Hdf5Shape shape(const std::string& dataset) const;

  /** An attribute of an object: a text, or none. */
  std::optional<std::string> text(const std::string& object, const char* attribute) const;
  /** An attribute of an object: an integer, or none. */
  std::optional<std::int64_t> integer(const std::string& object, const char* attribute) const;
  /** All characters of a dataset of texts of fixed lengths, at most 16 MiB. */
  std::string characters(const std::string& dataset) const;
  /** All of a short dataset of integers, row after row. */
  std::vector<std::int64_t> integers(const std::string& dataset) const;
  /** The same of numbers of any type. */
  std::vector<double> reals(const std::string& dataset) const;

  /** Throws Error: "NAME: SENTENCE". */
  [[noreturn]] void fail(const std::string& sentence) const;

  /** The library's handle of the file. */
  std::int64_t handle() const { return this->File; }

private:
  template <class T>
  std::vector<T> shortList(const std::string& dataset, ScalarType type, const char* what) const;

  std::string Name;
  std::int64_t File = -1;
};

/** Reads the numbers of a dataset sequentially, a range of whole rows at a time. */
class Hdf5Numbers
{
public:
  /** Starts at a number. A chunk is kept in memory. Throws Error. */
  Hdf5Numbers(const Hdf5File& file, std::string dataset, ScalarType type, std::int64_t begin);
  ~Hdf5Numbers();
  Hdf5Numbers(const Hdf5Numbers&) = delete;
  Hdf5Numbers& operator=(const Hdf5Numbers&) = delete;

  /** Bytes of a chunk, see Hdf5Shape. */
  std::uint64_t chunkBytes() const { return this->Shape.chunkBytes; }

  /** Fills the span with the next numbers. Throws Error if there are fewer. */
  void read(std::byte* values, std::size_t bytes);

private:
  void readRows(std::byte* values, std::int64_t first, std::int64_t count);

  const Hdf5File& File;
  std::string Name;
  ScalarType Type;
  std::int64_t At;
  Hdf5Shape Shape;
  std::int64_t Set = -1, Space = -1;
  std::vector<std::byte> Row; ///< of a row read in parts
};

/** A handle of the library, closed by the destructor. */
template <herr_t (*Close)(hid_t)>
class Hdf5Handle
{
public:
  explicit Hdf5Handle(hid_t id)
    : Id(id)
  {
  }
  ~Hdf5Handle()
  {
    if (this->Id >= 0)
    {
      Close(this->Id);
    }
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  hid_t id() const { return this->Id; }
  bool valid() const { return this->Id >= 0; }

private:
  hid_t Id;
};

/** Prevents the library from printing its errors during its lifetime. */
class Hdf5Silence
{
public:
  Hdf5Silence()
  {
    H5Eget_auto2(H5E_DEFAULT, &this->Function, &this->Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, this->Function, this->Data); }
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

private:
  H5E_auto2_t Function = nullptr;
  void* Data = nullptr;
};

inline hid_t nativeType(ScalarType type)
{
  switch (type)
  {
    case ScalarType::Int8:
      return H5T_NATIVE_INT8;
    case ScalarType::UInt8:
      return H5T_NATIVE_UINT8;
    case ScalarType::Int16:
      return H5T_NATIVE_INT16;
    case ScalarType::UInt16:
      return H5T_NATIVE_UINT16;
    case ScalarType::Int32:
      return H5T_NATIVE_INT32;
    case ScalarType::UInt32:
      return H5T_NATIVE_UINT32;
    case ScalarType::Int64:
      return H5T_NATIVE_INT64;
    case ScalarType::UInt64:
      return H5T_NATIVE_UINT64;
    case ScalarType::Float32:
      return H5T_NATIVE_FLOAT;
    case ScalarType::Float64:
      return H5T_NATIVE_DOUBLE;
  }
  return -1;
}

// An HDF5 file may name other files. A mesh from an untrusted source must not make a program read
// files anywhere: only virtual datasets are followed, as ParaView's parallel writer makes them, to
// datasets of files in the folder of the file or below.

/** Whether a file, called `name`, has an object. Throws Error if the path to it contains a link
 * that is not a plain (hard) one. */
bool checkLinks(std::int64_t file, const std::string& name, const std::string& object);

/** Throws Error if an open dataset of the file `name` has its numbers anywhere else. */
void checkSources(std::int64_t dataset, const std::string& name, const std::string& object);

} // namespace smg
