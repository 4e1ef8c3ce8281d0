// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/ScratchLimits.h"

#include "Testing/IO/MeshText.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Convert.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

// Conversions keep their scratch files below a limit.

namespace smg::testing
{
namespace
{

/** The result of a conversion. */
struct Limited
{
  bool same(const Limited& other) const { return this->content == other.content; }

  std::int64_t bytes;
  std::string content;
};

std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

class ScratchLimitOfAConversion : public ::testing::Test
{
protected:
  /** Converts `in` to `out`, with a limit that is needed and with lower ones. */
  void expectKept(
    const std::filesystem::path& in, const std::string& out, ConversionOptions options = {})
  {
    options.memoryLimit = std::int64_t(16) << 20;
    const std::filesystem::path result = this->Folder / out;
    expectScratchLimitKept(options,
      [&](const ConversionOptions& limited)
      {
        std::filesystem::remove(result);
        std::int64_t peak = 0;
        try
        {
          peak = convert(in, result, limited).scratch_bytes_peak;
        }
        catch (const Error&)
        {
          EXPECT_FALSE(std::filesystem::exists(result));
          throw;
        }
        return Limited{ peak, contentOf(result) };
      });
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(ScratchLimitOfAConversion, OfEachOrder)
{
  writeBytes(this->Folder / "mesh.off", meshText(shuffled(torus(200, 100, 0.3))));
  ConversionOptions options;
  for (const StreamOrder order :
    { StreamOrder::BreadthFirst, StreamOrder::Axis, StreamOrder::Spectral, StreamOrder::Keep })
  {
    SCOPED_TRACE(nameOf(order));
    options.order = order;
    this->expectKept(this->Folder / "mesh.off", "mesh.vsm", options);
  }
}

TEST_F(ScratchLimitOfAConversion, OfASolidAndBack)
{
  writeBytes(this->Folder / "mesh.mesh", meshText(shuffled(tetBox(16, 16, 16))));
  this->expectKept(this->Folder / "mesh.mesh", "mesh.vtu");
  convert(this->Folder / "mesh.mesh", this->Folder / "mesh.vsm");
  ConversionOptions restore;
  restore.restoreOrder = true;
  this->expectKept(this->Folder / "mesh.vsm", "restored.mesh", restore);
}

TEST_F(ScratchLimitOfAConversion, IncludesTheFileThatIsOpened)
{
  writeBytes(this->Folder / "mesh.off", meshText(shuffled(torus(200, 100, 0.3))));
  expectScratchLimitKept(ConversionOptions(),
    [&](const ConversionOptions& options)
    {
      const std::unique_ptr<OpenedMesh> mesh = openMesh(this->Folder / "mesh.off", options);
      return Limited{ mesh->conversion()->scratch_bytes_peak, contentOf(mesh->reader().path()) };
    });
}

TEST_F(ScratchLimitOfAConversion, MustNotBeNegative)
{
  writeBytes(this->Folder / "mesh.off", meshText(torus(20, 10)));
  ConversionOptions options;
  options.scratchLimit = -1;
  expectError([&] { convert(this->Folder / "mesh.off", this->Folder / "mesh.vsm", options); },
    "limit of scratch files");
}

} // namespace smg::testing
