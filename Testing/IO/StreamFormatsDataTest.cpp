// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/Support/TestFolders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <tuple>

namespace smg::testing
{
namespace
{

/** With the samples of the archive, some of them written by other programs. */
class StreamFormatsData : public StreamFormats
{
protected:
  void SetUp() override
  {
    this->Samples = archiveFolder() / "streaming";
    if (archiveFolder().empty() || !std::filesystem::exists(this->Samples))
    {
      GTEST_SKIP() << "SMG_TEST_DATA_DIR names no folder with the samples";
    }
  }
  std::filesystem::path Samples;
};

TEST_F(StreamFormatsData, HaveTheCountsAndWidthsThatAreKnown)
{
  for (const auto& [name, vertices, cells, width] :
    { std::tuple{ "bunny_bfs_postorder.sma", 34834, 69451, 349 },
      std::tuple{ "bunny_spectral.sma", 34834, 69451, 226 },
      std::tuple{ "bunny_spectral_be.smb", 34834, 69451, 226 },
      std::tuple{ "bunny_spectral_le.smb", 34834, 69451, 226 },
      std::tuple{ "bunny_spectral_x86_64mark.smb", 34834, 69451, 226 },
      std::tuple{ "bunny_tet_bfs.sva", 5433, 34055, 583 },
      std::tuple{ "bunny_tet_bfs.svb", 5433, 34055, 583 } })
  {
    this->convert(this->Samples / name);
    EXPECT_EQ(this->Result.info.vertices, vertices) << name;
    EXPECT_EQ(this->Result.info.cells, cells) << name;
    EXPECT_EQ(this->Result.info.width, width) << name;
    EXPECT_EQ(this->Result.isolatedVertices, 0) << name;
  }
  EXPECT_NE(
    messageOf([&] { openStreamFile(this->Samples / "bunny_spectral_q16.smc"); }).find("SMC"),
    std::string::npos);
}

TEST_F(StreamFormatsData, ComeBackByteForByte)
{
  const std::string expected = readFile(this->Samples / "bunny_spectral_le.smb");
  for (const char* name : { "bunny_spectral_le.smb", "bunny_spectral_be.smb",
         "bunny_spectral_x86_64mark.smb", "bunny_spectral.sma" })
  {
    this->convert(this->Samples / name);
    vsmToStream(this->Folder / "out.vsm", this->Folder / "out.smb");
    EXPECT_TRUE(readFile(this->Folder / "out.smb") == expected) << name;
  }
  this->convert(this->Samples / "bunny_tet_bfs.sva");
  vsmToStream(this->Folder / "out.vsm", this->Folder / "out.svb");
  EXPECT_TRUE(readFile(this->Folder / "out.svb") == readFile(this->Samples / "bunny_tet_bfs.svb"));
}

TEST_F(StreamFormatsData, TruncatedSamplesAreRefused)
{
  for (const char* name : { "bunny_spectral_le.smb", "bunny_spectral.sma", "bunny_tet_bfs.svb",
         "bunny_tet_bfs.sva", "bunny_bfs_postorder.sma" })
  {
    const std::string good = readFile(this->Samples / name);
    for (int k = 1; k < 20; k++)
    {
      EXPECT_NE(this->refusal(name, good.substr(0, good.size() * k / 20)), "") << name << k;
    }
  }
}

} // namespace
} // namespace smg::testing
