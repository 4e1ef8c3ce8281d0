// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "IO/vtkPieceInput.h"
#include "IO/vtkStreamingMeshConverter.h"
#include "IO/vtkStreamingMeshKeys.h"
#include "IO/vtkStreamingMeshReader.h"
#include "IO/vtkStreamingMeshWriter.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/vtkPieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include "vtkDataArraySelection.h"
#include "vtkElevationFilter.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"

#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>

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
  const FormatUse written = FormatUse::Write;
  std::istringstream words(suffixList(written, cells, "or"));
  std::set<std::string> suffixes;
  for (std::string word; words >> word;)
  {
    word = word.substr(0, word.find(','));
    if (word.starts_with('.') && word != ".vsm" && suffixFor(FormatUse::Read, word = "mesh" + word))
    {
      suffixes.insert(word.substr(4));
    }
  }
  return suffixes;
}

/** Files of formats that tell the type of the cells at their beginning are not converted before
 * data are requested. */
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
    static const std::set<std::string> Late = { ".ply", ".off", ".obj", ".stl", ".sma", ".smb",
      ".sva", ".svb" };
    const bool isLate = Late.contains(path.extension().string());
    Errors errors(&reader);
    reader.SetFileName(path.c_str());
    reader.SetScratchDirectory(this->Scratch.c_str());
    reader.UpdateDataObject();
    const char* const type = isSolid ? "vtkUnstructuredGrid" : "vtkPolyData";
    EXPECT_TRUE(reader.GetOutputDataObject(0)->IsA(type));
    reader.UpdateInformation();
    if (isLate)
    {
      EXPECT_FALSE(this->isConverted());
      EXPECT_EQ(reader.GetFullNumberOfPoints(), -1);
    }
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
