// SPDX-License-Identifier: BSD-3-Clause
// Columns of thousands of numbers, of files and of blocks that others have written: what reads them
// stays within its memory limit, or says in one sentence how much it needs.
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/IO/RewrittenBlocks.h"
#include "Testing/Support/Sanitized.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include "vtkElevationFilter.h"

#include <fstream>
#include <sstream>
#include <string>

namespace smg::testing
{
namespace
{

constexpr std::int64_t MiB = std::int64_t(1) << 20;
constexpr int Wide = 1000;

/** The memory that is resident in addition to that at the beginning, at most so far. */
class ResidentPeak
{
public:
  ResidentPeak()
  {
    std::ofstream("/proc/self/clear_refs") << "5"; // the peak is that of now
    this->Begin = peak();
  }
  std::int64_t bytes() const { return peak() - this->Begin; }

private:
  static std::int64_t peak()
  {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
    {
      if (word == "VmHWM:")
      {
        std::int64_t kibibytes = 0;
        status >> kibibytes;
        return kibibytes << 10;
      }
    }
    return 0;
  }

  std::int64_t Begin = 0;
};

Column wideColumn(const char* name, std::int64_t tuples)
{
  Column column{ { name, ScalarType::Float32, Wide }, {} };
  column.resize(static_cast<std::size_t>(tuples));
  float value = 0.0F;
  for (float& each : column.as<float>())
  {
    each = value += 1.0F;
  }
  return column;
}

class VtkWideColumns : public ::testing::Test
{
protected:
  /** A file of VTK with 5 MB of vertices and 10 MB of cells. */
  std::filesystem::path wideFile()
  {
    StreamMesh mesh = toStream(torus(40, 30, 0.2));
    mesh.vertexColumns = { wideColumn("OfVertices", mesh.vertices()) };
    mesh.cellColumns = { wideColumn("OfCells", mesh.cells()) };
    writeMesh(this->Folder / "wide.vsm", mesh);
    convert(this->Folder / "wide.vsm", this->Folder / "wide.vtu");
    return this->Folder / "wide.vtu";
  }

  /** A .vsm file with as good as no bytes, each of whose blocks of cells has `components` doubles a
   * cell. */
  std::filesystem::path foreignFile(int components)
  {
    const std::filesystem::path narrow = this->Folder / "narrow.vsm",
                                path =
                                  this->Folder / ("foreign" + std::to_string(components) + ".vsm");
    writeMesh(narrow, toStream(grid(100, 90, 0.1)), 20000);
    std::vector<TableSpec> tables = BlockFileReader(narrow).tables();
    const ColumnSpec column{ "wide", ScalarType::Float64, components };
    tables[VsmFormat::Cells].columns.push_back(column);
    rewrite(narrow, path, VsmReader(narrow).header(), tables, {}, column);
    EXPECT_LT(std::filesystem::file_size(path), 4U << 20);
    return path;
  }

  static void writeMesh(
    const std::filesystem::path& path, const StreamMesh& mesh, std::int64_t block = 500)
  {
    MemorySource source(mesh, block);
    VsmWriter writer(path, source.info());
    for (MeshBlock next; source.next(next);)
    {
      writer.append(next);
    }
    writer.finish();
  }

  static vtkPointSet* output(vtkAlgorithm& algorithm)
  {
    return vtkPointSet::SafeDownCast(algorithm.GetOutputDataObject(0));
  }

  void expectWide(vtkAlgorithm& algorithm)
  {
    vtkPointSet* const mesh = output(algorithm);
    vtkDataArray* const points = mesh->GetPointData()->GetArray("OfVertices");
    vtkDataArray* const cells = mesh->GetCellData()->GetArray("OfCells");
    ASSERT_TRUE(points && cells);
    EXPECT_EQ(points->GetNumberOfComponents(), Wide);
    EXPECT_EQ(cells->GetNumberOfComponents(), Wide);
    vtkDataArray* const ids = mesh->GetCellData()->GetArray("OriginalCellId");
    ASSERT_TRUE(ids);
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); cell += 97)
    {
      EXPECT_EQ(cells->GetComponent(cell, 7),
        static_cast<double>(static_cast<float>(ids->GetTuple1(cell) * Wide + 8)));
    }
  }

  /** With the result, which is in memory as a whole, its copies in VTK, and what is not accounted.
   */
  static void expectLittle(const ResidentPeak& peak)
  {
    if (!Sanitized)
    {
      EXPECT_LT(peak.bytes(), 96 * MiB);
    }
  }

  TemporaryFolder Folder;
};

std::int64_t numberIn(const std::string& json, const std::string& key)
{
  const std::size_t at = json.find('"' + key + "\": ");
  return at == std::string::npos ? -1 : std::stoll(json.substr(at + key.size() + 4));
}

TEST_F(VtkWideColumns, AreConvertedWithinTheLimit)
{
  const std::filesystem::path path = this->wideFile();
  vtkNew<vtkStreamingMeshConverter> converter;
  converter->SetFileName(path.c_str());
  converter->SetOutputFileName((this->Folder / "converted.vsm").c_str());
  converter->SetScratchDirectory(this->Folder.path().c_str());
  converter->SetMemoryLimit(16);
  Errors errors(converter);
  const ResidentPeak peak;
  ASSERT_TRUE(updatePiece(converter, 0, 1)) << errors.text();
  expectLittle(peak);
  const std::int64_t accounted = numberIn(converter->GetReport(), "pool_bytes_peak");
  EXPECT_GT(accounted, 0);
  EXPECT_LE(accounted, 16 * MiB);
  this->expectWide(*converter);
}

TEST_F(VtkWideColumns, AreReadAndWrittenInPieces)
{
  const std::filesystem::path path = this->wideFile();
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetScratchDirectory(this->Folder.path().c_str());
  Errors errors(reader);
  const ResidentPeak peak;
  for (int piece = 0; piece < 4; ++piece)
  {
    ASSERT_TRUE(updatePiece(reader, piece, 4)) << errors.text();
    this->expectWide(*reader);
  }
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(elevation->GetOutputPort());
  writer->SetFileName((this->Folder / "written.vsm").c_str());
  writer->SetNumberOfStreamedPieces(4);
  EXPECT_EQ(writer->Write(), 1);
  expectLittle(peak);
  VsmReader(this->Folder / "written.vsm").requireBlocksWithin(16 * MiB);
}

TEST_F(VtkWideColumns, FiltersStayWithinTheLimit)
{
  const std::filesystem::path path = this->wideFile();
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkElevationFilter> elevation; // through which pieces come, not the file
  elevation->SetInputConnection(reader->GetOutputPort());
  for (vtkAlgorithm* const input :
    { static_cast<vtkAlgorithm*>(reader.Get()), static_cast<vtkAlgorithm*>(elevation.Get()) })
  {
    SCOPED_TRACE(input->GetClassName());
    vtkNew<vtkStreamingDistance> distance;
    distance->SetFrom(R"({"vertices": [7]})");
    vtkNew<vtkStreamingMeshSmoothing> smoothing;
    for (vtkStreamingSolver* const filter : { static_cast<vtkStreamingSolver*>(distance.Get()),
           static_cast<vtkStreamingSolver*>(smoothing.Get()) })
    {
      SCOPED_TRACE(filter->GetClassName());
      filter->SetInputConnection(input->GetOutputPort());
      filter->SetScratchDirectory(this->Folder.path().c_str());
      filter->SetMemoryLimit(16);
      Errors errors(filter);
      const ResidentPeak peak;
      for (int piece = 0; piece < 3; ++piece)
      {
        ASSERT_TRUE(updatePiece(filter, piece, 3)) << errors.text();
        this->expectWide(*filter);
      }
      EXPECT_LE(filter->GetPeakMemory(), 16 * MiB);
      expectLittle(peak);
    }
  }
}

/** Blocks that take more than the memory are refused by the first that would read them. */
TEST_F(VtkWideColumns, BlocksOfOthersThatAreTooLargeAreOneError)
{
  const std::filesystem::path large = this->foreignFile(1000);
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(large.c_str());
  Errors errors(reader);
  const ResidentPeak peak;
  EXPECT_FALSE(updatePiece(reader, 0, 4));
  EXPECT_TRUE(errors.contain("foreign1000.vsm: its columns are so wide")) << errors.text();
  expectLittle(peak);

  // The reader has 256 MiB, the filter less.
  const std::filesystem::path medium = this->foreignFile(60);
  reader->SetFileName(medium.c_str());
  errors.clear();
  vtkNew<vtkStreamingDistance> distance;
  distance->SetInputConnection(reader->GetOutputPort());
  distance->SetFrom(R"({"vertices": [7]})");
  distance->SetMemoryLimit(16);
  Errors ofFilter(distance);
  EXPECT_FALSE(updatePiece(distance, 0, 4));
  EXPECT_TRUE(ofFilter.contain("the memory limit is 16 MiB")) << ofFilter.text();
  EXPECT_EQ(errors.text(), "");
  distance->SetMemoryLimit(256);
  ofFilter.clear();
  EXPECT_TRUE(updatePiece(distance, 0, 4)) << ofFilter.text();
}

} // namespace
} // namespace smg::testing
