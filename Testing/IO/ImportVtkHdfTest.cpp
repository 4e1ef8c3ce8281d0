// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/Hdf5Output.h"
#include "IO/Formats/VtkHdf/Hdf5/WriteVtkHdf.h"
#include "IO/Mesh/Columns.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/IO/HdfFile.h"
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/ColumnValues.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <hdf5.h>

#include <fstream>
#include <iterator>

namespace smg::testing
{
namespace
{

class ImportVtkHdf : public ImportFixture
{
protected:
  ReadMesh readHdf(const MeshPart& part = {}, const std::string& name = "a.vtkhdf")
  {
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    ImportOptions options;
    options.part = part;
    const Looked looked = this->lookAt(this->Folder / name, options);
    const RawMesh mesh = importMesh(this->Folder / name, workspace, options);
    expectLooked(looked, mesh, formatOfFile(this->Folder / name));
    return readRaw(mesh);
  }

  void expectRefused(const MeshPart& part, const std::string& sentence)
  {
    const std::string message = messageOf([&] { this->readHdf(part); });
    EXPECT_NE(message.find(sentence), std::string::npos) << message;
    EXPECT_NE(message.find("a.vtkhdf: "), std::string::npos) << message;
  }

  /** A square in two partitions, which share an edge. */
  void writeSquare(HdfFile& file, Integers tags = { 10, 20 })
  {
    file.integers("NumberOfPoints", { 3, 3 });
    file.reals("Points", 3, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 });
    file.group("PointData");
    file.integers("PointData/GlobalIds", { 0, 1, 2, 1, 3, 2 });
    file.reals("PointData/Height", 0, { 5, 6, 7, 6, 8, 7 });
    file.reals("PointData/Directions", 3, { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1 });
    file.normals("Directions");
    file.group("CellData");
    file.integers("CellData/Part", tags);
  }

  /** The same with its cells, as an unstructured grid. */
  void writeSquareGrid(HdfFile& file)
  {
    this->writeSquare(file);
    file.integers("NumberOfCells", { 1, 1 });
    file.integers("NumberOfConnectivityIds", { 3, 3 });
    file.integers("Connectivity", { 0, 1, 2, 0, 1, 2 });
    file.integers("Offsets", { 0, 3, 0, 3 });
    file.bytes("Types", { 5, 5 });
  }

  /** The same in the files other.hdf and a.vtkhdf; returns the latter, open to be changed. */
  hid_t writeTwoSquares()
  {
    for (const char* path : { "a.vtkhdf", "other.hdf" })
    {
      HdfFile file(this->Folder / path, "UnstructuredGrid");
      this->writeSquareGrid(file);
      file.finish();
    }
    return H5Fopen((this->Folder / "a.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  }

  void expectSquare(const ReadMesh& mesh)
  {
    EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 }));
    EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 1, 3, 2 }));
    const std::ptrdiff_t height =
      findColumn(mesh.vertexColumns, { "Height", ScalarType::Float32, 1 });
    ASSERT_GE(height, 0);
    EXPECT_EQ(valuesOf(mesh.vertexColumns[static_cast<std::size_t>(height)]),
      (std::vector<double>{ 5, 6, 7, 8 }));
    EXPECT_GE(findColumn(mesh.vertexColumns, { NormalsName, ScalarType::Float32, 3 }), 0);
    ASSERT_EQ(mesh.elementColumns.size(), 1u);
    EXPECT_EQ(valuesOf(mesh.elementColumns[0]), (std::vector<double>{ 10, 20 }));
  }
};

} // namespace

TEST_F(ImportVtkHdf, PartitionsOfAGridAreOneMesh)
{
  HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
  this->writeSquareGrid(file);
  file.group("FieldData");
  file.integers("FieldData/TimeValue", { 1 });
  file.integers("FieldData/mass", { 1, 2 });
  file.finish();
  const ReadMesh mesh = this->readHdf();
  this->expectSquare(mesh);
  EXPECT_EQ(
    mesh.counts.notes, std::vector<std::string>{
                         "Field data are left out, since a mesh has no place for them: 'mass'." });
}

TEST_F(ImportVtkHdf, PolygonalDataHasCellsOfFourKinds)
{
  HdfFile file(this->Folder / "a.vtkhdf", "PolyData");
  this->writeSquare(file);
  file.cells("Vertices", { 0, 0 }, { 0, 0 }, {}, { 0, 0 });
  file.cells("Lines", { 0, 0 }, { 0, 0 }, {}, { 0, 0 });
  file.cells("Polygons", { 1, 0 }, { 3, 0 }, { 0, 1, 2 }, { 0, 3, 0 });
  file.cells("Strips", { 0, 1 }, { 0, 3 }, { 0, 1, 2 }, { 0, 0, 3 });
  file.finish();
  this->expectSquare(this->readHdf());
}

TEST_F(ImportVtkHdf, OfSeveralTimeStepsOneIsRead)
{
  HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
  file.integers("NumberOfPoints", { 3, 3 });
  file.reals("Points", 3, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 });
  file.integers("NumberOfCells", { 1, 1 });
  file.integers("NumberOfConnectivityIds", { 3, 3 });
  file.integers("Connectivity", { 0, 1, 2, 2, 1, 0 });
  file.integers("Offsets", { 0, 3, 0, 3 });
  file.bytes("Types", { 5, 5 });
  file.group("Steps");
  file.out().addIntegers("/VTKHDF/Steps", "NSteps", std::vector<std::int64_t>{ 2 });
  file.integers("Steps/PartOffsets", { 1, 0 });
  file.integers("Steps/NumberOfParts", { 1, 1 });
  file.integers("Steps/PointOffsets", { 3, 0 });
  file.integers("Steps/CellOffsets", { 1, 0 });
  file.integers("Steps/ConnectivityIdOffsets", { 3, 0 });
  file.finish();
  const ReadMesh first = this->readHdf();
  EXPECT_EQ(first.positions, (std::vector<double>{ 1, 0, 0, 1, 1, 0, 0, 1, 0 }));
  EXPECT_EQ(first.corners, (Numbers{ 2, 1, 0 }));
  EXPECT_EQ(first.counts.timeSteps, 2);
  EXPECT_EQ(first.counts.partitions, 1);
  EXPECT_EQ(first.counts.notes,
    std::vector<std::string>{ "The file has 2 time steps, of which the first is read." });
  const ReadMesh second = this->readHdf({ 1, {} });
  EXPECT_EQ(second.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  EXPECT_EQ(second.corners, (Numbers{ 0, 1, 2 }));
  EXPECT_EQ(second.counts.notes,
    std::vector<std::string>{
      "The file has 2 time steps, of which number 1, counted from 0, is read." });
  this->expectRefused({ 2, {} }, "there is no time step 2: the file has 2,");
  this->expectRefused({ -1, {} }, "there is no time step -1");
  this->expectRefused({ 1, 1 }, "there is no partition 1: there are 1,");
}

TEST_F(ImportVtkHdf, TimeStepsOfPolygonalDataHaveOffsetsOfFourKinds)
{
  HdfFile file(this->Folder / "a.vtkhdf", "PolyData");
  file.integers("NumberOfPoints", { 3, 4 });
  file.reals("Points", 3, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 1, 0, 2, 0, 1, 2, 1, 1, 2 });
  file.group("CellData");
  file.integers("CellData/Tag", { 5, 6, 7 });
  file.cells("Vertices", { 0, 0 }, { 0, 0 }, {}, { 0, 0 });
  file.cells("Lines", { 0, 0 }, { 0, 0 }, {}, { 0, 0 });
  file.cells("Polygons", { 1, 1 }, { 3, 3 }, { 0, 1, 2, 1, 3, 2 }, { 0, 3, 0, 3 });
  file.cells("Strips", { 0, 1 }, { 0, 3 }, { 0, 1, 2 }, { 0, 0, 3 });
  file.group("Steps");
  file.out().addIntegers("/VTKHDF/Steps", "NSteps", std::vector<std::int64_t>{ 2 });
  file.integers("Steps/PartOffsets", { 0, 1 });
  file.integers("Steps/PointOffsets", { 0, 3 });
  file.integers("Steps/CellOffsets", 4, { 0, 0, 0, 0, 0, 0, 1, 0 });
  file.integers("Steps/ConnectivityIdOffsets", 4, { 0, 0, 0, 0, 0, 0, 3, 0 });
  file.group("Steps/CellDataOffsets");
  file.integers("Steps/CellDataOffsets/Tag", { 0, 1 });
  file.finish();
  const ReadMesh mesh = this->readHdf({ 1, {} });
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 2, 1, 0, 2, 0, 1, 2, 1, 1, 2 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 1, 3, 2, 0, 1, 2 }));
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(valuesOf(mesh.elementColumns[0]), (std::vector<double>{ 6, 7 }));
}

TEST_F(ImportVtkHdf, AMissingFilterIsNamed)
{
  {
    HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
    this->writeSquareGrid(file);
    file.finish();
  }
  // A filter that exists while the file is written.
  const H5Z_class2_t filter{ H5Z_CLASS_T_VERS, 300, 1, 1, "shrink", nullptr, nullptr,
    [](unsigned, std::size_t, const unsigned[], std::size_t bytes, std::size_t*, void**)
    { return bytes; } };
  ASSERT_GE(H5Zregister(&filter), 0);
  const hid_t out = H5Fopen((this->Folder / "a.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t size = 6;
  H5Pset_chunk(properties, 1, &size);
  H5Pset_filter(properties, filter.id, H5Z_FLAG_MANDATORY, 0, nullptr);
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t set = H5Dcreate2(
    out, "/VTKHDF/PointData/Shrunk", H5T_NATIVE_FLOAT, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  const float values[6] = { 1, 2, 3, 4, 5, 6 };
  EXPECT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(properties);
  H5Fclose(out);
  ASSERT_GE(H5Zunregister(filter.id), 0);
  this->expectRefused(
    {}, "it is compressed by 'shrink' (filter 300 of HDF5), which the HDF5 library");
}

TEST_F(ImportVtkHdf, OnePartitionIsReadWithoutTheCellsOfOthers)
{
  HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
  this->writeSquare(file, { 10, 10, 20 });
  // The second partition has the first one's cell, too.
  file.bytes("CellData/vtkGhostType", { 0, 1, 0 });
  file.integers("NumberOfCells", { 1, 2 });
  file.integers("NumberOfConnectivityIds", { 3, 6 });
  file.integers("Connectivity", { 0, 1, 2, 2, 1, 0, 0, 1, 2 });
  file.integers("Offsets", { 0, 3, 0, 3, 6 });
  file.bytes("Types", { 5, 5, 5 });
  file.finish();
  const ReadMesh mesh = this->readHdf({ 0, 1 });
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 1, 0, 0, 1, 1, 0, 0, 1, 0 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 }));
  const std::ptrdiff_t height =
    findColumn(mesh.vertexColumns, { "Height", ScalarType::Float32, 1 });
  ASSERT_GE(height, 0);
  EXPECT_EQ(valuesOf(mesh.vertexColumns[static_cast<std::size_t>(height)]),
    (std::vector<double>{ 6, 8, 7 }));
  EXPECT_EQ(mesh.counts.partitions, 2);
  EXPECT_EQ(mesh.counts.notes,
    std::vector<std::string>{
      "The file has 2 partitions, of which number 1, counted from 0, is read." });
  EXPECT_EQ(this->readHdf({ 0, 0 }).corners, (Numbers{ 0, 1, 2 }));
  this->expectRefused({ 0, 2 }, "there is no partition 2: there are 2, counted from 0");
  this->expectRefused({ 1, {} }, "the file has no time steps");
}

TEST_F(ImportVtkHdf, OtherFormatsHaveNoParts)
{
  writeBytes(this->Folder / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  const auto expectRefused = [&](const MeshPart& part, const std::string& sentence)
  {
    ImportOptions options;
    options.part = part;
    smg::testing::expectError(
      [&] { importMesh(this->Folder / "a.off", workspace, options); }, sentence);
  };
  expectRefused({ 1, {} }, "a.off: the file has no time steps");
  expectRefused({ 0, 0 }, "a.off: the file has no partitions");
}

TEST_F(ImportVtkHdf, AMeshThatDoesNotChangeHasAllItsPartitionsInEachTimeStep)
{
  HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
  this->writeSquareGrid(file);
  file.group("Steps");
  file.out().addIntegers("/VTKHDF/Steps", "NSteps", std::vector<std::int64_t>{ 2 });
  file.integers("Steps/PartOffsets", { 0, 0 });
  file.finish();
  this->expectSquare(this->readHdf());
  this->expectSquare(this->readHdf({ 1, {} }));
}

TEST_F(ImportVtkHdf, AttributesThatAreListsAreNoTexts)
{
  HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
  file.integers("NumberOfPoints", { 3 });
  file.group("PointData");
  file.out().addIntegers("/VTKHDF/PointData", "Normals", std::vector<std::int64_t>(3000, 65));
  file.finish();
  EXPECT_NE(messageOf([this] { this->readHdf(); }).find("is missing"), std::string::npos);
}

TEST_F(ImportVtkHdf, ABlockOfTheUsersMayComeFirst)
{
  HdfFile file(this->Folder / "plain.vtkhdf", "UnstructuredGrid");
  this->writeSquareGrid(file);
  file.finish();
  std::ifstream plain(this->Folder / "plain.vtkhdf", std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(plain), {} };
  for (const std::size_t block : { 512, 2048 })
  {
    writeBytes(this->Folder / "a", std::string(block, ' ') + bytes);
    this->expectSquare(this->readHdf({}, "a"));
  }
}

// A mesh from an untrusted source must not make a program read files anywhere.
TEST_F(ImportVtkHdf, LinksAreRefused)
{
  for (const std::string object : { "/VTKHDF/Points", "/VTKHDF/PointData/Height", "/VTKHDF" })
  {
    for (const bool external : { false, true })
    {
      const hid_t file = this->writeTwoSquares();
      ASSERT_GE(H5Lmove(file, object.c_str(), file, "/hidden", H5P_DEFAULT, H5P_DEFAULT), 0);
      const herr_t made =
        external ? H5Lcreate_external(
                     "other.hdf", object.c_str(), file, object.c_str(), H5P_DEFAULT, H5P_DEFAULT)
                 : H5Lcreate_soft("/hidden", file, object.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      H5Fclose(file);
      ASSERT_GE(made, 0);
      this->expectRefused({}, "'" + object + "' is a link");
    }
  }
}

TEST_F(ImportVtkHdf, MoreNamesThanAreKeptAreRefused)
{
  const auto refused = [this](int links, std::size_t length, const std::string& sentence)
  {
    const hid_t file = this->writeTwoSquares();
    for (int k = 0; k < links; ++k)
    {
      const std::string name = "/VTKHDF/CellData/" + std::string(length, 'n') + std::to_string(k);
      H5Lcreate_soft("/none", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
    H5Fclose(file);
    this->expectRefused({}, sentence);
  };
  refused(4096, 1, "the group '/VTKHDF/CellData' has 4097 members, but at most 4096 arrays are");
  refused(1, 2000, "a name in the group '/VTKHDF/CellData' has 2001 bytes, but at most 1024 are");
}

// ParaView's parallel writer puts the numbers of each process into a file beside the one that is
// named, and virtual datasets into that.
TEST_F(ImportVtkHdf, VirtualDatasetsAreReadBesideTheFileOnly)
{
  const std::string points = "/VTKHDF/Points";
  struct Case
  {
    std::string source, dataset, refused;
  };
  const std::string outside = (this->Folder / "other.hdf").string();
  for (const Case& tried : { Case{ "other.hdf", points, "" }, Case{ ".", "/hidden", "" },
         Case{ outside, points, "'/VTKHDF/Points' lies in '" + outside + "'" },
         Case{ "../other.hdf", points, "'/VTKHDF/Points' lies in '../other.hdf'" },
         Case{ "none.hdf", points, "'/VTKHDF/Points' lies in 'none.hdf'" },
         Case{ ".", "/raw", "'/raw' has its numbers elsewhere" } })
  {
    const hid_t file = this->writeTwoSquares();
    ASSERT_GE(H5Lmove(file, points.c_str(), file, "/hidden", H5P_DEFAULT, H5P_DEFAULT), 0);
    const hid_t old = H5Dopen2(file, "/hidden", H5P_DEFAULT);
    const hid_t type = H5Dget_type(old), space = H5Dget_space(old);
    const hid_t raw = H5Pcreate(H5P_DATASET_CREATE);
    ASSERT_GE(H5Pset_external(raw, "/etc/hostname", 0, H5F_UNLIMITED), 0);
    H5Dclose(H5Dcreate2(file, "/raw", type, space, H5P_DEFAULT, raw, H5P_DEFAULT));
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    ASSERT_GE(H5Pset_virtual(list, space, tried.source.c_str(), tried.dataset.c_str(), space), 0);
    H5Dclose(H5Dcreate2(file, points.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Pclose(raw);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(old);
    H5Fclose(file);
    if (tried.refused.empty())
    {
      this->expectSquare(this->readHdf());
    }
    else
    {
      this->expectRefused({}, tried.refused);
    }
  }
}

TEST_F(ImportVtkHdf, WhatIsWrongIsSaid)
{
  const auto write = [this](Integers points, Integers ids, const char* type = "UnstructuredGrid")
  {
    HdfFile file(this->Folder / "a.vtkhdf", type);
    file.integers("NumberOfPoints", points);
    file.reals("Points", 3, { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
    file.integers("NumberOfCells", { 1 });
    file.integers("NumberOfConnectivityIds", ids);
    file.integers("Connectivity", { 0, 1, 2 });
    file.integers("Offsets", { 0, 3 });
    file.bytes("Types", { 5 });
    file.finish();
  };
  const auto expectRefused = [this](const std::string& part)
  {
    const std::string message = messageOf([this] { this->readHdf(); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("a.vtkhdf"), std::string::npos) << message;
  };
  write({ 3 }, { 3 });
  EXPECT_EQ(this->readHdf().corners, (Numbers{ 0, 1, 2 }));
  write({ 4 }, { 3 });
  expectRefused("/VTKHDF/Points' has 3 rows, 4 are needed");
  write({ 2 }, { 3 });
  expectRefused("the corner 2 is not a vertex");
  write({ 3 }, { 4 });
  expectRefused("Connectivity' has 3 rows");
  write({ -3 }, { 3 });
  expectRefused("cannot be right");
  write({ 3 }, {});
  expectRefused("NumberOfConnectivityIds' should have 1 numbers");
  write({ 3 }, { 3 }, "ImageData");
  expectRefused("'ImageData'");
  writeBytes(this->Folder / "a.vtkhdf", "\x89HDF\r\n\x1a\nand nothing else");
  expectRefused("truncated or damaged");
}

namespace
{

/** Converts, writes in partitions of `cells` cells, and reads again. */
void expectRoundTrip(const TemporaryFolder& folder, const StreamMesh& mesh, std::int64_t cells)
{
  const std::filesystem::path vsm = folder / "mesh.vsm", hdf = folder / "out.vtkhdf";
  write(vsm, mesh);
  EXPECT_TRUE(writeVtkHdf(vsm, hdf, {}, cells).empty());
  ConversionOptions keep;
  keep.order = StreamOrder::Keep;
  convert(hdf, folder / "back.vsm", keep);
  const StreamMesh expected = collect(*VsmReader(vsm).source());
  const VsmReader reader(folder / "back.vsm");
  const StreamMesh back = collect(*reader.source());
  EXPECT_EQ(back.positions, expected.positions);
  EXPECT_EQ(back.corners, expected.corners);
}

} // namespace

TEST_F(ImportVtkHdf, WrittenFilesComeBack)
{
  for (const std::int64_t cells : { std::int64_t(7), std::int64_t(100), VtkHdfPartitionCells })
  {
    expectRoundTrip(this->Folder, toStream(torus(20, 10)), cells);
    expectRoundTrip(this->Folder, toStream(tetBox(3, 4, 5)), cells);
  }
}

TEST_F(ImportVtkHdf, ColumnsTravel)
{
  HdfFile file(this->Folder / "a.vtkhdf", "UnstructuredGrid");
  this->writeSquareGrid(file);
  file.finish();
  convert(this->Folder / "a.vtkhdf", this->Folder / "b.vtkhdf");
  convert(this->Folder / "b.vtkhdf", this->Folder / "c.vsm");
  const VsmReader reader(this->Folder / "c.vsm");
  EXPECT_GE(findColumn(reader.info().vertexColumns, { "Height", ScalarType::Float32, 1 }), 0);
  EXPECT_GE(findColumn(reader.info().vertexColumns, { NormalsName, ScalarType::Float32, 3 }), 0);
  EXPECT_GE(findColumn(reader.info().cellColumns, { "Part", ScalarType::Int64, 1 }), 0);
}

} // namespace smg::testing
