// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamFileWriter.h"
#include "Testing/Support/StreamMesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <vector>

namespace smg::testing
{

/** A mesh in the order of the written file. */
struct StreamStyle
{
  StreamFileHeader header;
  StreamFileStyle style;
  bool counts = true;
  bool bounds = true;
};

/** Writes a stream: in post-order each vertex after its last cell, otherwise before its first;
 * vertices are numbered in the order of the file. */
inline void writeStream(const std::filesystem::path& path, const StreamMesh& mesh, StreamStyle file)
{
  const auto corners = std::size_t(cornersOf(mesh.cellType));
  file.header.vertices = file.counts ? mesh.vertices() : -1;
  file.header.cells = file.counts ? mesh.cells() : -1;
  if (file.bounds)
  {
    file.header.bounds = { -9, 9, -9, 9, -9, 9 };
  }
  std::vector<std::int64_t> last(mesh.vertices());
  for (std::size_t i = 0; i < mesh.corners.size(); i++)
  {
    last[mesh.corners[i]] = std::int64_t(i / corners);
  }
  std::vector<std::int64_t> number(mesh.vertices());
  std::iota(number.begin(), number.end(), 0);
  if (file.header.postOrder)
  {
    std::vector<std::int64_t> order = number;
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return last[a] < last[b]; });
    for (std::size_t i = 0; i < order.size(); i++)
    {
      number[order[i]] = std::int64_t(i);
    }
  }
  std::vector<std::int64_t> vertexOf(mesh.vertices());
  for (std::int64_t v = 0; v < mesh.vertices(); v++)
  {
    vertexOf[number[v]] = v;
  }

  const auto writer = createStreamFile(path, file.header, file.style);
  std::int64_t written = 0;
  const auto writeVertex = [&]
  {
    const double* const p = &mesh.positions[3 * vertexOf[written++]];
    const std::array<float, 3> position{ float(p[0]), float(p[1]), float(p[2]) };
    writer->vertex(position);
  };
  for (std::int64_t c = 0; c < mesh.cells(); c++)
  {
    std::vector<std::int64_t> cell;
    unsigned finalMask = 0;
    for (std::size_t k = 0; k < corners; k++)
    {
      const std::int64_t v = mesh.corners[c * corners + k];
      while (!file.header.postOrder && written <= v)
      {
        writeVertex();
      }
      cell.push_back(number[v]);
      finalMask |= unsigned(last[v] == c) << k;
    }
    writer->cell(cell, finalMask);
    while (file.header.postOrder && written < mesh.vertices() && last[vertexOf[written]] == c)
    {
      writeVertex();
    }
  }
  writer->finish();
}

inline StreamMesh singlePrecision(StreamMesh mesh)
{
  for (double& x : mesh.positions)
  {
    x = static_cast<float>(x);
  }
  return mesh;
}

} // namespace smg::testing
