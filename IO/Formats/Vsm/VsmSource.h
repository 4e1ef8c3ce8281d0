// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/PositionReader.h"
#include "IO/Formats/Vsm/VsmFile.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/** Delivers a .vsm file as a mesh stream, one block of the cells at a time. */
class VsmSource : public MeshSource
{
public:
  VsmSource(const std::filesystem::path& path, const std::vector<std::string>& vertexColumns,
    const std::vector<std::string>& cellColumns, IoStatistics* statistics);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;
  bool readsOnAnyThread() const override { return true; }

private:
  void prefetch(std::int64_t block);
  void readColumns(std::vector<RowReader>& readers, const std::vector<ColumnSpec>& specs,
    std::int64_t first, std::int64_t count, std::vector<Column>& columns);

  VsmFile File;
  StreamInfo Info;
  PositionReader Positions;
  std::vector<RowReader> VertexColumns, CellColumns;
  std::int64_t Next = 0;             ///< block of the cells
  std::int64_t PrefetchedVertex = 0; ///< first block of the vertices not asked for yet
};

} // namespace smg
