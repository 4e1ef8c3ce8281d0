// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamFileWriter.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/StreamMesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

namespace smg::testing
{

/** A mesh in the order of the written file; some variants only other programs write. */
struct StreamStyle
{
  enum Finalization
  {
    None,    ///< not at all
    InCell,  ///< by a negative, relative index in the last cell
    Explicit ///< by a separate line (text formats only)
  };
  StreamFileHeader header;
  Finalization finalization = InCell;
  bool bigEndian = false; ///< byte order of the data of the binary formats
  char endianFlag = 0;    ///< the byte for the order: 0 little, 1 big; some write a wrong one
  bool counts = true;
  bool bounds = true;
};

/** Gives a binary file without further values the byte order and the flag. */
inline void changeByteOrder(const std::filesystem::path& path, const StreamStyle& file)
{
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  bytes[1] = file.endianFlag;
  auto at = bytes.begin() + 4;
  const auto swapWords = [&](std::ptrdiff_t count)
  {
    for (const auto end = at + 4 * count; at != end; at += 4)
    {
      std::reverse(at, at + 4);
    }
  };
  if (file.bigEndian)
  {
    swapWords(1);
    for (const std::string& comment : file.header.comments)
    {
      swapWords(1);
      at += std::ssize(comment);
    }
    swapWords(file.header.format == StreamFormat::Svb ? 4 : 2);
    ++at; // whether there are bounds
    swapWords((bytes.end() - at) / 4);
  }
  writeBytes(path, bytes);
}

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

  const auto writer = createStreamFile(path, file.header);
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
    writer->cell(cell, file.finalization == StreamStyle::InCell ? finalMask : 0);
    for (std::size_t k = 0; file.finalization == StreamStyle::Explicit && k < corners; k++)
    {
      if ((finalMask >> k & 1U) != 0)
      {
        writer->finalization(cell[k]);
      }
    }
    while (file.header.postOrder && written < mesh.vertices() && last[vertexOf[written]] == c)
    {
      writeVertex();
    }
  }
  writer->finish();
  if (!isText(file.header.format))
  {
    changeByteOrder(path, file);
  }
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
