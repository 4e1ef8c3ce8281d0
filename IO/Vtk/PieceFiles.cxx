// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceFiles.h"

#include "IO/Formats/Vtk/XmlTags.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceStream.h"
#include "Solver/Files/DiskFull.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace smg
{
namespace
{

void describe(std::ostream& out, vtkDataArray& array)
{
  const auto type = scalarTypeOf(array);
  if (!type || !array.GetName())
  {
    return;
  }
  out << "      <PDataArray type=\"" << vtkXmlTypeName(*type) << "\" Name=\""
      << xmlEscaped(array.GetName()) << "\" NumberOfComponents=\"" << array.GetNumberOfComponents()
      << "\"/>\n";
}

void describe(std::ostream& out, const char* element, vtkDataSetAttributes& arrays)
{
  vtkDataArray* ids = arrays.GetGlobalIds();
  out << "    <" << element;
  if (ids && ids->GetName())
  {
    out << " GlobalIds=\"" << xmlEscaped(ids->GetName()) << "\"";
  }
  out << ">\n";
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = arrays.GetArray(i))
    {
      describe(out, *array);
    }
  }
  out << "    </" << element << ">\n";
}

/** The part of the index that describes the arrays: the same for every piece with points. */
std::string describe(vtkPointSet& piece)
{
  std::ostringstream out;
  describe(out, "PPointData", *piece.GetPointData());
  describe(out, "PCellData", *piece.GetCellData());
  out << "    <PPoints>\n";
  describe(out, *piece.GetPoints()->GetData());
  out << "    </PPoints>\n";
  return out.str();
}

bool isSurfaceIndex(const std::filesystem::path& index)
{
  const std::string suffix = index.extension().string();
  return std::tolower(static_cast<unsigned char>(suffix.back())) == 'p';
}

std::string pieceName(const std::filesystem::path& index, int piece)
{
  const std::string suffix = isSurfaceIndex(index) ? ".vtp" : ".vtu";
  return index.stem().string() + "_" + std::to_string(piece) + suffix;
}

std::string indexText(
  const std::filesystem::path& index, int pieces, const std::string& description)
{
  const std::string type = isSurfaceIndex(index) ? "PPolyData" : "PUnstructuredGrid";
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type << "\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\">\n  <" << type << " GhostLevel=\"0\">\n"
      << description;
  for (int piece = 0; piece < pieces; ++piece)
  {
    out << "    <Piece Source=\"" << xmlEscaped(index.stem().string()) << "/"
        << xmlEscaped(pieceName(index, piece)) << "\"/>\n";
  }
  out << "  </" << type << ">\n</VTKFile>\n";
  return out.str();
}

/** Gives names of their own that XML can hold to the arrays of a shallow copy. */
void renameForXml(vtkDataSetAttributes& arrays)
{
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays.GetArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    std::string text = xmlText(name);
    if (text == name)
    {
      continue;
    }
    while (arrays.HasArray(text.c_str()))
    {
      text += '_';
    }
    const auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    copy->ShallowCopy(array);
    copy->SetName(text.c_str());
    arrays.AddArray(copy);
    arrays.RemoveArray(name.c_str());
    --i; // the next one is here now
  }
}

/** The piece as it is written: the arrays of the input keep their names. */
vtkSmartPointer<vtkPointSet> withNamesForXml(vtkPointSet& given)
{
  auto piece = vtkSmartPointer<vtkPointSet>::Take(given.NewInstance());
  piece->ShallowCopy(&given);
  renameForXml(*piece->GetPointData());
  renameForXml(*piece->GetCellData());
  return piece;
}

/** The piece without the cells of other pieces around it, which filters before have needed, and
 * their points. */
vtkSmartPointer<vtkPointSet> withoutGhosts(vtkPointSet& piece, CellType type)
{
  if (!piece.GetCellGhostArray())
  {
    return &piece;
  }
  std::vector<std::int64_t> corners = cellCorners(piece, type, "The input");
  vtkNew<vtkIdList> cells, points;
  for (const std::int64_t cell : keepOwnCells(piece, cornersOf(type), corners))
  {
    cells->InsertNextId(cell);
  }
  std::vector<std::int64_t> used = corners;
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::int64_t point : used)
  {
    points->InsertNextId(point);
  }
  for (std::int64_t& corner : corners)
  {
    corner = std::ranges::lower_bound(used, corner) - used.begin();
  }
  auto own = vtkSmartPointer<vtkPointSet>::Take(piece.NewInstance());
  vtkNew<vtkPoints> places;
  places->SetDataType(piece.GetPoints()->GetDataType());
  piece.GetPoints()->GetPoints(points, places);
  own->SetPoints(places);
  setCells(*own, corners, cornersOf(type));
  const auto copy = [](vtkDataSetAttributes& from, vtkIdList& ids, vtkDataSetAttributes& to)
  {
    to.CopyAllOn();
    to.CopyAllocate(&from, ids.GetNumberOfIds());
    for (vtkIdType k = 0; k < ids.GetNumberOfIds(); ++k)
    {
      to.CopyData(&from, ids.GetId(k), k);
    }
  };
  copy(*piece.GetPointData(), *points, *own->GetPointData());
  copy(*piece.GetCellData(), *cells, *own->GetCellData());
  own->GetCellData()->RemoveArray(GhostTypeName);
  own->GetFieldData()->ShallowCopy(piece.GetFieldData());
  return own;
}

void writePiece(vtkXMLWriter& writer, vtkPointSet& piece, const std::filesystem::path& path)
{
  writer.SetInputData(&piece);
  writer.SetFileName(path.c_str());
  writer.SetHeaderTypeToUInt64();
  // With recent versions of Expat many VTK readers reject appended data.
  writer.SetDataModeToBinary();
  const int done = writer.Write();
  writer.SetInputData(nullptr);
  if (writer.GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError)
  {
    throw DiskFull(
      path.string() + " cannot be written: free disk space, or choose another folder.");
  }
  if (!done)
  {
    throw Error(path.string() + " cannot be written: see VTK's error and free disk space.");
  }
}

/** Moves of files that are all undone if one of them fails. */
class Moves
{
public:
  Moves() = default;
  ~Moves()
  {
    for (auto move = this->Done.rbegin(); move != this->Done.rend(); ++move)
    {
      std::error_code ignored;
      std::filesystem::rename(move->second, move->first, ignored);
    }
  }
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;

  void add(const std::filesystem::path& from, const std::filesystem::path& to)
  {
    this->Done.reserve(this->Done.size() + 1);
    moveFile(from, to);
    this->Done.emplace_back(from, to);
  }
  void keep() { this->Done.clear(); }

private:
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> Done;
};

/** Moves the complete files from the scratch folder to their destination, the index last, and those
 * that they replace into the scratch folder. */
void install(const ScratchFolder& scratch, const std::filesystem::path& index, int pieces)
{
  const std::filesystem::path folder = index.parent_path() / index.stem();
  const std::filesystem::path replaced = scratch.path() / "replaced";
  std::filesystem::create_directory(replaced);
  std::filesystem::create_directories(folder);
  Moves moves;
  if (std::filesystem::exists(index))
  {
    moves.add(index, replaced / index.filename());
  }
  for (int piece = 0; std::filesystem::exists(folder / pieceName(index, piece)); ++piece)
  {
    moves.add(folder / pieceName(index, piece), replaced / pieceName(index, piece));
  }
  for (int piece = 0; piece < pieces; ++piece)
  {
    const std::string name = pieceName(index, piece);
    FileDescriptor::syncPath(scratch.path() / name, folder / name);
    moves.add(scratch.path() / name, folder / name);
  }
  FileDescriptor::syncPath(folder, index);
  FileDescriptor::syncPath(scratch.path() / index.filename(), index);
  moves.add(scratch.path() / index.filename(), index);
  moves.keep();
  FileDescriptor::syncPath(index.parent_path(), index);
}

} // namespace

void writePieceFiles(
  PieceInput& input, int pieces, const std::filesystem::path& path, Progress& progress)
{
  const std::filesystem::path index = std::filesystem::absolute(path);
  const ScratchFolder scratch(index.parent_path());
  const bool isSurface = isSurfaceIndex(index);
  std::string description;
  int files = 0;
  // The stream checks the pieces; its blocks are not needed here but for that.
  PieceStream stream(
    input, { .given = pieces }, { .all = input.isFiltered(), .required = {}, .optional = {} });
  MeshBlock block;
  while (vtkPointSet* given = stream.nextPiece(block))
  {
    const vtkSmartPointer<vtkPointSet> piece =
      withNamesForXml(*withoutGhosts(*given, stream.info().cellType));
    if (!piece->IsA(isSurface ? "vtkPolyData" : "vtkUnstructuredGrid"))
    {
      throw Error(path.string() + " cannot hold a " + piece->GetClassName() +
                  ": use .pvtp for vtkPolyData and .pvtu for vtkUnstructuredGrid.");
    }
    if (files == 0)
    {
      description = describe(*piece);
    }
    const std::filesystem::path file = scratch.path() / pieceName(index, files++);
    if (isSurface)
    {
      writePiece(*vtkNew<vtkXMLPolyDataWriter>(), *piece, file);
    }
    else
    {
      writePiece(*vtkNew<vtkXMLUnstructuredGridWriter>(), *piece, file);
    }
    progress.update(stream.fraction());
  }
  writeFile(scratch.path() / index.filename(), indexText(index, files, description));
  install(scratch, index, files);
}

} // namespace smg
