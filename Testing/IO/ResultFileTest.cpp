// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/ResultFile.h"

#include "IO/Formats/UsedFiles.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Mesh/Columns.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

// The numbers of a simplified mesh, or of a part, are those of a larger file: not all are places in
// one of this mesh.
TEST(ResultFile, TheExpectedOrderIsTheChosenOne)
{
  const TemporaryFolder folder;
  StreamMesh stream = toStream(grid(150, 140, 0.1));
  const std::int64_t vertices = stream.vertices();
  ASSERT_GT(vertices, 2 * VsmFormat::BlockRows);
  stream.vertexColumns = { { OriginalIdSpec, {} } };
  stream.vertexColumns[0].resize(static_cast<std::size_t>(vertices));
  // The vertex whose number is too large; -1: none.
  for (const std::int64_t wrong : { std::int64_t(-1), std::int64_t(0), vertices / 2, vertices - 1 })
  {
    for (std::int64_t v = 0; v < vertices; ++v)
    {
      stream.vertexColumns[0].as<std::int64_t>()[static_cast<std::size_t>(v)] =
        v == wrong ? vertices : v;
    }
    write(folder / "a.vsm", stream);
    const VsmReader reader(folder / "a.vsm");
    ResultFile result({ .in = folder / "a.vsm", .out = folder / "a.obj" });
    const WrittenOrder expected = result.expectedOrder(reader.info());
    std::vector<double> told;
    const auto progress = [&told](double done)
    {
      told.push_back(done);
      return true;
    };
    result.chooseOrder(reader, nullptr, progress);
    EXPECT_EQ(result.keepsOrder(), wrong < 0) << wrong;
    EXPECT_EQ(expected == WrittenOrder::Restored, wrong < 0) << wrong;
    // It ends at the first one.
    EXPECT_EQ(told.empty(), wrong == vertices - 1) << wrong;
    if (wrong < 0)
    {
      EXPECT_THROW(result.chooseOrder(reader, nullptr, [](double) { return false; }), Cancelled);
    }
  }
}

TEST(ResultFile, AReplacedMeshIsNoLongerTheOneThatWasOpened)
{
  const TemporaryFolder folder;
  StreamMesh stream = toStream(grid(10, 10, 0.1));
  stream.vertexColumns = { { OriginalIdSpec, {} } };
  stream.vertexColumns[0].resize(static_cast<std::size_t>(stream.vertices()));
  write(folder / "a.vsm", stream);
  const VsmReader reader(folder / "a.vsm");
  ResultFile result({ .in = folder / "a.vsm", .out = folder / "a.obj" });
  stream.positions[0] += 1;
  write(folder / "a.vsm", stream);
  expectError([&] { result.chooseOrder(reader, nullptr); }, "is another mesh than before");
}

// The processes of a distributed solve write the pieces beside an index.
TEST(UsedFiles, PiecesOfAResultAreFilesOfIt)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "real");
  std::filesystem::create_directory_symlink(folder / "real", folder / "link");
  const std::pair<const char*, bool> names[] = { { "real/OUT/OUT_0.vtu", true },
    { "link/OUT/OUT_12.vtu", true }, { "real/OUT.pvtu", true }, { "real/OUT/OUT_.vtu", false },
    { "real/OUT/OUT_a.vtu", false }, { "real/OUT/OUT_0.vtp", false },
    { "real/OUT/report.json", false }, { "real/OUT_0.vtu", false }, { "OUT/OUT_0.vtu", false } };
  for (const auto& [name, isRefused] : names)
  {
    UsedFiles files;
    files.writeMesh(folder / "real/OUT.pvtu");
    files.write(folder / name, "report");
    UsedFiles read;
    read.read(folder / name, "the problem");
    read.writeMesh(folder / "real/OUT.pvtu");
    for (const UsedFiles* each : { &files, &read })
    {
      const std::string error = messageOf([each] { each->check(); });
      EXPECT_EQ(error.find("would overwrite") != std::string::npos, isRefused) << name << error;
    }
  }
}

} // namespace
} // namespace smg::testing
