// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/VolumeImport.h"

#include <string>

namespace smg::testing
{
namespace
{

/** Grid points in fields of each kind, and exponents without a letter. */
const std::string Grids =
  "SOL 101\nCEND\nTITLE = A, MESH\nBEGIN BULK\n$ a comment\n"
  "GRID    10              0.0     0.0     0.0\n"
  "GRID,20,,1.0,0.0,0.0\n"
  "GRID*                 40                             0.0             0.0\n"
  "*                    1.0\n"
  "grid    30              0.0     1.0+0   0.0\n"
  "GRID    50      0       1.      1.0E0   10.-1\n";
const std::string Bulk = Grids + "CTETRA  1       7       10      20      30      40\n"
                                 "CTETRA,2,8,20,30,40,50\nCTRIA3,3,9,10,20,30,,0.5\n"
                                 "PSOLID  7       1\nSET1,5,10,30,THRU,50,99\n"
                                 "SET3    6       GRID    20\nENDDATA\nanything else\n";

class ImportNastran : public VolumeImport
{
protected:
  ReadMesh nastran(const std::string& text) { return this->read(NastranFormat, "a.bdf", text); }
};

} // namespace

TEST_F(ImportNastran, PropertiesAndSetsAreGroups)
{
  const ReadMesh mesh = this->nastran(Bulk);
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1 }));
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 3, 2, 1, 3, 2, 4 }));
  EXPECT_EQ(groupCounts(mesh), (GroupCounts{ { "cells 7", 1 }, { "cells 8", 1 }, { "facets 9", 1 },
                                 { "vertices 5", 4 }, { "vertices 6", 1 } }));
  EXPECT_EQ(elementColumn(mesh, "Reference").value(1), 8);
}

TEST_F(ImportNastran, SolidsWithContinuationLines)
{
  std::string text;
  int number = 0;
  for (const auto& point : FourSolidsPoints)
  {
    text += "GRID," + std::to_string(++number) + ",," + exact(point[0]) + ',' + exact(point[1]) +
            ',' + exact(point[2]) + '\n';
  }
  const auto corner = [](std::size_t solid, std::size_t k)
  {
    std::string field = std::to_string(FourSolids[solid][k] + 1);
    return field + std::string(8 - field.size(), ' ');
  };
  text += "CHEXA   1       1       ";
  for (std::size_t k = 0; k < 8; ++k)
  {
    text += (k == 6 ? "+a\n+a      " : "") + corner(0, k);
  }
  text += "\nCPYRAM  2       1       ";
  for (std::size_t k = 0; k < 5; ++k)
  {
    text += corner(1, k);
  }
  text += "\nCPENTA  3       1       ";
  for (std::size_t k = 0; k < 6; ++k)
  {
    text += corner(2, k);
  }
  text += "\n        \nCTETRA  4       1       ";
  for (std::size_t k = 0; k < 4; ++k)
  {
    text += corner(3, k);
  }
  const ReadMesh mesh = this->nastran(text + "\n");
  expectFourSolids(mesh);
  EXPECT_EQ(mesh.counts.higherOrderCells, 0);
  EXPECT_EQ(
    this->nastran(Grids + "CTETRA,1,1,10,20,30,40,50,50\n,50,50,50,50\n").counts.higherOrderCells,
    1);
}

TEST_F(ImportNastran, ErrorsNameTheLine)
{
  const auto expectRefused = [this](const std::string& text, const std::string& part)
  { expectError([&] { this->nastran(text); }, part); };
  expectRefused(Grids + "GRID,60,3,0.,0.,0.\n", "line 12: the grid point 60 has coordinates in");
  expectRefused(Grids + "GRID,60,,x,0.,0.\n", "line 12: 'x' stands where a coordinate");
  expectRefused(Grids + "GRID,50,,0.,0.,0.\n", "there are two grid points 50");
  expectRefused(Grids + "CTETRA,1,1,10,20,30\n", "line 12: the field 7 of CTETRA is empty");
  expectRefused(Grids + "INCLUDE 'other.bdf'\n", "line 12: another file is included");
  expectRefused(Grids + "CTETRA,1,1,10,20,30,41\n", "names a vertex that the file does not have");
  expectRefused(Grids, "no triangles and no tetrahedra");
}

TEST_F(ImportNastran, DamagedFilesAreRefusedOrValid)
{
  this->expectSafe(NastranFormat, "a.bdf", Bulk);
}

} // namespace smg::testing
