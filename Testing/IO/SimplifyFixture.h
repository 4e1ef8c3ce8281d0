// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Simplify.h"

#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace smg::testing
{

/** Simplifies meshes in memory, and has the report of the last one. */
class SimplifyFixture : public ::testing::Test
{
protected:
  StreamMesh simplified(
    const StreamMesh& mesh, const SimplifyTarget& target, const SimplifyOptions& options = {})
  {
    this->Report = simplify(MemoryMesh(mesh, 1000), target, this->Folder / "simple.vsm", options);
    return collect(*VsmReader(this->Folder / "simple.vsm").source());
  }
  StreamMesh simplified(
    const StreamMesh& mesh, const SimplifyTarget& target, std::int64_t mebibytes)
  {
    SimplifyOptions options;
    options.memoryLimit = mebibytes << 20;
    return this->simplified(mesh, target, options);
  }

  /** Whether a note of the last report has these words. */
  bool isSaid(const std::string& words) const
  {
    return std::ranges::any_of(this->Report.notes,
      [&](const std::string& note) { return note.find(words) != std::string::npos; });
  }

  TemporaryFolder Folder;
  SimplifyReport Report;
};

} // namespace smg::testing
