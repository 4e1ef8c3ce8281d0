// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/VtkHdf/Hdf5/Hdf5Output.h"
#include "smg/Column.h"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace smg::testing
{

using Integers = std::initializer_list<std::int64_t>;

/** Writes the parts of a VTKHDF file. */
class HdfFile
{
public:
  HdfFile(const std::filesystem::path& path, const std::string& type)
    : Out(path)
  {
    this->Out.addGroup("/VTKHDF");
    this->Out.addText("/VTKHDF", "Type", type);
    this->Out.addIntegers("/VTKHDF", "Version", std::vector<std::int64_t>{ 2, 0 });
  }

  void group(const std::string& name) { this->Out.addGroup("/VTKHDF/" + name); }
  void integers(const std::string& name, Integers values)
  {
    this->add(name, ScalarType::Int64, 0, std::vector<std::int64_t>(values));
  }
  void integers(const std::string& name, int components, Integers values)
  {
    this->add(name, ScalarType::Int64, components, std::vector<std::int64_t>(values));
  }
  void bytes(const std::string& name, std::initializer_list<std::uint8_t> values)
  {
    this->add(name, ScalarType::UInt8, 0, std::vector<std::uint8_t>(values));
  }
  void reals(const std::string& name, int components, std::initializer_list<float> values)
  {
    this->add(name, ScalarType::Float32, components, std::vector<float>(values));
  }
  /** The counts and cells of one kind of cells in polygonal data. */
  void cells(const std::string& name, Integers cells, Integers ids, Integers points, Integers ends)
  {
    this->group(name);
    this->integers(name + "/NumberOfCells", cells);
    this->integers(name + "/NumberOfConnectivityIds", ids);
    this->integers(name + "/Connectivity", points);
    this->integers(name + "/Offsets", ends);
  }
  void normals(const std::string& name) { this->Out.addText("/VTKHDF/PointData", "Normals", name); }
  void finish() { this->Out.finish(); }
  Hdf5Output& out() { return this->Out; }

private:
  template <class T>
  void add(const std::string& name, ScalarType type, int components, const std::vector<T>& values)
  {
    this->Out.addDataset("/VTKHDF/" + name, type, components);
    this->Out.append("/VTKHDF/" + name, std::span<const T>(values));
  }

  Hdf5Output Out;
};

} // namespace smg::testing
