// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/ImportInChild.h"

#include "Solver/Core/Error.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace smg::testing
{
namespace
{

constexpr const char* TriangleVtp =
  "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points>"
  "<DataArray type=\"Float32\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
  "<DataArray type=\"Int32\" Name=\"connectivity\">2 0 1</DataArray>"
  "<DataArray type=\"Int32\" Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>";

using Path = std::filesystem::path;

void copyFile(const Path& from, const Path& to)
{
  std::filesystem::copy_file(from, to);
}

void complain(const Path& from, const Path&)
{
  throw Error(from.string() + ": is not to be read.");
}

void crash(const Path&, const Path&)
{
  std::fputs("this does not reach the user\n", stderr);
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
}

/** Asks for more than the workspace has and all that the process may have beside it. */
void failToAllocate(const Path&, const Path&)
{
  throw std::bad_alloc();
}

/** Asks for more than the process may have; by a call that a compiler may not leave out. */
void askTooMuch(const Path& from, const Path& to)
{
  ::operator delete(::operator new(std::size_t(4) << 30));
  copyFile(from, to);
}

void hang(const Path&, const Path&)
{
  std::this_thread::sleep_for(std::chrono::hours(1));
}

class ImportInChild : public ::testing::Test
{
protected:
  ImportInChild() { writeBytes(this->File, TriangleVtp); }

  ReadMesh import(const VtkRecoder& recode, VtkXmlKind kind = VtkXmlKind::Whole,
    const ProgressFunction& progress = {})
  {
    Workspace workspace(this->Folder.path(), Workspace::LeastMemory);
    RawMeshBuilder builder(workspace, CellChoice::Only);
    importInChild(recode, this->File, kind, builder, progress);
    return readRaw(builder.finish());
  }

  std::string errorOf(const VtkRecoder& recode)
  {
    return messageOf([&] { this->import(recode); });
  }

  TemporaryFolder Folder;
  Path File = Folder / "a.vtx";
};

} // namespace

TEST_F(ImportInChild, GivesTheMesh)
{
  const ReadMesh mesh = this->import(copyFile);
  EXPECT_EQ(mesh.vertices(), 3);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 2, 0, 1 }));
}

TEST_F(ImportInChild, GivesThePiecesOfAParallelFile)
{
  writeBytes(this->Folder / "piece.vtp", TriangleVtp);
  writeBytes(this->File, "<VTKFile type=\"PPolyData\"><PPolyData><Piece Source=\"piece.vtp\"/>"
                         "<Piece Source=\"piece.vtp\"/></PPolyData></VTKFile>");
  const ReadMesh mesh = this->import(copyFile, VtkXmlKind::InPieces);
  EXPECT_EQ(mesh.vertices(), 6);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 2, 0, 1, 5, 3, 4 }));
}

TEST_F(ImportInChild, FailuresAreErrors)
{
  EXPECT_EQ(this->errorOf(complain), this->File.string() + ": is not to be read.");
  const std::string crashed = this->errorOf(crash);
  EXPECT_EQ(crashed.find(this->File.string()), 0u) << crashed;
  EXPECT_NE(crashed.find("damaged"), std::string::npos) << crashed;
  EXPECT_NE(this->errorOf(failToAllocate).find("memory"), std::string::npos);
  // A sanitizer ends the process where the system would refuse.
  EXPECT_EQ(this->errorOf(askTooMuch).find(this->File.string()), 0u);
}

TEST_F(ImportInChild, CancelEndsAReaderThatHangs)
{
  EXPECT_THROW(this->import(hang, VtkXmlKind::Whole, [](double) { return false; }), Cancelled);
}

} // namespace smg::testing
