// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkMeshImport.h"

#include "IO/Container/NormalsColumn.h"
#include "IO/Container/ReservedNames.h"
#include "IO/Import/CellCollector.h"
#include "IO/Import/VtkSizes.h"
#include "IO/vtkPieceColumns.h"
#include "IO/vtkReaderComplaints.h"
#include "Solver/Core/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** What to do where Expat, which parses XML for VTK, no longer lets it skip appended data. */
std::string advice(const std::string& complaint, bool appendedData)
{
  return appendedData && complaint.find("not well-formed") != std::string::npos
           ? "; unless the file is damaged, this VTK cannot read <AppendedData> with the installed "
             "version of Expat (libexpat1): save the file elsewhere with binary or ascii instead "
             "of appended data, for example with a ParaView of paraview.org"
           : "";
}

template <class Reader>
vtkSmartPointer<vtkPointSet> run(const std::filesystem::path& path, bool appendedData)
{
  vtkNew<Reader> reader;
  vtkReaderComplaints complaints;
  reader->AddObserver(vtkCommand::ErrorEvent, complaints.command());
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, complaints.command());
  if constexpr (std::is_base_of_v<vtkXMLReader, Reader>)
  {
    reader->SetReaderErrorObserver(complaints.command());
    reader->SetParserErrorObserver(complaints.command());
  }
  else
  {
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllNormalsOn();
    reader->ReadAllTensorsOn();
    reader->ReadAllColorScalarsOn();
    reader->ReadAllTCoordsOn();
    reader->ReadAllFieldsOn();
  }
  reader->SetFileName(path.c_str());
  try
  {
    reader->Update();
  }
  catch (const std::exception& exception)
  {
    // A wrong count in the file ends in an allocation that fails.
    throw Error(path.string() + ": VTK cannot read the file (" + exception.what() +
                "): it is damaged, or too large for the memory.");
  }
  if (!complaints.text().empty() || reader->GetErrorCode() != 0)
  {
    throw Error(path.string() + ": VTK cannot read the file: " +
                (complaints.text().empty() ? "unknown error" : complaints.text()) +
                advice(complaints.text(), appendedData) + '.');
  }
  return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> read(
  const std::filesystem::path& path, MeshFormat format, const VtkSizes& sizes)
{
  if (sizes.kind == VtkDataKind::Other)
  {
    throw Error(
      path.string() +
      ": the file is neither polygonal data nor an unstructured grid of VTK, which are the kinds "
      "that hold meshes.");
  }
  const bool poly = sizes.kind == VtkDataKind::PolyData;
  const bool appended = sizes.appendedData;
  if (format == MeshFormat::VtkXml)
  {
    return poly ? run<vtkXMLPolyDataReader>(path, appended)
                : run<vtkXMLUnstructuredGridReader>(path, appended);
  }
  return poly ? run<vtkPolyDataReader>(path, appended)
              : run<vtkUnstructuredGridReader>(path, appended);
}

/** The name of an array: the normals that are active have that of normals, unless it is taken. */
std::string nameOf(vtkDataSetAttributes& data, vtkDataArray& array)
{
  const std::string name = array.GetName() ? array.GetName() : "";
  const bool areNormals = &array == data.GetNormals() && array.GetNumberOfComponents() == 3;
  return areNormals && !data.HasArray(NormalsName) ? NormalsName : name;
}

/** The numeric arrays, but for those that VTK keeps for itself. */
std::vector<Column> columnsOf(vtkDataSetAttributes* data, std::int64_t tuples)
{
  std::vector<Column> columns;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const std::optional<ScalarType> type = array ? scalarTypeOf(*array) : std::nullopt;
    const std::string name = array ? nameOf(*data, *array) : "";
    if (!type || name.empty() || name == GhostTypeName || array->GetNumberOfTuples() != tuples ||
        array->GetNumberOfComponents() < 1)
    {
      continue;
    }
    Column column{ { name, *type, array->GetNumberOfComponents() }, {} };
    column.resize(static_cast<std::size_t>(tuples));
    if (tuples > 0)
    {
      std::memcpy(column.bytes.data(), array->GetVoidPointer(0), column.bytes.size());
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

/** Takes the points and cells of a VTK data set. */
class Translator
{
public:
  Translator(const std::filesystem::path& path, vtkPointSet* data)
    : Path(path)
    , Data(data)
    , Points(data->GetNumberOfPoints())
  {
  }

  IndexedMesh translate()
  {
    this->takePoints();
    this->Mesh.vertexColumns = columnsOf(this->Data->GetPointData(), this->Points);
    if (auto* poly = vtkPolyData::SafeDownCast(this->Data))
    {
      this->takePolyData(poly);
    }
    else
    {
      this->takeGrid(vtkUnstructuredGrid::SafeDownCast(this->Data));
    }
    this->Cells.finish(this->Mesh, columnsOf(this->Data->GetCellData(), this->Cells.elements()));
    return std::move(this->Mesh);
  }

private:
  void takePoints()
  {
    vtkPoints* points = this->Data->GetPoints();
    this->Mesh.doublePositions = points && points->GetDataType() != VTK_FLOAT;
    this->Mesh.positions.resize(static_cast<std::size_t>(this->Points) * 3);
    for (vtkIdType i = 0; i < this->Points; ++i)
    {
      double* point = this->Mesh.positions.data() + 3 * i;
      points->GetPoint(i, point);
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
      {
        throw Error(
          this->Path.string() + ": a coordinate of point " + std::to_string(i) + " is not finite.");
      }
    }
  }

  /** VTK takes the places where cells begin from the file as they are. */
  void checkOffsets(vtkCellArray* cells)
  {
    vtkDataArray* offsets = cells->GetOffsetsArray();
    double last = 0.0;
    for (vtkIdType i = 0; i < offsets->GetNumberOfTuples(); ++i)
    {
      const double offset = offsets->GetTuple1(i);
      if (offset < last || (i == 0 && offset != 0.0) ||
          offset > static_cast<double>(cells->GetNumberOfConnectivityIds()))
      {
        throw Error(this->Path.string() + ": cell " + std::to_string(i) +
                    " has no sound place in the list of corners: the file is damaged.");
      }
      last = offset;
    }
  }

  /** The points of a cell, checked. */
  void takeCorners(vtkCellArray* cells, vtkIdType cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCellAtId(cell, count, ids);
    this->Corners.assign(ids, ids + count);
    for (const std::int64_t id : this->Corners)
    {
      if (id < 0 || id >= this->Points)
      {
        throw Error(this->Path.string() + ": cell " + std::to_string(this->Cells.elements()) +
                    " names point " + std::to_string(id) + ", but there are " +
                    std::to_string(this->Points) + '.');
      }
    }
  }

  void takePolyData(vtkPolyData* poly)
  {
    for (vtkIdType i = 0; i < poly->GetNumberOfVerts() + poly->GetNumberOfLines(); ++i)
    {
      this->Cells.dropped();
    }
    this->checkOffsets(poly->GetPolys());
    this->checkOffsets(poly->GetStrips());
    for (vtkIdType i = 0; i < poly->GetNumberOfPolys(); ++i)
    {
      this->takeCorners(poly->GetPolys(), i);
      this->takePolygon();
    }
    for (vtkIdType i = 0; i < poly->GetNumberOfStrips(); ++i)
    {
      this->takeCorners(poly->GetStrips(), i);
      this->Cells.strip(this->Corners);
    }
  }

  void takePolygon()
  {
    if (this->Corners.size() == 3)
    {
      this->Cells.triangle(this->Corners[0], this->Corners[1], this->Corners[2]);
    }
    else
    {
      this->Cells.polygon(this->Corners);
    }
  }

  void takeGrid(vtkUnstructuredGrid* grid)
  {
    vtkUnsignedCharArray* types = grid->GetCellTypesArray();
    if (!types || !grid->GetCells() || types->GetNumberOfValues() < grid->GetNumberOfCells())
    {
      throw Error(this->Path.string() + ": there are fewer types of cells than cells.");
    }
    this->checkOffsets(grid->GetCells());
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      this->takeCorners(grid->GetCells(), i);
      this->takeGridCell(grid->GetCellType(i));
    }
  }

  void takeGridCell(int type)
  {
    switch (type)
    {
      case VTK_TRIANGLE:
      case VTK_QUADRATIC_TRIANGLE:
        this->requireCorners(3);
        this->takePolygon();
        break;
      case VTK_QUAD:
      case VTK_QUADRATIC_QUAD:
        this->requireCorners(4);
        this->takePolygon();
        break;
      case VTK_PIXEL:
        this->requireCorners(4);
        std::swap(this->Corners[2], this->Corners[3]);
        this->takePolygon();
        break;
      case VTK_POLYGON:
        this->takePolygon();
        break;
      case VTK_TRIANGLE_STRIP:
        this->Cells.strip(this->Corners);
        break;
      case VTK_TETRA:
      case VTK_QUADRATIC_TETRA:
        this->requireCorners(4);
        this->Cells.tetrahedron(
          this->Corners[0], this->Corners[1], this->Corners[2], this->Corners[3]);
        break;
      case VTK_VERTEX:
      case VTK_POLY_VERTEX:
      case VTK_LINE:
      case VTK_POLY_LINE:
      case VTK_QUADRATIC_EDGE:
        this->Cells.dropped();
        break;
      default:
        throw Error(this->Path.string() + ": cell " + std::to_string(this->Cells.elements()) +
                    " is of VTK's type " + std::to_string(type) +
                    ", which is not read: cut the mesh into triangles or tetrahedra first.");
    }
  }

  /** The corners come first; what follows are points in the middle of edges. */
  void requireCorners(std::size_t count)
  {
    if (this->Corners.size() < count)
    {
      throw Error(this->Path.string() + ": cell " + std::to_string(this->Cells.elements()) +
                  " has too few points for its type.");
    }
    this->Corners.resize(count);
  }

  const std::filesystem::path& Path;
  vtkPointSet* Data;
  const vtkIdType Points;
  IndexedMesh Mesh;
  CellCollector Cells;
  std::vector<std::int64_t> Corners;
};

} // namespace

IndexedMesh importVtkMesh(
  const std::filesystem::path& path, MeshFormat format, const ImportOptions& options)
{
  const VtkSizes sizes = vtkSizes(path, format);
  options.budget.check(path, sizes.mesh);
  Progress progress(options.progress);
  progress.update(0.0);
  const vtkSmartPointer<vtkPointSet> data = read(path, format, sizes);
  progress.update(0.6);
  return Translator(path, data).translate();
}

void registerVtkImporter()
{
  setVtkImporter(importVtkMesh);
}

} // namespace smg
