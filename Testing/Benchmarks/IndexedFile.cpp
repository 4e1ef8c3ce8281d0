// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/IndexedFile.h"

#include "Testing/Support/RawMeshReading.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace smg::benchmark
{
namespace
{

using testing::IndexedTestMesh;
using Numbers = std::vector<std::int32_t>;

/** A binary file of numbers in either byte order. */
class BinaryFile
{
public:
  BinaryFile(const std::filesystem::path& path, std::endian order)
    : Path(path)
    , Order(order)
    , Stream(path, std::ios::binary)
  {
  }

  void text(const std::string& characters) { this->Stream << characters; }

  template <class T>
  void number(T value)
  {
    std::array<char, sizeof(T)> bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (this->Order != std::endian::native)
    {
      std::ranges::reverse(bytes);
    }
    this->Stream.write(bytes.data(), bytes.size());
  }

  void finish()
  {
    if (!this->Stream.flush())
    {
      throw Error(this->Path.string() + ": cannot be written.");
    }
  }

private:
  std::filesystem::path Path;
  std::endian Order;
  std::ofstream Stream;
};

Numbers identity(std::int64_t count)
{
  Numbers numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

void shuffle(Numbers& numbers, testing::Random& random)
{
  for (std::size_t i = numbers.size(); i > 1; --i)
  {
    std::swap(numbers[i - 1], numbers[static_cast<std::size_t>(random.below(std::int64_t(i)))]);
  }
}

/** The order of the vertices and cells of a mesh in a file. */
struct FileOrder
{
  Numbers vertices, cells;
  Numbers places; ///< of each vertex of the mesh: its number in the file
};

FileOrder fileOrder(const IndexedTestMesh& mesh, std::optional<std::uint64_t> seed)
{
  FileOrder order{ identity(mesh.vertices()), identity(mesh.cells()), {} };
  if (seed)
  {
    testing::Random random(*seed);
    shuffle(order.vertices, random);
    shuffle(order.cells, random);
  }
  order.places.resize(order.vertices.size());
  for (std::size_t place = 0; place < order.vertices.size(); ++place)
  {
    order.places[static_cast<std::size_t>(order.vertices[place])] =
      static_cast<std::int32_t>(place);
  }
  return order;
}

void writePoints(BinaryFile& file, const IndexedTestMesh& mesh, const FileOrder& order)
{
  for (const std::int32_t vertex : order.vertices)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      file.number(static_cast<float>(mesh.positions[3 * static_cast<std::size_t>(vertex) + k]));
    }
  }
}

/** Each cell as the number of its corners, of type Count, and the corners. */
template <class Count>
void writeCells(BinaryFile& file, const IndexedTestMesh& mesh, const FileOrder& order)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  for (const std::int32_t cell : order.cells)
  {
    file.number(static_cast<Count>(corners));
    for (std::size_t k = 0; k < corners; ++k)
    {
      const std::int64_t corner = mesh.corners[corners * static_cast<std::size_t>(cell) + k];
      file.number(order.places[static_cast<std::size_t>(corner)]);
    }
  }
}

void writePly(
  const IndexedTestMesh& mesh, const FileOrder& order, const std::filesystem::path& path)
{
  BinaryFile file(path, std::endian::little);
  file.text(
    "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices()) +
    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
    std::to_string(mesh.cells()) + "\nproperty list uchar int vertex_indices\nend_header\n");
  writePoints(file, mesh, order);
  writeCells<std::uint8_t>(file, mesh, order);
  file.finish();
}

void writeLegacyVtk(
  const IndexedTestMesh& mesh, const FileOrder& order, const std::filesystem::path& path)
{
  constexpr std::int32_t vtkTetra = 10;
  const std::string cells = std::to_string(mesh.cells());
  BinaryFile file(path, std::endian::big);
  file.text("# vtk DataFile Version 3.0\nbenchmark\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
            std::to_string(mesh.vertices()) + " float\n");
  writePoints(file, mesh, order);
  file.text("\nCELLS " + cells + " " + std::to_string(5 * mesh.cells()) + "\n");
  writeCells<std::int32_t>(file, mesh, order);
  file.text("\nCELL_TYPES " + cells + "\n");
  for (std::int64_t cell = 0; cell < mesh.cells(); ++cell)
  {
    file.number(vtkTetra);
  }
  file.text("\n");
  file.finish();
}

} // namespace

IndexedTestMesh readIndexed(const std::filesystem::path& path)
{
  testing::ReadMesh mesh = testing::importWhole(path);
  return { mesh.cellType, std::move(mesh.positions), std::move(mesh.corners) };
}

void writeIndexed(const IndexedTestMesh& mesh, const std::filesystem::path& path,
  std::optional<std::uint64_t> shuffleSeed)
{
  const bool isSurface = mesh.cellType == CellType::Triangle;
  if (path.extension() != (isSurface ? ".ply" : ".vtk"))
  {
    throw Error(path.string() + (isSurface ? ": triangles are written as .ply."
                                           : ": tetrahedra are written as .vtk."));
  }
  if (std::max(mesh.vertices(), mesh.cells()) > std::numeric_limits<std::int32_t>::max())
  {
    throw Error(path.string() + ": the mesh has more than 2^31 - 1 vertices or cells.");
  }
  const FileOrder order = fileOrder(mesh, shuffleSeed);
  isSurface ? writePly(mesh, order, path) : writeLegacyVtk(mesh, order, path);
}

} // namespace smg::benchmark
