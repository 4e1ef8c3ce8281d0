// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConversionEstimate.h"
#include "Testing/IO/GmshWriter.h"
#include "Testing/IO/HdfFile.h"
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/FormatSuffixes.h"
#include "Testing/Support/TestFolders.h"
#include "smg/Convert.h"

#include <sstream>

namespace smg::testing
{
namespace
{

class LookAtMesh : public ImportFixture
{
protected:
  CellType typeOf(const std::string& name, std::string_view bytes,
    CellChoice cells = CellChoice::Only, const MeshPart& part = {})
  {
    writeBytes(this->Folder / name, bytes);
    ImportOptions options;
    options.cells = cells;
    options.part = part;
    const Looked looked = this->lookAt(this->Folder / name, options);
    EXPECT_EQ(looked.error, "") << name;
    return looked.mesh.cellType;
  }
};

const std::string MeditHead = "MeshVersionFormatted 2\nDimension 3\n";
const std::string MeditVertices = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string OneTriangle = "Triangles\n1\n1 2 3 0\n",
                  OneTetrahedron = "Tetrahedra\n1\n1 2 3 4 0\n";

} // namespace

/** Every suffix that a mesh is written with, by the cells. */
TEST_F(LookAtMesh, TellsWhatTheConversionMakesOfEveryFormat)
{
  writeBytes(this->Folder / "surface.off", meshText(torus(9, 8, 0.2)));
  writeBytes(this->Folder / "solid.mesh", meshText(tetBox(3, 4, 3, 0.1)));
  int looked = 0;
  for (const CellType cells : { CellType::Triangle, CellType::Tetrahedron })
  {
    const auto isIndexed = [cells](auto& format, auto& suffix)
    { return format.bytes && format.kind == MeshFileKind::Indexed && suffix.holds(cells); };
    const char* const source = cells == CellType::Triangle ? "surface.off" : "solid.mesh";
    for (const std::string& suffix : suffixesWhere(isIndexed))
    {
      const std::filesystem::path path = this->Folder / ("copy" + suffix);
      SCOPED_TRACE(path.string());
      convert(this->Folder / source, path);
      const std::optional<StreamInfo> stated = statedMesh(path);
      ASSERT_TRUE(stated);
      EXPECT_EQ(stated->cellType, cells);
      convert(path, this->Folder / "mesh.vsm");
      const StreamInfo mesh = VsmReader(this->Folder / "mesh.vsm").info();
      EXPECT_EQ(mesh.cellType, cells);
      for (const ColumnSpec& column : stated->vertexColumns)
      {
        EXPECT_TRUE(std::ranges::count(mesh.vertexColumns, column.name, &ColumnSpec::name))
          << column.name;
      }
      ++looked;
    }
  }
  EXPECT_GT(looked, 18);
}

/** A tetrahedron decides, wherever it comes. */
TEST_F(LookAtMesh, TheChoiceOfCellsDecides)
{
  const std::string both = MeditHead + MeditVertices + OneTriangle + OneTetrahedron + "End\n";
  EXPECT_EQ(this->typeOf("a.mesh", both), CellType::Tetrahedron);
  EXPECT_EQ(this->typeOf("a.mesh", both, CellChoice::Tetrahedra), CellType::Tetrahedron);
  EXPECT_EQ(this->typeOf("a.mesh", both, CellChoice::Triangles), CellType::Triangle);
  EXPECT_EQ(this->readFile(this->Folder / "a.mesh").cellType, CellType::Tetrahedron);
}

/** Elements that are not cells, sections without any, and vertices that come last. */
TEST_F(LookAtMesh, WhatIsNoCellIsPassedBy)
{
  EXPECT_EQ(this->typeOf("a.mesh", MeditHead + "Triangles\n0\nEdges\n1\n1 2 0\n" + OneTetrahedron +
                                     MeditVertices + "End\n"),
    CellType::Tetrahedron);
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
  EXPECT_EQ(this->typeOf("a.msh",
              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + nodes +
                "$Elements\n3\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 4 2 0 1 1 2 3 4\n$EndElements\n"),
    CellType::Tetrahedron);
  const std::string vtk = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET ";
  const std::string points = "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n";
  EXPECT_EQ(this->typeOf("a.vtk", vtk + "UNSTRUCTURED_GRID\n" + points +
                                    "CELLS 3 10\n1 0\n2 0 1\n4 0 1 2 3\nCELL_TYPES 3\n1\n3\n10\n"),
    CellType::Tetrahedron);
  EXPECT_EQ(this->typeOf(
              "b.vtk", vtk + "POLYDATA\n" + points + "LINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 2\n"),
    CellType::Triangle);
}

TEST_F(LookAtMesh, NodesOfEveryVariantOfGmshAreSkipped)
{
  for (const GmshVariant& variant : GmshVariants)
  {
    for (const int type : { 2, 4 })
    {
      GmshWriter writer(variant);
      writer.nodes({ 7, 3, 9, 12 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
      writer.elements(
        { { 1, { 7, 3 } }, { type, type == 2 ? Numbers{ 7, 3, 9 } : Numbers{ 7, 3, 9, 12 } } });
      EXPECT_EQ(this->typeOf("a.msh", writer.bytes()),
        type == 2 ? CellType::Triangle : CellType::Tetrahedron)
        << variant.version << variant.binary << variant.swapped;
      this->readFile(this->Folder / "a.msh");
    }
  }
}

/** The time steps of a file may have cells of different types. */
TEST_F(LookAtMesh, TellsOfTheTimeStep)
{
  const std::filesystem::path path = this->Folder / "steps.vtkhdf";
  {
    HdfFile file(path, "UnstructuredGrid");
    file.reals("Points", 3, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 });
    file.integers("NumberOfPoints", { 4, 4 });
    file.integers("NumberOfCells", { 1, 1 });
    file.integers("NumberOfConnectivityIds", { 3, 4 });
    file.integers("Connectivity", { 0, 1, 2, 0, 1, 2, 3 });
    file.integers("Offsets", { 0, 3, 0, 4 });
    file.bytes("Types", { 5, 10 });
    file.group("Steps");
    file.out().addIntegers("/VTKHDF/Steps", "NSteps", std::vector<std::int64_t>{ 2 });
    file.integers("Steps/PartOffsets", { 0, 1 });
    file.integers("Steps/PointOffsets", { 0, 0 });
    file.integers("Steps/CellOffsets", { 0, 1 });
    file.integers("Steps/ConnectivityIdOffsets", { 0, 3 });
    file.finish();
  }
  ConversionOptions options;
  EXPECT_EQ(statedMesh(path, options)->cellType, CellType::Triangle);
  options.timeStep = 1;
  EXPECT_EQ(statedMesh(path, options)->cellType, CellType::Tetrahedron);
}

/** A long text is skimmed, and that can be cancelled. */
TEST_F(LookAtMesh, CanBeCancelled)
{
  std::ostringstream vertices;
  constexpr int Count = 200000;
  for (int i = 0; i < Count; ++i)
  {
    vertices << i << " 0.5 " << i % 7 << " 0\n";
  }
  const std::string text = MeditHead + "Vertices\n" + std::to_string(Count) + '\n' +
                           vertices.str() + OneTetrahedron + "End\n";
  EXPECT_EQ(this->typeOf("a.mesh", text), CellType::Tetrahedron);
  ConversionOptions options;
  int polls = 0;
  options.progress = [&polls](double) { return ++polls < 3; };
  EXPECT_THROW(statedMesh(this->Folder / "a.mesh", options), Cancelled);
  options.progress = nullptr;
  options.scratch = this->Folder.path();
  statedMesh(this->Folder / "a.mesh", options);
  EXPECT_EQ(this->Folder.entries(), 1);
}

/** Real meshes, which the archive has. */
TEST_F(LookAtMesh, TellsTheTypeOfRealMeshes)
{
  if (archiveFolder().empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  for (const char* name : { "armadillo_tet.msh", "bunny_tet.mesh", "head_tet336k.vtk",
         "raptor_tet.vtu", "brain168k.vtk" })
  {
    const std::filesystem::path path = archiveFolder() / name;
    ASSERT_TRUE(std::filesystem::exists(path)) << name;
    int read = 0;
    for (const CellChoice cells :
      { CellChoice::Only, CellChoice::Triangles, CellChoice::Tetrahedra })
    {
      ImportOptions options;
      options.cells = cells;
      const Looked looked = this->lookAt(path, options);
      Workspace workspace(this->Folder.path(), Workspace::MinMemory);
      std::optional<RawMesh> mesh;
      if (messageOf([&] { mesh = importMesh(path, workspace, options); }).empty())
      {
        expectLooked(looked, *mesh, formatOfFile(path));
        ++read;
      }
    }
    EXPECT_GE(read, 1) << name;
  }
}

} // namespace smg::testing
