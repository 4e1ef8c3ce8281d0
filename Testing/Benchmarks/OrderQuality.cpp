// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/OrderQuality.h"

#include "Testing/Benchmarks/StreamOrderMeasure.h"
#include "Testing/Support/InCoreOrder.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace smg::benchmark
{
namespace
{

using Corners = std::span<const std::int64_t>;

/** Calls `visit` with the corners of each cell of the file. */
template <class Visit>
void forEachCell(const VsmReader& reader, const Visit& visit)
{
  const auto corners = static_cast<std::size_t>(cornersOf(reader.info().cellType));
  const auto source = reader.source({}, {});
  for (MeshBlock block; source->next(block);)
  {
    for (std::size_t c = 0; c < block.corners.size(); c += corners)
    {
      visit(Corners(block.corners).subspan(c, corners));
    }
  }
}

nlohmann::json json(const StreamOrderMeasure& measure)
{
  return { { "span", measure.span() }, { "width", measure.width() },
    { "mean_window", measure.meanWindow() } };
}

testing::IndexedTestMesh connectivity(const VsmReader& reader)
{
  testing::IndexedTestMesh mesh;
  mesh.cellType = reader.info().cellType;
  mesh.positions.resize(static_cast<std::size_t>(3 * reader.info().vertices));
  mesh.corners.reserve(
    static_cast<std::size_t>(reader.info().cells * cornersOf(reader.info().cellType)));
  forEachCell(reader,
    [&](Corners cell) { mesh.corners.insert(mesh.corners.end(), cell.begin(), cell.end()); });
  return mesh;
}

/** The cells by the largest place of their vertices. */
std::vector<std::uint32_t> sortedCells(
  const testing::IndexedTestMesh& mesh, std::span<const std::uint32_t> places)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::vector<std::uint32_t> last(mesh.corners.size() / corners);
  for (std::size_t c = 0; c < last.size(); ++c)
  {
    for (std::size_t k = 0; k < corners; ++k)
    {
      last[c] = std::max(last[c], places[static_cast<std::size_t>(mesh.corners[corners * c + k])]);
    }
  }
  std::vector<std::uint32_t> cells(last.size());
  std::iota(cells.begin(), cells.end(), 0U);
  std::ranges::stable_sort(cells, {}, [&](std::uint32_t cell) { return last[cell]; });
  return cells;
}

} // namespace

nlohmann::json orderOfFile(const std::filesystem::path& vsm)
{
  StreamOrderMeasure measure;
  forEachCell(VsmReader(vsm), [&](Corners cell) { measure.append(cell); });
  return json(measure);
}

nlohmann::json orderInCore(const std::filesystem::path& vsm)
{
  const testing::IndexedTestMesh mesh = connectivity(VsmReader(vsm));
  const std::vector<std::uint32_t> order = testing::inCoreBreadthFirst(testing::neighboursOf(mesh));
  std::vector<std::uint32_t> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    places[order[i]] = static_cast<std::uint32_t>(i);
  }

  StreamOrderMeasure measure;
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::vector<std::int64_t> index(order.size(), -1); // by first use, as in a compact stream
  std::int64_t next = 0;
  std::vector<std::int64_t> cell(corners);
  for (const std::uint32_t c : sortedCells(mesh, places))
  {
    for (std::size_t k = 0; k < corners; ++k)
    {
      std::int64_t& known = index[static_cast<std::size_t>(mesh.corners[corners * c + k])];
      known = known < 0 ? next++ : known;
      cell[k] = known;
    }
    measure.append(cell);
  }
  return json(measure);
}

} // namespace smg::benchmark
