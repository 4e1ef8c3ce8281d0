// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmBuffers.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/WriteMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

// What a .vsm file needs to know of vertices until their last cell: in memory, or counted as
// scratch.

namespace smg::testing
{
namespace
{

/** The number of open files in a folder; those without a name are counted, too. */
int openFilesIn(const std::filesystem::path& folder)
{
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
  {
    std::error_code ignored;
    const std::string path = std::filesystem::read_symlink(entry.path(), ignored).native();
    count += path.starts_with(folder.native() + '/') ? 1 : 0;
  }
  return count;
}

/** A band of triangles (i, i + 1, i + 2), or a fan of triangles (0, i + 1, i + 2). */
class RowOfTriangles : public MeshSource
{
public:
  RowOfTriangles(std::int64_t cells, bool isFan, std::filesystem::path watched)
    : IsFan(isFan)
    , Watched(std::move(watched))
  {
    this->Info.cells = cells;
    this->Info.vertices = cells + 2;
    this->Info.doublePositions = false;
  }

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override
  {
    this->MaxOpen = std::max(this->MaxOpen, openFilesIn(this->Watched));
    const std::int64_t count = std::min<std::int64_t>(BlockCells, this->Info.cells - this->Cells);
    block.firstVertex = this->Vertices;
    block.firstCell = this->Cells;
    block.positions.clear();
    block.corners.clear();
    const std::int64_t vertices = count > 0 ? this->Cells + count + 2 : this->Vertices;
    for (; this->Vertices < vertices; this->Vertices++)
    {
      const auto x = static_cast<double>(this->Vertices / 2);
      block.positions.insert(
        block.positions.end(), { x, static_cast<double>(this->Vertices % 2), 0.0 });
    }
    for (const std::int64_t end = this->Cells + count; this->Cells < end; this->Cells++)
    {
      block.corners.insert(
        block.corners.end(), { this->IsFan ? 0 : this->Cells, this->Cells + 1, this->Cells + 2 });
    }
    block.finalized = this->IsFan ? 0 : this->Cells;
    return count > 0;
  }

  /** The most files that were open at once in the folder that is watched. */
  int maxOpen() const { return this->MaxOpen; }

private:
  static constexpr std::int64_t BlockCells = 10000;

  StreamInfo Info;
  bool IsFan;
  std::filesystem::path Watched;
  std::int64_t Vertices = 0, Cells = 0;
  int MaxOpen = 0;
};

class VsmWriterScratch : public ::testing::Test
{
protected:
  void SetUp() override { std::filesystem::create_directory(this->Out); }

  static constexpr std::int64_t Cells = 1200000; // more than there is memory for at once
  TemporaryFolder Folder;
  std::filesystem::path Out = this->Folder / "out";
  ScratchFolder Scratch{ this->Folder.path() };
};

} // namespace

TEST_F(VsmWriterScratch, AStreamWhoseVerticesBecomeFinalNeedsNoFile)
{
  RowOfTriangles band(Cells, false, this->Out);
  const WrittenVsm written = writeVsm(
    band, this->Out / "band.vsm", { .codec = Codec::Lz4, .scratch = this->Scratch.path() });
  EXPECT_EQ(band.maxOpen(), 1) << "that of the result";
  EXPECT_EQ(this->Scratch.account().peak(), 0);
  EXPECT_EQ(written.info.width, 3);
  EXPECT_EQ(written.meanWidth, 3.0);
}

TEST_F(VsmWriterScratch, WhatHasNoRoomIsCountedWithTheScratchFiles)
{
  RowOfTriangles fan(Cells, true, this->Out);
  const WrittenVsm written =
    writeVsm(fan, this->Out / "fan.vsm", { .codec = Codec::Lz4, .scratch = this->Scratch.path() });
  EXPECT_EQ(fan.maxOpen(), 1) << "that of the result";
  EXPECT_GT(this->Scratch.account().peak(), 4 * Cells);
  EXPECT_EQ(this->Scratch.account().used(), 0);
  EXPECT_EQ(written.info.width, 3);
  EXPECT_EQ(written.meanWidth, 3.0);

  // The same holds of a format that needs the last cells, which is not made beside its input.
  std::vector<int> open;
  const auto watch = [&](double)
  {
    open.push_back(openFilesIn(this->Out));
    return true;
  };
  const ScratchFolder other(this->Folder.path());
  writeFromVsm(this->Out / "fan.vsm", this->Folder / "fan.smb", watch, other.path());
  EXPECT_EQ(std::ranges::max(open), std::ranges::min(open)) << "those of the reader";
  EXPECT_GT(other.account().peak(), Cells);
  EXPECT_EQ(other.account().used(), 0);
}

TEST_F(VsmWriterScratch, StatisticsRunAlongInAnyOrder)
{
  for (const int step : { 1, 7, 1000000 })
  {
    Random random(static_cast<std::uint64_t>(step));
    constexpr std::int64_t cells = 3000;
    StreamStatistics statistics(this->Scratch.path());
    std::vector<std::int64_t> first, last;
    std::vector<int> ends(cells);
    for (std::int64_t cell = 0; cell < cells; cell++)
    {
      for (std::int64_t count = random.below(4); count > 0; count--)
      {
        const std::int64_t end = cell + random.below(cells - cell);
        if (++ends[end] <= 4) // the corners of a cell
        {
          first.push_back(cell);
          last.push_back(end);
        }
      }
    }
    std::int64_t begun = 0, settled = 0;
    for (std::int64_t cell = 0; cell < cells; cell++)
    {
      for (; begun < std::ssize(first) && first[begun] == cell; begun++)
      {
        statistics.introduce(cell);
      }
      for (; settled < begun && last[settled] <= cell; settled++)
      {
        statistics.finalize(last[settled]);
      }
      if (cell % step == 0 || cell == cells - 1)
      {
        statistics.count(cell + 1, settled);
      }
    }
    std::int64_t width = 0;
    double sum = 0;
    for (std::int64_t cell = 0; cell < cells; cell++)
    {
      std::int64_t alive = 0;
      for (std::size_t v = 0; v < first.size(); v++)
      {
        alive += first[v] <= cell && cell <= last[v] ? 1 : 0;
      }
      width = std::max(width, alive);
      sum += static_cast<double>(alive);
    }
    EXPECT_EQ(statistics.result().width, width);
    EXPECT_EQ(statistics.result().mean, sum / double(cells));
  }
}

} // namespace smg::testing
