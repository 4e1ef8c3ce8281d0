// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Exodus/ExodusReader.h"
#include "IO/Formats/Exodus/ExodusWriter.h"
#include "IO/Mesh/Format.h"
#include "smg/Error.h"

#include <string_view>

namespace smg
{

namespace
{

void importExodus(
  InputFile& file, RawMeshBuilder& builder, const MeshPart& part, const ProgressFunction&)
{
  const NetCdfVariables variables = readNetCdfHeader(file);
  if (!isExodus(variables))
  {
    throw Error(file.name() + ": is a netCDF file without a mesh of Exodus: it has no coordinates "
                              "or no elements.");
  }
  readExodus(file, variables, part, builder);
}

std::vector<double> timesOfFile(const std::filesystem::path& path)
{
  InputFile file(path);
  return timesOfExodus(file, readNetCdfHeader(file));
}

/** Classic netCDF. Of HDF5 files the format follows from their content, see VtkHdfFormat. */
bool isNetCdf(std::string_view start)
{
  return start.size() > 3 && start.starts_with("CDF") &&
         (start[3] == 1 || start[3] == 2 || start[3] == 5);
}

constexpr FileSuffix ExodusSuffixes[] = { { ".e" }, { ".exo" }, { ".ex2" }, { ".g" } };

} // namespace

const Format ExodusFormat{
  .name = "Exodus II",
  .suffixes = ExodusSuffixes,
  .description = "netCDF, classic (also of 64 bits) and HDF5; one of any number of time steps; "
                 "written as classic netCDF",
  .cells = "solids, shells and plane elements; the corners of higher-order ones",
  .holdsColumns = true,
  .groups = GroupForm::Sides,
  .hasMagic = isNetCdf,
  .parse = importExodus,
  .hasParts = true,
  .times = timesOfFile,
  .typicalBytes = { 140, 4 },
  .bytes = bytesOfExodus,
  .writer = makeExodusWriter,
  .writeOrder = WriteOrder::ElementsFirst,
  .maxCorners = 4,
};

} // namespace smg
