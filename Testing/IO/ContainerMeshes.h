// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmWriter.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** A column with random values of any type. */
inline Column randomColumn(ColumnSpec spec, std::int64_t tuples, std::uint64_t seed)
{
  Random random(seed);
  Column column{ std::move(spec), {} };
  column.resize(tuples);
  dispatch(column.spec.type,
    [&]<class T>(T)
    {
      for (T& value : column.as<T>())
      {
        value = static_cast<T>(random.uniform(0, 100));
      }
    });
  return column;
}

/** A mesh stream with columns; `single`: of positions in single precision. */
inline StreamMesh testStream(const IndexedTestMesh& mesh, bool single = false)
{
  StreamMesh stream = toStream(mesh);
  if (single)
  {
    for (double& x : stream.positions)
    {
      x = static_cast<float>(x);
    }
  }
  for (int type = 0; type < 10; type++)
  {
    const auto scalar = static_cast<ScalarType>(type);
    stream.vertexColumns.push_back(randomColumn(
      { "vertex " + std::string(nameOf(scalar)), scalar, 1 + type % 3 }, stream.vertices(), type));
  }
  stream.cellColumns.push_back(
    randomColumn({ "cell numbers", ScalarType::Int64, 1 }, stream.cells(), 20));
  stream.cellColumns.push_back(
    randomColumn({ "cell colours", ScalarType::UInt8, 3 }, stream.cells(), 21));
  return stream;
}

struct WriteOptions
{
  bool single = false;
  bool sayFinal = true;
  std::int64_t blockCells = 1000;
  Codec codec = Codec::Zstd;
};

inline StreamInfo write(
  const std::filesystem::path& path, const StreamMesh& mesh, WriteOptions options = {})
{
  MemorySource source(mesh, options.blockCells);
  StreamInfo info = source.info();
  info.doublePositions = !options.single;
  VsmWriter writer(path, info, { .codec = options.codec });
  MeshBlock block;
  while (source.next(block))
  {
    block.finalized = options.sayFinal ? block.finalized : 0;
    writer.append(block);
  }
  return writer.finish();
}

inline void expectSame(const std::vector<Column>& a, const std::vector<Column>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); c++)
  {
    EXPECT_EQ(a[c].spec, b[c].spec);
    EXPECT_EQ(a[c].bytes, b[c].bytes) << a[c].spec.name;
  }
}

inline void expectSame(const StreamMesh& a, const StreamMesh& b)
{
  EXPECT_EQ(a.cellType, b.cellType);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.corners, b.corners);
  expectSame(a.vertexColumns, b.vertexColumns);
  expectSame(a.cellColumns, b.cellColumns);
}

inline std::vector<std::int64_t> lastCellsOf(const StreamMesh& mesh)
{
  std::vector<std::int64_t> last(mesh.vertices());
  const int corners = cornersOf(mesh.cellType);
  for (std::size_t i = 0; i < mesh.corners.size(); i++)
  {
    last[mesh.corners[i]] = std::int64_t(i) / corners;
  }
  return last;
}

} // namespace smg::testing
