// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/KeptConversion.h"

#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace smg::testing
{
namespace
{

class KeptConversion : public ::testing::Test
{
protected:
  void SetUp() override { writeBytes(this->In, meshText(torus(30, 20))); }

  /** Whether the file was converted; otherwise it was up to date. */
  bool converts(StreamOrder order = StreamOrder::BreadthFirst, bool overwrite = false)
  {
    ConversionOptions options;
    options.order = order;
    return convertToKeep(this->In, this->Out, options, overwrite).has_value();
  }

  void expectError(const std::string& part, bool overwrite = false)
  {
    smg::testing::expectError([&] { this->converts(StreamOrder::BreadthFirst, overwrite); }, part);
  }

  TemporaryFolder Folder;
  std::filesystem::path In = this->Folder / "mesh one.off";
  std::filesystem::path Out = this->Folder / "mesh.vsm";
};

TEST_F(KeptConversion, IsMadeOnceAndUsedAgain)
{
  EXPECT_TRUE(this->converts());
  EXPECT_EQ(VsmReader(this->Out).info().vertices, 600);
  EXPECT_FALSE(this->converts());
  EXPECT_FALSE(this->converts());
  EXPECT_EQ(this->Folder.entries(), 2);
}

TEST_F(KeptConversion, IsMadeAnewForAnotherOrderOrAChangedFile)
{
  EXPECT_TRUE(this->converts());
  EXPECT_TRUE(this->converts(StreamOrder::Axis));
  EXPECT_TRUE(this->converts(StreamOrder::BreadthFirst));
  std::filesystem::last_write_time(
    this->In, std::filesystem::last_write_time(this->In) + std::chrono::seconds(1));
  EXPECT_TRUE(this->converts());
  writeBytes(this->In, meshText(torus(31, 20)));
  EXPECT_TRUE(this->converts());
  EXPECT_EQ(VsmReader(this->Out).info().vertices, 620);
  std::filesystem::remove(this->Out);
  EXPECT_TRUE(this->converts());
}

TEST_F(KeptConversion, IsMadeAnewForAnotherWeldDistanceHoweverSmall)
{
  const auto converts = [this](double distance)
  {
    ConversionOptions options;
    options.weld = distance;
    return convertToKeep(this->In, this->Out, options).has_value();
  };
  EXPECT_TRUE(converts(0));
  EXPECT_TRUE(converts(1e-9));
  EXPECT_FALSE(converts(1e-9));
  EXPECT_TRUE(converts(1.1e-9));
}

TEST_F(KeptConversion, IsMadeAnewForOtherCouplings)
{
  const auto converts = [this](const CoupledGroups& coupled)
  {
    ConversionOptions options;
    options.coupled = coupled;
    return convertToKeep(this->In, this->Out, options).has_value();
  };
  EXPECT_TRUE(converts({}));
  EXPECT_TRUE(converts({ .periodic = { { { "left" }, { "right" } } }, .interfaces = {} }));
  EXPECT_FALSE(converts({ .periodic = { { { "left" }, { "right" } } }, .interfaces = {} }));
  EXPECT_TRUE(converts({ .periodic = {}, .interfaces = { { "gap" } } }));
  EXPECT_TRUE(converts({}));
}

TEST_F(KeptConversion, IsMadeAnewForAnotherPartOfTheFile)
{
  const std::filesystem::path grid = this->Folder / "mesh.vtkhdf";
  convert(this->In, grid);
  const auto converts = [&](std::optional<std::int64_t> partition)
  {
    ConversionOptions options;
    options.partition = partition;
    return convertToKeep(grid, this->Out, options).has_value();
  };
  EXPECT_TRUE(converts({}));
  EXPECT_TRUE(converts(0));
  EXPECT_FALSE(converts(0));
  smg::testing::expectError([&] { converts(1); }, "no partition 1");
}

TEST_F(KeptConversion, LeavesOtherFilesAlone)
{
  writeBytes(this->Out, "a letter");
  this->expectError("mesh.vsm is there already");
  EXPECT_EQ(std::filesystem::file_size(this->Out), 8U);
  EXPECT_TRUE(this->converts(StreamOrder::BreadthFirst, true));

  // The conversion of another file, and a .vsm without information about its input.
  this->In = this->Folder / "other.off";
  writeBytes(this->In, meshText(torus(9, 8)));
  this->expectError("not made from other.off by this converter");
  std::filesystem::remove(this->Out);
  convert(this->In, this->Out);
  this->expectError("is there already");
  EXPECT_TRUE(this->converts(StreamOrder::BreadthFirst, true));
  EXPECT_FALSE(this->converts(StreamOrder::BreadthFirst, true));
}

TEST_F(KeptConversion, NamesAreNotMixedUp)
{
  EXPECT_TRUE(this->converts());
  for (const char* name : { "mesh", "mesh%20one.off", "mesh\xff one.off" })
  {
    this->In = this->Folder / name;
    writeBytes(this->In, meshText(torus(9, 8)));
    this->expectError("is there already");
  }
  EXPECT_TRUE(this->converts(StreamOrder::BreadthFirst, true));
  EXPECT_FALSE(this->converts());
}

TEST_F(KeptConversion, FilesOfOneNameAreNotMixedUp)
{
  EXPECT_TRUE(this->converts());
  const std::filesystem::path first = this->In;
  std::filesystem::create_directory(this->Folder / "sub");
  this->In = this->Folder / "sub" / "mesh one.off";
  std::filesystem::copy(first, this->In);
  std::filesystem::last_write_time(this->In, std::filesystem::last_write_time(first));
  this->expectError("not made from mesh one.off");
  // The same file by another path is the same.
  std::filesystem::create_directory_symlink(this->Folder.path(), this->Folder / "link");
  this->In = this->Folder / "link" / "mesh one.off";
  EXPECT_FALSE(this->converts());
}

TEST_F(KeptConversion, BadNamesAreErrors)
{
  this->Out = this->Folder / "mesh.smb";
  this->expectError("ends so");
  this->Out = this->Folder / "no folder" / "mesh.vsm";
  this->expectError("no folder");
  this->Out = this->Folder / "mesh.vsm";
  EXPECT_TRUE(this->converts());
  this->In = this->Out;
  this->expectError("the mesh itself", true);
  this->In = this->Folder / "absent.off";
  this->expectError("absent.off: there is no such file");
}

TEST_F(KeptConversion, AFailureLeavesTheFileThatWasThere)
{
  EXPECT_TRUE(this->converts());
  writeBytes(this->In, "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  this->expectError("mesh one.off");
  EXPECT_EQ(VsmReader(this->Out).info().vertices, 600);
  EXPECT_EQ(this->Folder.entries(), 2);
  ConversionOptions options;
  options.progress = [](double) { return false; };
  writeBytes(this->In, meshText(torus(30, 20)));
  EXPECT_THROW(convertToKeep(this->In, this->Out, options), Cancelled);
  EXPECT_EQ(this->Folder.entries(), 2);
}

TEST_F(KeptConversion, OfSeveralAtATimeOneConverts)
{
  std::vector<int> converted(4, -1);
  std::vector<std::thread> threads;
  for (int& result : converted)
  {
    threads.emplace_back([this, &result] { result = this->converts() ? 1 : 0; });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(std::count(converted.begin(), converted.end(), 1), 1);
  EXPECT_EQ(std::count(converted.begin(), converted.end(), 0), 3);
}

} // namespace

} // namespace smg::testing
