// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Mesh/Format.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace smg
{

/** A variable of a netCDF file: where its numbers are, as an array of VTK's files. */
struct NetCdfVariable
{
  VtkArray numbers;                  ///< all of them; of a text, none
  std::vector<std::int64_t> extents; ///< the first is the number of time steps of what has them
  std::int64_t recordBytes = 0;      ///< between time steps; 0: they follow each other
  std::string elementType;           ///< the attribute `elem_type`

  /** So many numbers from number `first` on. */
  VtkArray range(std::int64_t first, std::int64_t count) const;
  /** The same of the numbers of a time step. */
  VtkArray step(std::int64_t step, std::int64_t first, std::int64_t count) const;
};

/** The variables of a netCDF file, classic or HDF5. */
struct NetCdfVariables
{
  std::map<std::string, NetCdfVariable> byName;
  /** The characters of a text variable, at most 16 MiB. Throws Error. */
  std::function<std::string(const std::string& name)> characters;

  const NetCdfVariable* find(const std::string& name) const
  {
    const auto found = this->byName.find(name);
    return found == this->byName.end() ? nullptr : &found->second;
  }
};

/** Reads the header of a classic netCDF file, versions 1, 2 and 5. Throws Error with the place in
 * the file. */
NetCdfVariables readNetCdfHeader(InputFile& file);

/** Whether these are variables of an Exodus file. */
SMG_EXPORT bool isExodus(const NetCdfVariables& variables);

/**
 * Reads an Exodus file: element blocks, node sets and side sets are groups, with their numbers and
 * names; results of a time step are columns. Throws Error; MeshError.
 */
SMG_EXPORT void readExodus(
  InputFile& file, const NetCdfVariables& variables, const MeshPart& part, RawMeshBuilder& builder);

/** The times of its time steps; empty: it has none. Throws Error. */
SMG_EXPORT std::vector<double> timesOfExodus(InputFile& file, const NetCdfVariables& variables);

} // namespace smg
