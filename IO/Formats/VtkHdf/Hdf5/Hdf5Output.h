// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace smg
{

/** An HDF5 file for writing: datasets to which rows are appended. finish() renames the file;
 * without finish() it is removed. Throws Error. */
class Hdf5Output
{
public:
  explicit Hdf5Output(const std::filesystem::path& path);
  ~Hdf5Output();
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  void addGroup(const std::string& name);
  void addText(const std::string& object, const char* attribute, const std::string& text);
  void addIntegers(
    const std::string& object, const char* attribute, std::span<const std::int64_t> values);
  /** A dataset without rows, of `components` numbers each; 0: a list of numbers. About `rows` will
   * be appended. */
  void addDataset(const std::string& name, ScalarType type, int components, std::int64_t rows = 0);

  /** Appends rows of the type of the dataset. */
  void append(const std::string& dataset, std::span<const std::byte> rows);
  template <class T>
  void append(const std::string& dataset, std::span<const T> values)
  {
    this->append(dataset, std::as_bytes(values));
  }

  void finish();

private:
  struct Dataset
  {
    std::int64_t handle = -1;
    ScalarType type = ScalarType::Int64;
    int components = 0;
    std::uint64_t rows = 0;
  };

  /** Returns whether everything could be closed. */
  bool close() noexcept;
  [[noreturn]] void fail() const;

  std::filesystem::path Path;
  FileDescriptor Part;
  std::int64_t File = -1;
  std::map<std::string, Dataset> Sets;
};

} // namespace smg
