// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Exodus/ExodusReader.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"
#include "IO/Formats/VtkHdf/Hdf5/VtkHdfLayout.h"
#include "IO/Formats/VtkHdf/Hdf5/WriteVtkHdf.h"
#include "IO/Formats/VtkHdf/VtkHdfFormat.h"
#include "IO/Import/RawMeshBuilder.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <hdf5.h>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

namespace
{

/** For example "The file has 5 time steps, of which number 3, counted from 0, is read." */
std::string noteOn(std::int64_t count, const char* what, std::int64_t chosen)
{
  return "The file has " + std::to_string(count) + what + ", of which " +
         (chosen == 0 ? "the first" : "number " + std::to_string(chosen) + ", counted from 0,") +
         " is read.";
}

/** The variables of a file of netCDF 4, whose datasets are in the root group; none of another. The
 * HDF5 file must outlive them. */
struct HdfVariables : NetCdfVariables
{
  explicit HdfVariables(const Hdf5File& hdf)
  {
    if (hdf.exists("/VTKHDF") || !hdf.exists("/connect1"))
    {
      return;
    }
    for (const std::string& name : hdf.datasets("/"))
    {
      const std::string path = '/' + name;
      const Hdf5Shape shape = hdf.shape(path);
      NetCdfVariable& variable = this->byName[name];
      variable.extents.assign(shape.extents.begin(), shape.extents.end());
      variable.elementType = hdf.text(path, "elem_type").value_or("");
      VtkArray& numbers = variable.numbers;
      numbers.name = name;
      numbers.values = shape.type ? shape.rows() * shape.components() : 0;
      numbers.type = numbers.columnType = shape.type.value_or(ScalarType::UInt8);
      this->Openers.push_back(std::make_unique<DatasetOpener>(hdf, path));
      numbers.opener = this->Openers.back().get();
    }
    this->characters = [&hdf](const std::string& name) { return hdf.characters('/' + name); };
  }

private:
  std::vector<std::unique_ptr<VtkArrayOpener>> Openers;
};

void importVtkHdf(InputFile& file, RawMeshBuilder& builder, const MeshPart& part)
{
  const Hdf5File hdf(file.path(), file.name());
  if (const HdfVariables variables(hdf); isExodus(variables))
  {
    readExodus(file, variables, part, builder);
    return;
  }
  VtkHdfLayout layout = vtkHdfLayout(hdf, part, builder.workspace().available() / 2);
  layout.files.emplace_back(file);
  layout.groupsText = hdf.text("/VTKHDF", MeshGroupsName).value_or("");
  builder.noteParts(layout.timeSteps, layout.partitions);
  if (layout.timeSteps > 1)
  {
    builder.note(noteOn(layout.timeSteps, " time steps", part.timeStep));
  }
  if (layout.isPart)
  {
    builder.note(noteOn(layout.partitions, " partitions", *part.partition));
  }
  readVtkMesh(file, layout, builder);
}

std::vector<ColumnSpec> hdfColumns(const std::vector<VtkArray>& arrays)
{
  std::vector<ColumnSpec> columns;
  for (const VtkArray& array : arrays)
  {
    columns.push_back({ array.name, array.type, array.components });
  }
  return columns;
}

FileCounts readCounts(InputFile& file, const MeshPart& part)
{
  const Hdf5File hdf(file.path(), file.name());
  constexpr std::int64_t MaxBytes = std::int64_t(16) << 20;
  const VtkHdfLayout layout = vtkHdfLayout(hdf, part, MaxBytes);
  FileCounts counts;
  // Points shared by partitions are counted in each.
  counts.counted = layout.pieces.size() == 1;
  StreamInfo& mesh = counts.mesh;
  mesh.vertices = mesh.cells = 0;
  for (const VtkPiece& piece : layout.pieces)
  {
    mesh.vertices += piece.points;
    mesh.cells += piece.cells;
  }
  if (!layout.pieces.empty())
  {
    const VtkPiece& first = layout.pieces.front();
    mesh.doublePositions = first.positions && first.positions->type == ScalarType::Float64;
    mesh.vertexColumns = hdfColumns(first.pointArrays);
    mesh.cellColumns = hdfColumns(first.cellArrays);
  }
  // A surface has about two triangles per vertex, a solid five to six tetrahedra.
  mesh.cellType = mesh.cells > 3 * mesh.vertices ? CellType::Tetrahedron : CellType::Triangle;
  return counts;
}

std::optional<FileCounts> countsOfVtkHdf(InputFile& file, const MeshPart& part)
{
  try
  {
    return readCounts(file, part);
  }
  catch (const Error&)
  {
    // Errors are reported when the mesh is read.
    return {};
  }
}

/** The times of the time steps; empty: there are none. Throws Error. */
std::vector<double> timesOfVtkHdf(const std::filesystem::path& path)
{
  const Hdf5File hdf(path, path.string());
  if (const HdfVariables variables(hdf); isExodus(variables))
  {
    InputFile file(path);
    return timesOfExodus(file, variables);
  }
  const std::int64_t steps = VtkHdfStep(hdf, 0).steps();
  const std::string dataset = VtkHdfRoot + "Steps/Values";
  std::vector<double> times;
  if (steps > 0 && hdf.exists(dataset))
  {
    times = hdf.reals(dataset);
    const bool ascend = std::ranges::adjacent_find(times, std::not_fn(std::less())) == times.end();
    if (static_cast<std::int64_t>(times.size()) != steps || !ascend ||
        !std::ranges::all_of(times, [](double time) { return std::isfinite(time); }))
    {
      hdf.fail("the dataset '" + dataset + "' should have " + std::to_string(steps) +
               " times, each later than the one before");
    }
  }
  else
  {
    for (std::int64_t step = 0; step < steps; ++step)
    {
      times.push_back(static_cast<double>(step));
    }
  }
  return times;
}

} // namespace

} // namespace smg

extern "C" const smg::VtkHdfLibrary* smgVtkHdfLibrary()
{
  // At the end of a program, the library may crash on files that it could not close.
  H5dont_atexit();
  static constexpr smg::VtkHdfLibrary library{ smg::importVtkHdf, smg::countsOfVtkHdf,
    [](const std::filesystem::path& vsm, const std::filesystem::path& path,
      const smg::ProgressFunction& progress) { return smg::writeVtkHdf(vsm, path, progress); },
    smg::timesOfVtkHdf };
  return &library;
}
