// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamConversion.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace smg::testing
{

/** Tests of files that name regions of a mesh: a lattice of 5 x 5 vertices whose original numbers
 * start at 1000, in reverse order. */
class RegionFile : public ::testing::Test
{
protected:
  static constexpr std::int64_t BlockCells = 7;

  RegionFile()
    : Source(lattice(), BlockCells)
  {
  }

  static StreamMesh lattice()
  {
    StreamMesh mesh = toStream(grid(5, 5));
    std::vector<std::int64_t> ids;
    for (std::int64_t i = 0; i < mesh.vertices(); ++i)
    {
      ids.push_back(1000 + mesh.vertices() - 1 - i);
    }
    mesh.vertexColumns.push_back(makeColumn<std::int64_t>(OriginalIdName, ids));
    return mesh;
  }

  /** The name of a file with the text. */
  std::filesystem::path file(const std::string& json) const
  {
    writeBytes(this->Folder / "p.json", json);
    return this->Folder / "p.json";
  }

  TemporaryFolder Folder;
  MemorySource Source;
};

#define EXPECT_CONTAINS(text, part) EXPECT_PRED_FORMAT2(::testing::IsSubstring, part, text)

} // namespace smg::testing
