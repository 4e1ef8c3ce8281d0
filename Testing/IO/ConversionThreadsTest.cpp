// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Convert.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace smg::testing
{
namespace
{

class ConversionThreads : public ::testing::Test
{
protected:
  std::filesystem::path write(const IndexedTestMesh& mesh)
  {
    const bool surface = mesh.cellType == CellType::Triangle;
    const std::filesystem::path path = this->Folder / (surface ? "mesh.off" : "mesh.mesh");
    writeBytes(path, meshText(mesh));
    return path;
  }

  /** The bytes of the .vsm file. */
  std::string converted(const std::filesystem::path& in, ConversionOptions options)
  {
    const std::filesystem::path out = this->Folder / "out.vsm";
    options.scratch = this->Folder.path();
    this->Report = convert(in, out, options);
    std::ifstream file(out, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  TemporaryFolder Folder;
  ConversionReport Report;
};

TEST_F(ConversionThreads, GiveTheSameBytes)
{
  for (const IndexedTestMesh& mesh :
    { shuffled(torus(150, 80, 0.1)), shuffled(tetBox(13, 12, 11, 0.1)) })
  {
    const std::filesystem::path in = this->write(mesh);
    for (const StreamOrder order : { StreamOrder::BreadthFirst, StreamOrder::Keep })
    {
      ConversionOptions options;
      options.order = order;
      options.memoryLimit = std::int64_t(64) << 20;
      options.threads = 1;
      const std::string expected = this->converted(in, options);
      const ConversionReport report = this->Report;
      for (const int threads : { 2, 3, 8, 16 })
      {
        options.threads = threads;
        EXPECT_EQ(this->converted(in, options), expected) << threads << " threads";
        EXPECT_EQ(this->Report.boundary_edges, report.boundary_edges);
        EXPECT_EQ(this->Report.nonmanifold_vertices, report.nonmanifold_vertices);
        EXPECT_EQ(this->Report.components, report.components);
        EXPECT_LE(this->Report.pool_bytes_peak, options.memoryLimit);
      }
    }
  }
}

TEST_F(ConversionThreads, KeepTheLeastMemoryLimit)
{
  const std::filesystem::path in = this->write(shuffled(torus(200, 150, 0.1)));
  ConversionOptions options;
  options.memoryLimit = std::int64_t(16) << 20;
  options.threads = 1;
  const std::string expected = this->converted(in, options);
  for (const int threads : { 2, 16 })
  {
    options.threads = threads;
    EXPECT_EQ(this->converted(in, options), expected) << threads << " threads";
    EXPECT_LE(this->Report.pool_bytes_peak, options.memoryLimit);
  }
}

/** The mesh as the text of an OBJ file, with a comment and a name now and then. */
std::string objText(const IndexedTestMesh& mesh)
{
  std::string text;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
  {
    text += i % 1000 == 0 ? "# a comment of some length\r\n" : "";
    text += "v " + exact(mesh.positions[i]) + ' ' + exact(mesh.positions[i + 1]) + '\t' +
            exact(mesh.positions[i + 2]) + '\n';
  }
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    text += i % 999 == 0 ? "usemtl 17\n" : "";
    text += "f " + std::to_string(mesh.corners[i] + 1) + "/1 " +
            std::to_string(mesh.corners[i + 1] + 1) + "/1 " +
            std::to_string(mesh.corners[i + 2] + 1) + "/1\n";
  }
  return text;
}

TEST_F(ConversionThreads, FindTheSameNumbersInALongText)
{
  const IndexedTestMesh surface = shuffled(torus(260, 100, 0.1));
  const std::filesystem::path obj = this->Folder / "mesh.obj";
  std::string text = objText(surface);
  writeBytes(obj, text);
  for (const std::filesystem::path& in :
    { obj, this->write(surface), this->write(shuffled(tetBox(25, 24, 24, 0.1))) })
  {
    ASSERT_GT(std::filesystem::file_size(in), 2 * InputFile::WindowBytes) << in;
    ConversionOptions options;
    options.threads = 1;
    const std::string expected = this->converted(in, options);
    for (const int threads : { 2, 3, 8 })
    {
      options.threads = threads;
      EXPECT_EQ(this->converted(in, options), expected) << in << ", " << threads << " threads";
    }
  }
  text.replace(text.rfind("f "), 3, "f x");
  const auto line = std::count(text.begin(), text.end(), '\n');
  writeBytes(obj, text);
  for (const int threads : { 1, 4 })
  {
    ConversionOptions options;
    options.threads = threads;
    expectError(
      [&] { this->converted(obj, options); }, "mesh.obj, line " + std::to_string(line) + ": 'x");
  }
}

TEST_F(ConversionThreads, CancelLeavesNothing)
{
  const std::filesystem::path in = this->write(shuffled(torus(150, 80, 0.1)));
  for (const double most : { 0.1, 0.3, 0.5, 0.7, 0.9 })
  {
    ConversionOptions options;
    options.threads = 8;
    options.progress = [most](double done) { return done < most; };
    EXPECT_THROW(this->converted(in, options), Cancelled) << most;
    EXPECT_EQ(this->Folder.entries(), 1);
  }
}

} // namespace
} // namespace smg::testing
