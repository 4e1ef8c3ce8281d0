// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include "vtkContourFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkPassSelectedArrays.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPPolyDataReader.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLPolyDataReader.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

class VtkStreamingMeshWriter : public ::testing::Test
{
protected:
  void start(const IndexedTestMesh& mesh)
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Reader->SetMaximumPointsInMemory(10);
    this->Writer->SetInputConnection(this->Reader->GetOutputPort());
    this->Writer->SetNumberOfStreamedPieces(7);
  }

  int write(const std::string& name)
  {
    this->Writer->SetFileName((this->Folder / name).c_str());
    return this->Writer->Write();
  }

  void expectMesh(const std::string& name)
  {
    VsmReader reader(this->Folder / name);
    const StreamMesh copy = collect(*reader.source());
    EXPECT_EQ(copy.positions, this->Mesh.positions);
    EXPECT_EQ(copy.corners, this->Mesh.corners);
    ASSERT_EQ(copy.vertexColumns.size(), this->Mesh.vertexColumns.size());
    for (std::size_t i = 0; i < copy.vertexColumns.size(); ++i)
    {
      EXPECT_EQ(copy.vertexColumns[i].spec, this->Mesh.vertexColumns[i].spec);
      EXPECT_EQ(copy.vertexColumns[i].bytes, this->Mesh.vertexColumns[i].bytes);
    }
    ASSERT_EQ(copy.cellColumns.size(), this->Mesh.cellColumns.size());
    EXPECT_EQ(copy.cellColumns[0].bytes, this->Mesh.cellColumns[0].bytes);
  }

  /**
   * Expects the arrays within their elements, since some readers of VTK cannot read appended ones.
   */
  void expectInlineArrays(const std::string& folder)
  {
    for (const auto& entry : std::filesystem::directory_iterator(this->Folder / folder))
    {
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string text(std::istreambuf_iterator<char>(stream), {});
      EXPECT_NE(text.find("format=\"binary\""), std::string::npos) << entry.path();
      EXPECT_EQ(text.find("AppendedData"), std::string::npos) << entry.path();
    }
  }

  /** Reads an index of piece files back by pieces and streams it to a container again. */
  template <class IndexReader>
  void expectReadable(const std::string& index)
  {
    vtkNew<IndexReader> reader;
    reader->SetFileName((this->Folder / index).c_str());
    for (const int pieces : { 1, 2, 3, 7, 20 })
    {
      vtkNew<vtkStreamingMeshWriter> again;
      again->SetInputConnection(reader->GetOutputPort());
      again->SetNumberOfStreamedPieces(pieces);
      again->SetFileName((this->Folder / "again.vsm").c_str());
      ASSERT_TRUE(again->Write()) << pieces;
      this->expectMesh("again.vsm");
    }
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingMeshWriter> Writer;
};

TEST_F(VtkStreamingMeshWriter, ContainerOfASurface)
{
  this->start(torus(60, 30, 0.2));
  ASSERT_TRUE(this->write("out.vsm"));
  this->expectMesh("out.vsm");
  this->Writer->SetNumberOfStreamedPieces(0);
  ASSERT_TRUE(this->write("auto.vsm"));
  this->expectMesh("auto.vsm");
  EXPECT_EQ(this->Folder.entries(), 3);
}

TEST_F(VtkStreamingMeshWriter, ContainerOfAVolume)
{
  this->start(tetBox(9, 8, 7, 0.1));
  ASSERT_TRUE(this->write("out.vsm"));
  this->expectMesh("out.vsm");
}

TEST_F(VtkStreamingMeshWriter, UpdateWritesToo)
{
  this->start(torus(20, 10));
  this->Writer->SetFileName((this->Folder / "out.vsm").c_str());
  this->Writer->Update();
  this->expectMesh("out.vsm");
}

TEST_F(VtkStreamingMeshWriter, StreamingFormats)
{
  this->start(torus(60, 30, 0.2));
  for (const char* name : { "out.sma", "out.smb" })
  {
    ASSERT_TRUE(this->write(name));
    const auto back = openMesh(this->Folder / name);
    EXPECT_EQ(back->reader().info().vertices, this->Mesh.vertices());
    EXPECT_EQ(collect(*back->reader().source()).corners, this->Mesh.corners);
  }
  Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.svb"));
  EXPECT_TRUE(errors.contain("out.svb")) << errors.text();
  EXPECT_EQ(this->Folder.entries(), 3);
}

TEST_F(VtkStreamingMeshWriter, PlyHasTheMeshAndItsColumns)
{
  this->start(torus(60, 30, 0.2));
  ASSERT_TRUE(this->write("out.ply"));
  const ReadMesh back = importWhole(this->Folder / "out.ply");
  EXPECT_EQ(back.positions, this->Mesh.positions);
  EXPECT_EQ(back.corners, this->Mesh.corners);
  std::size_t properties = 0;
  for (const Column& column : this->Mesh.vertexColumns)
  {
    properties += static_cast<std::size_t>(column.spec.components);
  }
  EXPECT_EQ(back.vertexColumns.size(), properties);
  EXPECT_EQ(this->Folder.entries(), 2);
}

TEST_F(VtkStreamingMeshWriter, PlyHasNoTetrahedra)
{
  this->start(tetBox(9, 8, 7, 0.1));
  Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.ply"));
  EXPECT_TRUE(errors.contain("a .ply file holds no tetrahedra")) << errors.text();
  EXPECT_EQ(this->Folder.entries(), 1);
}

TEST_F(VtkStreamingMeshWriter, OneFileOfVtk)
{
  this->start(torus(60, 30, 0.2));
  ASSERT_TRUE(this->write("out.vtp"));
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((this->Folder / "out.vtp").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), this->Mesh.vertices());
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), this->Mesh.cells());
}

TEST_F(VtkStreamingMeshWriter, PieceFilesOfASurfaceAreLegalInput)
{
  this->start(torus(60, 30, 0.2));
  ASSERT_TRUE(this->write("out.pvtp"));
  EXPECT_EQ(this->Folder.entries(), 3);
  this->expectInlineArrays("out");
  this->expectReadable<vtkXMLPPolyDataReader>("out.pvtp");
}

TEST_F(VtkStreamingMeshWriter, PieceFilesOfAVolumeAreLegalInput)
{
  this->start(tetBox(9, 8, 7, 0.1));
  ASSERT_TRUE(this->write("out.pvtu"));
  this->expectInlineArrays("out");
  this->expectReadable<vtkXMLPUnstructuredGridReader>("out.pvtu");
}

TEST_F(VtkStreamingMeshWriter, FewerPieceFilesReplaceMore)
{
  this->start(torus(20, 10));
  ASSERT_TRUE(this->write("out.pvtp"));
  this->Writer->SetNumberOfStreamedPieces(3);
  ASSERT_TRUE(this->write("out.pvtp"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(this->Folder / "out"), {}), 3);
  this->expectReadable<vtkXMLPPolyDataReader>("out.pvtp");
}

TEST_F(VtkStreamingMeshWriter, MeshGivenDirectlyStaysWhole)
{
  this->start(torus(60, 30));
  this->Reader->SetMaximumPointsInMemory(1000000);
  this->Reader->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(this->Reader->GetOutputDataObject(0));
  this->Writer->SetInputData(mesh);
  Errors errors(this->Writer);
  for (const char* name : { "out.vsm", "out.sma", "out.ply", "out.pvtp" })
  {
    errors.clear();
    this->Writer->SetNumberOfStreamedPieces(4);
    EXPECT_FALSE(this->write(name));
    EXPECT_TRUE(errors.contain("same data for every piece")) << errors.text();
    EXPECT_EQ(this->Folder.entries(), 1);
    for (const int pieces : { 0, 1 })
    {
      this->Writer->SetNumberOfStreamedPieces(pieces);
      EXPECT_TRUE(this->write(name)) << errors.text();
      EXPECT_EQ(mesh->GetNumberOfPoints(), 1800);
      EXPECT_EQ(mesh->GetNumberOfCells(), 3600);
    }
    std::filesystem::remove(this->Folder / name);
    std::filesystem::remove_all(this->Folder / "out");
  }
}

/** An image of a wavy function, with heights in an array of a class. */
template <class Heights>
vtkSmartPointer<vtkImageData> waves()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(14, 13, 12);
  vtkNew<Heights> heights;
  heights->SetName("Height");
  heights->SetNumberOfComponents(2);
  heights->SetNumberOfTuples(image->GetNumberOfPoints());
  vtkNew<vtkFloatArray> values;
  values->SetName("Value");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* p = image->GetPoint(i);
    values->InsertNextValue(static_cast<float>(p[2] + std::sin(p[0]) - std::cos(p[1])));
    heights->SetTypedComponent(i, 0, p[2]);
    heights->SetTypedComponent(i, 1, -p[2]);
  }
  image->GetPointData()->SetScalars(values);
  image->GetPointData()->AddArray(heights);
  return image;
}

/** Expects `Height` to be z and -z at the points of the container. */
void expectHeights(const std::filesystem::path& container)
{
  VsmReader reader(container);
  const StreamMesh mesh = collect(*reader.source());
  const std::ptrdiff_t height =
    findColumn(reader.info().vertexColumns, { "Height", ScalarType::Float64, 2 });
  ASSERT_GE(height, 0);
  const std::span<const double> values = std::as_const(mesh.vertexColumns[height]).as<double>();
  for (std::size_t i = 0; i < values.size() / 2; ++i)
  {
    ASSERT_NEAR(values[2 * i], mesh.positions[3 * i + 2], 1e-5);
    ASSERT_EQ(values[2 * i + 1], -values[2 * i]);
  }
}

TEST_F(VtkStreamingMeshWriter, MeshesOfOtherSourcesGetAnOrder)
{
  using NotAsUsual = vtkSOADataArrayTemplate<double>;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(waves<NotAsUsual>());
  contour->SetValue(0, 5.0);
  // The flying edges of VTK 9.1 interpolate arrays of unusual storage wrongly.
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(waves<vtkDoubleArray>());
  edges->SetValue(0, 5.0);
  edges->InterpolateAttributesOn();
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(waves<NotAsUsual>());
  for (vtkAlgorithm* source : std::initializer_list<vtkAlgorithm*>{ contour, edges, tetrahedra })
  {
    source->Update();
    auto* whole = vtkDataSet::SafeDownCast(source->GetOutputDataObject(0));
    const vtkIdType points = whole->GetNumberOfPoints(), cells = whole->GetNumberOfCells();
    ASSERT_GT(cells, 100);
    this->Writer->SetInputConnection(source->GetOutputPort());
    Errors errors(this->Writer);
    for (const int pieces : { 0, 1, 5 })
    {
      this->Writer->SetNumberOfStreamedPieces(pieces);
      ASSERT_TRUE(this->write("out.vsm")) << errors.text();
      const VsmReader reader(this->Folder / "out.vsm");
      EXPECT_EQ(reader.info().vertices, points);
      EXPECT_EQ(reader.info().cells, cells);
      expectHeights(this->Folder / "out.vsm");
    }
    EXPECT_TRUE(errors.text().empty()) << errors.text();
    EXPECT_FALSE(this->write("out.pvtp"));
    EXPECT_TRUE(errors.contain("GlobalIds")) << errors.text();
    EXPECT_EQ(this->Folder.entries(), 1);
  }
}

TEST_F(VtkStreamingMeshWriter, AMissingFolderIsSaid)
{
  this->start(torus(60, 30));
  const Errors errors(this->Writer);
  EXPECT_FALSE(this->write("none/out.vsm"));
  EXPECT_TRUE(errors.contain("there is no folder")) << errors.text();
}

/** The preview of a mesh beyond the memory limit, without the ids of the reader. */
TEST_F(VtkStreamingMeshWriter, PreviewsWithoutIdsAreRefused)
{
  this->start(torus(60, 30));
  vtkNew<vtkPassSelectedArrays> nothing;
  nothing->SetInputConnection(this->Reader->GetOutputPort());
  this->Writer->SetInputConnection(nothing->GetOutputPort());
  const Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.vsm"));
  EXPECT_TRUE(errors.contain("MaximumPointsInMemory")) << errors.text();
  this->Reader->SetMaximumPointsInMemory(10000);
  ASSERT_TRUE(this->write("out.vsm")) << errors.text();
  EXPECT_EQ(VsmReader(this->Folder / "out.vsm").info().cells, 3600);
}

TEST_F(VtkStreamingMeshWriter, PreviewsAreRefused)
{
  this->start(torus(60, 30));
  this->Reader->Update();
  vtkNew<vtkPolyData> preview;
  preview->ShallowCopy(this->Reader->GetOutputDataObject(0));
  ASSERT_TRUE(preview->GetFieldData()->HasArray("Preview"));
  this->Writer->SetInputData(preview);
  this->Writer->SetNumberOfStreamedPieces(1);
  Errors errors(this->Writer);
  for (const char* name : { "out.vsm", "out.sma", "out.ply", "out.pvtp" })
  {
    errors.clear();
    EXPECT_FALSE(this->write(name));
    EXPECT_TRUE(errors.contain("is a preview")) << errors.text();
  }
  EXPECT_EQ(this->Folder.entries(), 1);
}

TEST_F(VtkStreamingMeshWriter, FailureEndsStreaming)
{
  this->start(torus(20, 10));
  vtkNew<vtkFaultyFilter> filter;
  filter->SetInputConnection(this->Reader->GetOutputPort());
  filter->FailAtPiece = 0;
  this->Writer->SetInputConnection(filter->GetOutputPort());
  this->Writer->SetNumberOfStreamedPieces(1);
  Errors silent(this->Writer);
  silent.watch(filter);
  for (const char* name : { "out.vsm", "out.sma", "out.ply", "out.pvtp" })
  {
    EXPECT_FALSE(this->write(name));
    ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
    EXPECT_TRUE(this->Reader->GetOutputDataObject(0)->GetFieldData()->HasArray("Preview"));
  }
}

TEST_F(VtkStreamingMeshWriter, EmptyPiecesHaveNoFiles)
{
  this->start(grid(2, 3));
  this->Writer->SetNumberOfStreamedPieces(50);
  ASSERT_TRUE(this->write("out.pvtp"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(this->Folder / "out"), {}), 4);
  this->expectReadable<vtkXMLPPolyDataReader>("out.pvtp");
}

TEST_F(VtkStreamingMeshWriter, ErrorsLeaveNothing)
{
  this->start(torus(20, 10));
  Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.abc"));
  EXPECT_TRUE(errors.contain("out.abc")) << errors.text();
  EXPECT_FALSE(this->write("no/such/folder/out.vsm"));
  EXPECT_FALSE(this->write("out.pvtu"));
  vtkNew<vtkFaultyFilter> filter;
  filter->SetInputConnection(this->Reader->GetOutputPort());
  filter->FailAtPiece = 4;
  Errors silent(filter);
  this->Writer->SetInputConnection(filter->GetOutputPort());
  for (const char* name : { "out.vsm", "out.sma", "out.ply", "out.pvtp" })
  {
    errors.clear();
    EXPECT_FALSE(this->write(name));
    EXPECT_TRUE(errors.contain("Piece 4 of 7")) << errors.text();
  }
  EXPECT_EQ(this->Folder.entries(), 1);
}

TEST_F(VtkStreamingMeshWriter, CodesTellWhatKindOfErrorItWas)
{
  this->start(torus(20, 10));
  const Errors errors(this->Writer);
  const std::vector<std::pair<std::string, unsigned long>> codes{
    { "out.abc", vtkErrorCode::UnrecognizedFileTypeError },
    { "no/such/folder/out.vsm", vtkErrorCode::CannotOpenFileError },
    { "out.pvtu", vtkErrorCode::UnknownError }, { "out.vsm", vtkErrorCode::NoError }
  };
  for (const auto& [name, code] : codes)
  {
    this->write(name);
    EXPECT_EQ(this->Writer->GetErrorCode(), code) << name;
  }
  this->Writer->SetFileName(nullptr);
  EXPECT_FALSE(this->Writer->Write());
  EXPECT_EQ(this->Writer->GetErrorCode(), vtkErrorCode::NoFileNameError);
}

TEST_F(VtkStreamingMeshWriter, WritesTheChosenArraysAlone)
{
  this->start(torus(20, 10));
  this->Writer->ChooseArraysToWriteOn();
  this->Writer->AddPointArray("Colours");
  const auto names = [](const std::vector<ColumnSpec>& columns)
  {
    std::set<std::string> found;
    for (const ColumnSpec& column : columns)
    {
      found.insert(column.name);
    }
    return found;
  };
  for (const char* name : { "out.vsm", "out.vtp", "out.pvtp" })
  {
    ASSERT_TRUE(this->write(name));
    convert(this->Folder / name, this->Folder / "again.vsm");
    VsmReader written(this->Folder / "again.vsm");
    EXPECT_EQ(written.info().cells, 400) << name;
    EXPECT_TRUE(names(written.info().vertexColumns).contains("Colours")) << name;
  }
  VsmReader written(this->Folder / "out.vsm");
  EXPECT_EQ(names(written.info().vertexColumns), std::set<std::string>{ "Colours" });
  EXPECT_EQ(names(written.info().cellColumns), std::set<std::string>{});
  this->Writer->RemoveAllPointArrays();
  this->Writer->AddCellArray("OriginalCellId");
  ASSERT_TRUE(this->write("out.vsm"));
  VsmReader other(this->Folder / "out.vsm");
  EXPECT_EQ(names(other.info().vertexColumns), std::set<std::string>{});
  EXPECT_EQ(names(other.info().cellColumns), std::set<std::string>{ "OriginalCellId" });
}

TEST_F(VtkStreamingMeshWriter, AbortLeavesNothing)
{
  this->start(torus(60, 30));
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* writer, unsigned long, void*, void* done)
    {
      if (*static_cast<double*>(done) > 0.4)
      {
        static_cast<vtkAlgorithm*>(writer)->SetAbortExecute(1);
      }
    });
  const unsigned long observer = this->Writer->AddObserver(vtkCommand::ProgressEvent, abort);
  for (const char* name : { "out.vsm", "out.smb", "out.ply", "out.pvtp" })
  {
    EXPECT_FALSE(this->write(name));
  }
  EXPECT_EQ(this->Folder.entries(), 1);
  this->Writer->RemoveObserver(observer);
  EXPECT_TRUE(this->write("out.vsm"));
}

} // namespace
} // namespace smg::testing
