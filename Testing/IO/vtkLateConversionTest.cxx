// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/FormatSuffixes.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include "vtkDataArraySelection.h"
#include "vtkElevationFilter.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

/** Bytes that this process has read from the system so far; -1: the system does not count them. */
std::int64_t bytesReadByAll()
{
  std::ifstream io("/proc/self/io");
  std::string name;
  std::int64_t bytes = -1;
  io >> name >> bytes;
  return bytes;
}

/** Bytes of the files in a folder. */
std::uintmax_t bytesIn(const std::filesystem::path& folder)
{
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    bytes += entry.is_regular_file() ? entry.file_size() : 0;
  }
  return bytes;
}

/** The suffixes of all files with these cells that are read and written, but those of containers.
 */
std::set<std::string> suffixesOf(CellType cells)
{
  return suffixesWhere([cells](auto& format, auto& suffix)
    { return format.bytes && format.kind != MeshFileKind::Vsm && suffix.holds(cells); });
}

/** Appends a number as it is in memory, or in the other byte order. */
template <class T>
void put(std::string& bytes, T value, bool reversed = false)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (reversed)
  {
    std::reverse(std::begin(raw), std::end(raw));
  }
  bytes.append(raw, sizeof(T));
}

/** The sizes of the huge meshes. */
constexpr std::int64_t HugeVertices = 30000000, HugeCells = 20000000;

/** A file with holes: bytes at their offsets; the last ones are its end. */
using Sparse = std::vector<std::pair<std::uintmax_t, std::string>>;

void writeSparse(const std::filesystem::path& path, const Sparse& parts)
{
  std::ofstream file(path, std::ios::binary);
  for (const auto& [offset, bytes] : parts)
  {
    file.seekp(static_cast<std::streamoff>(offset));
    file << bytes;
  }
}

/** Tetrahedra behind the vertices, of the version with positions of 64 bits. */
Sparse hugeMeshb()
{
  std::string head, cells;
  for (const std::int32_t number : { 1, 3, 3 })
  {
    put(head, number);
  }
  put<std::int64_t>(head, 24);
  put<std::int32_t>(head, 3);
  constexpr std::int64_t Begin = 24 + 16, End = Begin + HugeVertices * 28;
  put<std::int32_t>(head, 4);
  put<std::int64_t>(head, End);
  put(head, static_cast<std::int32_t>(HugeVertices));
  put<std::int32_t>(cells, 8);
  put<std::int64_t>(cells, 0);
  put(cells, static_cast<std::int32_t>(HugeCells));
  for (const std::int32_t number : { 1, 2, 3, 4, 0 })
  {
    put(cells, number);
  }
  return { { 0, head }, { End, cells }, { End + 16 + HugeCells * 20 - 1, std::string(1, '\0') } };
}

Sparse hugeMsh()
{
  std::string head = "$MeshFormat\n4.1 1 8\n", cells = "\n$EndNodes\n$Elements\n";
  put<std::int32_t>(head, 1);
  head += "\n$EndMeshFormat\n$Nodes\n";
  const auto block = [](std::string& bytes, std::int64_t count, std::int32_t third)
  {
    for (const std::int64_t number : { std::int64_t(1), count, std::int64_t(1), count })
    {
      put(bytes, number);
    }
    for (const std::int32_t number : { 3, 1, third })
    {
      put(bytes, number);
    }
    put(bytes, count);
  };
  block(head, HugeVertices, 0);
  block(cells, HugeCells, 4);
  for (std::int64_t number = 1; number < 6; ++number)
  {
    put(cells, number);
  }
  const std::uintmax_t at = head.size() + HugeVertices * 32;
  return { { 0, head }, { at, cells }, { at + cells.size() + HugeCells * 40, "\n$EndElements\n" } };
}

Sparse hugeVtk()
{
  const std::string head =
    "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
    std::to_string(HugeVertices) + " double\n";
  std::string cells =
    "\nCELLS " + std::to_string(HugeCells) + ' ' + std::to_string(5 * HugeCells) + '\n';
  const std::uintmax_t begin = head.size() + HugeVertices * 24;
  std::uintmax_t types = begin + cells.size() + HugeCells * 20;
  for (const std::int32_t number : { 4, 0, 1, 2, 3 })
  {
    put(cells, number, true);
  }
  std::string kinds = "\nCELL_TYPES " + std::to_string(HugeCells) + '\n';
  const std::uintmax_t end = types + kinds.size() + HugeCells * 4;
  put<std::int32_t>(kinds, 10, true);
  const std::string data = "\nPOINT_DATA " + std::to_string(HugeVertices) +
                           "\nSCALARS Heat float 1\nLOOKUP_TABLE default\n";
  return { { 0, head }, { begin, cells }, { types, kinds }, { end, data },
    { end + data.size() + HugeVertices * 4, "\n" } };
}

Sparse hugeVtu()
{
  std::uintmax_t offset = 0;
  const auto array =
    [&offset](const char* type, const char* name, int components, std::int64_t values, int bytes)
  {
    std::ostringstream tag;
    tag << "<DataArray type='" << type << "' Name='" << name << "' NumberOfComponents='"
        << components << "' format='appended' offset='" << offset << "'/>\n";
    offset += 8 + static_cast<std::uintmax_t>(values) * static_cast<std::uintmax_t>(bytes);
    return tag.str();
  };
  std::ostringstream text;
  text << "<VTKFile type='UnstructuredGrid' version='1.0' byte_order='LittleEndian' "
          "header_type='UInt64'>\n"
       << "<UnstructuredGrid><Piece NumberOfPoints='" << HugeVertices << "' NumberOfCells='"
       << HugeCells << "'>\n<PointData>" << array("Float32", "Heat", 1, HugeVertices, 4)
       << "</PointData>\n<Points>";
  const std::uintmax_t points = offset;
  text << array("Float64", "Points", 3, HugeVertices * 3, 8) << "</Points>\n<Cells>";
  const std::uintmax_t corners = offset;
  text << array("Int32", "connectivity", 1, HugeCells * 4, 4);
  const std::uintmax_t ends = offset;
  text << array("Int32", "offsets", 1, HugeCells, 4);
  const std::uintmax_t types = offset;
  text << array("UInt8", "types", 1, HugeCells, 1)
       << "</Cells>\n</Piece></UnstructuredGrid>\n<AppendedData encoding='raw'>_";
  const std::string head = text.str();
  const auto block = [](std::uint64_t bytes, std::initializer_list<std::int32_t> numbers)
  {
    std::string data;
    put(data, bytes);
    for (const std::int32_t number : numbers)
    {
      put(data, number);
    }
    return data;
  };
  return { { 0, head }, { head.size(), block(HugeVertices * 4, {}) },
    { head.size() + points, block(HugeVertices * 24, {}) },
    { head.size() + corners, block(HugeCells * 16, { 0, 1, 2, 3 }) },
    { head.size() + ends, block(HugeCells * 4, { 4 }) },
    { head.size() + types, block(HugeCells, {}) + '\x0a' },
    { head.size() + offset, "</AppendedData></VTKFile>" } };
}

/** Files are not converted before data are requested. */
class VtkLateConversion : public ::testing::Test
{
protected:
  void SetUp() override
  {
    writeBytes(this->Surface, meshText(torus(40, 30, 0.2)));
    writeBytes(this->Solid, meshText(tetBox(9, 8, 7, 0.1)));
    std::filesystem::create_directory(this->Scratch);
  }

  bool isConverted() const
  {
    return bytesIn(this->Scratch) > 0 || std::filesystem::exists(this->Converted);
  }

  void expectPieces(vtkStreamingMeshReader& reader, const std::filesystem::path& path, bool isSolid)
  {
    SCOPED_TRACE(path.filename().string() + " by " + reader.GetClassName());
    Errors errors(&reader);
    reader.SetFileName(path.c_str());
    reader.SetScratchDirectory(this->Scratch.c_str());
    reader.UpdateDataObject();
    const char* const type = isSolid ? "vtkUnstructuredGrid" : "vtkPolyData";
    EXPECT_TRUE(reader.GetOutputDataObject(0)->IsA(type));
    reader.UpdateInformation();
    EXPECT_FALSE(this->isConverted());
    EXPECT_EQ(reader.GetFullNumberOfPoints(), -1);
    vtkDataArraySelection* const arrays = reader.GetPointDataArraySelection();
    EXPECT_TRUE(arrays->ArrayExists("OriginalId"));
    ASSERT_TRUE(updatePiece(&reader, 0, 1)) << errors.text();
    EXPECT_TRUE(this->isConverted());
    auto* const mesh = vtkPointSet::SafeDownCast(reader.GetOutputDataObject(0));
    EXPECT_TRUE(mesh->IsA(type));
    EXPECT_EQ(mesh->GetNumberOfPoints(), isSolid ? 9 * 8 * 7 : 1200);
    EXPECT_EQ(reader.GetFullNumberOfPoints(), mesh->GetNumberOfPoints());
    vtkInformation* const told = reader.GetOutputInformation(0);
    EXPECT_TRUE(told->Has(vtkStreamingMeshKeys::PREVIEWED()));
    EXPECT_TRUE(std::filesystem::exists(told->Get(vtkStreamingMeshKeys::STREAM_FILE())));
    const vtkMTimeType executed = mesh->GetMTime();
    ASSERT_TRUE(updatePiece(&reader, 0, 1));
    EXPECT_EQ(mesh->GetMTime(), executed) << "executes again by itself";
    EXPECT_EQ(errors.text(), "");
    std::filesystem::remove(this->Converted);
  }

  TemporaryFolder Folder;
  std::filesystem::path Surface = this->Folder / "mesh.off", Solid = this->Folder / "tets.mesh",
                        Scratch = this->Folder / "scratch",
                        Converted = this->Folder / "converted.vsm";
};

TEST_F(VtkLateConversion, NothingIsConvertedBeforeDataAreRequested)
{
  for (const bool isSolid : { false, true })
  {
    const auto suffixes = suffixesOf(isSolid ? CellType::Tetrahedron : CellType::Triangle);
    EXPECT_GT(suffixes.size(), 8U);
    for (const std::string& suffix : suffixes)
    {
      const std::filesystem::path from = isSolid ? this->Solid : this->Surface,
                                  path = from.stem().string() + suffix;
      if (this->Folder / path != from)
      {
        convert(from, this->Folder / path);
      }
      this->expectPieces(*vtkNew<vtkStreamingMeshReader>(), this->Folder / path, isSolid);
      vtkNew<vtkStreamingMeshConverter> converter;
      converter->SetOutputFileName(this->Converted.c_str());
      this->expectPieces(*converter, this->Folder / path, isSolid);
    }
  }
}

/** Pieces of VTK, compressed files, and a binary form that is only read. */
TEST_F(VtkLateConversion, NorAreFilesThatAreOnlyRead)
{
  const auto pieces = [](const std::string& kind, const std::string& piece)
  {
    return "<VTKFile type='P" + kind + "'><P" + kind + "><Piece Source='" + piece + "'/></P" +
           kind + "></VTKFile>";
  };
  convert(this->Surface, this->Folder / "one.vtp");
  convert(this->Solid, this->Folder / "one.vtu");
  writeBytes(this->Folder / "all.pvtp", pieces("PolyData", "one.vtp"));
  writeBytes(this->Folder / "all.pvtu", pieces("UnstructuredGrid", "one.vtu"));
  for (const char* name : { "one.vtu", "one.vtp", "all.pvtu", "tets.mesh" })
  {
    ASSERT_EQ(std::system(("gzip -fk '" + (this->Folder / name).string() + "'").c_str()), 0);
  }
  for (const char* name : { "all.pvtp", "one.vtp.gz" })
  {
    this->expectPieces(*vtkNew<vtkStreamingMeshReader>(), this->Folder / name, false);
  }
  for (const char* name : { "all.pvtu", "one.vtu.gz", "all.pvtu.gz", "tets.mesh.gz" })
  {
    this->expectPieces(*vtkNew<vtkStreamingMeshReader>(), this->Folder / name, true);
  }
}

/** Of a gigabyte, the blocks where the cells begin. */
TEST_F(VtkLateConversion, OnlyTheBeginningOfTheCellsIsReadBeforeDataAreRequested)
{
  for (const auto& [name, parts] : std::map<std::string, Sparse>{ { "huge.meshb", hugeMeshb() },
         { "huge.msh", hugeMsh() }, { "huge.vtk", hugeVtk() }, { "huge.vtu", hugeVtu() } })
  {
    SCOPED_TRACE(name);
    const std::filesystem::path path = this->Folder / name;
    writeSparse(path, parts);
    ASSERT_GT(std::filesystem::file_size(path), std::uintmax_t(1) << 30);
    vtkNew<vtkStreamingMeshReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetScratchDirectory(this->Scratch.c_str());
    Errors errors(reader);
    const std::int64_t before = bytesReadByAll();
    reader->UpdateInformation();
    EXPECT_LT(bytesReadByAll() - before, std::int64_t(16) << 20);
    EXPECT_EQ(bytesIn(this->Scratch), 0U);
    EXPECT_EQ(errors.text(), "");
    EXPECT_TRUE(reader->GetOutputDataObject(0)->IsA("vtkUnstructuredGrid"));
    EXPECT_EQ(reader->GetPointDataArraySelection()->ArrayExists("Heat"),
      path.extension() == ".vtk" || path.extension() == ".vtu");
    std::filesystem::remove(path);
  }
}

/** Of a gigabyte, the blocks at its beginning. */
TEST_F(VtkLateConversion, OnlyTheBeginningIsReadBeforeDataAreRequested)
{
  const std::string vertex = "element vertex 40000000\nproperty float x\nproperty float y\n"
                             "property float z\nproperty float Heat\n";
  const std::string ply = "ply\nformat binary_little_endian 1.0\n" + vertex +
                          "element face 20000000\nproperty list uchar int vertex_indices\n"
                          "end_header\n";
  const std::string lines(8192, '\n');
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::string stl(84, '\0');
  constexpr std::uint32_t Facets = 20000000;
  std::memcpy(stl.data() + 80, &Facets, sizeof(Facets));
  constexpr std::uintmax_t Gigabyte = 84 + std::uintmax_t(50) * Facets;
  const std::pair<const char*, std::string> files[] = { { "huge.ply", ply },
    { "huge.off", "OFF\n30000000 60000000 0\n0 0 0\n" + lines }, { "huge.obj", triangle + lines },
    { "huge.stl", stl }, { "huge.sma", triangle + lines } };
  for (const auto& [name, start] : files)
  {
    SCOPED_TRACE(name);
    const std::filesystem::path path = this->Folder / name;
    writeBytes(path, start);
    std::filesystem::resize_file(path, Gigabyte);
    vtkNew<vtkStreamingMeshReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetScratchDirectory(this->Scratch.c_str());
    Errors errors(reader);
    const std::int64_t before = bytesReadByAll();
    reader->UpdateInformation();
    EXPECT_LT(bytesReadByAll() - before, std::int64_t(16) << 20);
    EXPECT_EQ(bytesIn(this->Scratch), 0U);
    EXPECT_EQ(errors.text(), "");
    EXPECT_TRUE(reader->GetOutputDataObject(0)->IsA("vtkPolyData"));
    EXPECT_EQ(
      reader->GetPointDataArraySelection()->ArrayExists("Heat"), path.extension() == ".ply");
    std::filesystem::remove(path);
  }
}

/** What is said of the mesh is known behind other filters before they deliver a piece. */
TEST_F(VtkLateConversion, PointsOfNoCellComeThroughFilters)
{
  const std::filesystem::path path = this->Folder / "isolated.off", out = this->Folder / "out.vsm";
  writeBytes(path, "OFF\n5 2 0\n0 0 0\n1 0 0\n9 9 9\n0 1 0\n1 1 0\n3 0 1 3\n3 1 4 3\n");
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputConnection(reader->GetOutputPort());
  PieceInput input(*elevation->GetOutputPort());
  ASSERT_TRUE(input.meshInfo());
  EXPECT_EQ(input.meshInfo()->vertices, 4);
  EXPECT_TRUE(input.isInMemory());
  EXPECT_FALSE(input.streamFingerprint().empty());
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(elevation->GetOutputPort());
  writer->SetFileName(out.c_str());
  EXPECT_EQ(writer->Write(), 1);
  EXPECT_EQ(VsmReader(out).isolatedVertices(), 1);
}

TEST_F(VtkLateConversion, ErrorsBehindTheBeginningAreSaidWithTheData)
{
  vtkNew<vtkStreamingMeshReader> reader;
  const std::filesystem::path path = this->Folder / "bad.off";
  writeBytes(path, "OFF\n5 2 0\n0 0 0\n1 0 0\n9 9 9\n0 1 0\n1 1 0\n3 0 1 3\n3 1 4 7\n");
  reader->SetFileName(path.c_str());
  Errors errors(reader);
  reader->UpdateInformation();
  EXPECT_EQ(errors.text(), "");
  EXPECT_STREQ(reader->GetError(), "");
  EXPECT_FALSE(updatePiece(reader, 0, 1));
  EXPECT_TRUE(errors.contain("bad.off")) << errors.text();
  EXPECT_NE(std::string(reader->GetError()).find("bad.off"), std::string::npos);
  errors.clear();
  EXPECT_FALSE(updatePiece(reader, 0, 1));
  EXPECT_FALSE(errors.contain("bad.off")) << errors.text();
  EXPECT_EQ(reader->GetFullNumberOfPoints(), -1);
  // One that is not valid at its beginning, at once.
  const std::filesystem::path worse = this->Folder / "worse.off";
  writeBytes(worse, "OFF\nfive 2 0\n");
  reader->SetFileName(worse.c_str());
  errors.clear();
  reader->UpdateInformation();
  EXPECT_TRUE(errors.contain("worse.off")) << errors.text();
  // Mended.
  writeBytes(path, "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n");
  reader->SetFileName(path.c_str());
  errors.clear();
  EXPECT_TRUE(updatePiece(reader, 0, 1)) << errors.text();
  EXPECT_EQ(reader->GetFullNumberOfPoints(), 4);
  EXPECT_STREQ(reader->GetError(), "");
}

/** A file of another type by the time that data are requested. */
TEST_F(VtkLateConversion, ATypeThatTurnsOutOtherwiseIsAnError)
{
  const std::filesystem::path path = this->Folder / "mesh.any";
  convert(this->Surface, this->Folder / "mesh.smb");
  convert(this->Solid, this->Folder / "mesh.svb");
  std::filesystem::copy_file(this->Folder / "mesh.smb", path);
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(path.c_str());
  Errors errors(reader);
  reader->UpdateInformation();
  EXPECT_TRUE(reader->GetOutputDataObject(0)->IsA("vtkPolyData")) << errors.text();
  // The pipeline has asked, and does not ask again before it requests data.
  auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(reader->GetExecutive());
  std::filesystem::copy_file(
    this->Folder / "mesh.svb", path, std::filesystem::copy_options::overwrite_existing);
  EXPECT_FALSE(executive->Update(0) && !isFailed(reader->GetOutputDataObject(0)));
  EXPECT_TRUE(errors.contain("mesh.any is a solid, unlike what it was")) << errors.text();
  errors.clear();
  reader->Modified();
  EXPECT_TRUE(updatePiece(reader, 0, 1)) << errors.text();
  EXPECT_TRUE(reader->GetOutputDataObject(0)->IsA("vtkUnstructuredGrid"));
}

} // namespace
} // namespace smg::testing
