// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/ImportInChild.h"

#include "Solver/Core/Error.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <thread>

using namespace smg;
using namespace smg::testing;

namespace
{

/** A mesh that says something in each of its members. */
IndexedMesh fullMesh()
{
  IndexedMesh mesh;
  mesh.cellType = CellType::Tetrahedron;
  mesh.doublePositions = false;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  mesh.corners = { 0, 1, 2, 3 };
  mesh.originalCells = { 7 };
  mesh.vertexColumns.push_back({ { "a", ScalarType::Int16, 1 }, {} });
  mesh.vertexColumns[0].resize(4);
  mesh.vertexColumns[0].as<std::int16_t>()[3] = -5;
  mesh.cellColumns.push_back({ { "", ScalarType::Float64, 3 }, {} });
  mesh.cellColumns[0].resize(1);
  mesh.triangulatedPolygons = 11;
  mesh.droppedCells = 12;
  return mesh;
}

IndexedMesh importFull(const std::filesystem::path&, MeshFormat, const ImportOptions& options)
{
  Progress(options.progress).update(0.5);
  return fullMesh();
}

IndexedMesh complain(const std::filesystem::path& path, MeshFormat, const ImportOptions&)
{
  throw Error(path.string() + ": is not to be read.");
}

IndexedMesh crash(const std::filesystem::path&, MeshFormat, const ImportOptions&)
{
  std::fputs("this does not reach the user\n", stderr);
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
  return {};
}

IndexedMesh ask(const std::filesystem::path&, MeshFormat, const ImportOptions&)
{
  throw std::bad_alloc();
}

/** Asks for more than the budget and all that the process may have beside it. */
IndexedMesh askTooMuch(const std::filesystem::path&, MeshFormat, const ImportOptions& options)
{
  IndexedMesh mesh = fullMesh();
  mesh.originalCells.resize(
    static_cast<std::size_t>(options.budget.limit() + (std::int64_t(2) << 30)) / 8);
  return mesh;
}

IndexedMesh hang(const std::filesystem::path&, MeshFormat, const ImportOptions&)
{
  std::this_thread::sleep_for(std::chrono::hours(1));
  return {};
}

class ImportInChild : public ::testing::Test
{
protected:
  ImportInChild() { writeBytes(this->Path, "x"); }

  std::string errorOf(VtkImporter importer)
  {
    return messageOf([&] { importInChild(importer, this->Path, MeshFormat::VtkXml, {}); });
  }

  TemporaryFolder Folder;
  std::filesystem::path Path = Folder / "a.vtu";
};

} // namespace

TEST_F(ImportInChild, GivesTheWholeMesh)
{
  ImportOptions options;
  double done = 0.0;
  options.progress = [&done](double fraction)
  {
    done = fraction;
    return true;
  };
  const IndexedMesh mesh = importInChild(importFull, this->Path, MeshFormat::VtkXml, options);
  const IndexedMesh expected = fullMesh();
  EXPECT_EQ(done, 0.5);
  EXPECT_EQ(mesh.cellType, expected.cellType);
  EXPECT_EQ(mesh.doublePositions, expected.doublePositions);
  EXPECT_EQ(mesh.positions, expected.positions);
  EXPECT_EQ(mesh.corners, expected.corners);
  EXPECT_EQ(mesh.originalCells, expected.originalCells);
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, expected.vertexColumns[0].spec);
  EXPECT_EQ(mesh.vertexColumns[0].bytes, expected.vertexColumns[0].bytes);
  ASSERT_EQ(mesh.cellColumns.size(), 1u);
  EXPECT_EQ(mesh.cellColumns[0].spec, expected.cellColumns[0].spec);
  EXPECT_EQ(mesh.cellColumns[0].bytes, expected.cellColumns[0].bytes);
  EXPECT_EQ(mesh.triangulatedPolygons, 11);
  EXPECT_EQ(mesh.droppedCells, 12);
}

TEST_F(ImportInChild, FailuresAreErrors)
{
  EXPECT_EQ(this->errorOf(complain), this->Path.string() + ": is not to be read.");
  const std::string crashed = this->errorOf(crash);
  EXPECT_EQ(crashed.find(this->Path.string()), 0u) << crashed;
  EXPECT_NE(crashed.find("damaged"), std::string::npos) << crashed;
  EXPECT_NE(this->errorOf(ask).find("memory"), std::string::npos);
  ImportOptions options;
  options.budget = MemoryBudget(1 << 20);
  EXPECT_THROW(importInChild(askTooMuch, this->Path, MeshFormat::VtkXml, options), Error);
}

TEST_F(ImportInChild, CancelEndsAReaderThatHangs)
{
  ImportOptions options;
  options.progress = [](double) { return false; };
  EXPECT_THROW(importInChild(hang, this->Path, MeshFormat::VtkXml, options), Cancelled);
}
