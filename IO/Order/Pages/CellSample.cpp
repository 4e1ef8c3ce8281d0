// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/CellSample.h"

#include "IO/Order/Pages/RawMeshPass.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace smg
{

namespace
{

/** The numbers of the cells, ascending. */
std::vector<std::int64_t> chooseCells(std::int64_t cells)
{
  const std::int64_t count = std::min(cells, CellSample::Most);
  std::vector<std::int64_t> chosen(static_cast<std::size_t>(count));
  // Not at equal strides, which could coincide with the rows of a grid.
  std::mt19937_64 random(1);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t begin = cells * i / count, end = cells * (i + 1) / count;
    chosen[std::size_t(i)] =
      begin + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end - begin));
  }
  return chosen;
}

template <class Real>
void fillPositions(const RawMesh& mesh, CellSample& sample)
{
  std::vector<std::uint32_t> places(sample.vertices.size());
  std::iota(places.begin(), places.end(), 0u);
  std::sort(places.begin(), places.end(),
    [&sample](std::uint32_t a, std::uint32_t b)
    { return sample.vertices[a] < sample.vertices[b]; });
  sample.positions.resize(places.size());
  auto next = places.begin();
  forEachVertex<Real>(mesh,
    [&](std::uint32_t vertex, const Real* position)
    {
      for (; next != places.end() && sample.vertices[*next] == vertex; ++next)
      {
        std::copy_n(position, 3, sample.positions[*next].begin());
      }
    });
}

} // namespace

std::vector<std::size_t> CellSample::differentVertices() const
{
  std::vector<std::size_t> places(this->cells());
  for (std::size_t cell = 0; cell < places.size(); ++cell)
  {
    places[cell] = cell * this->corners + cell % this->corners;
  }
  const auto vertexAt = [this](std::size_t place) { return this->vertices[place]; };
  std::ranges::sort(places, {}, vertexAt);
  const auto repeated = std::unique(places.begin(), places.end(),
    [&](std::size_t a, std::size_t b) { return vertexAt(a) == vertexAt(b); });
  places.erase(repeated, places.end());
  return places;
}

CellSample sampleCells(const RawMesh& mesh)
{
  CellSample sample;
  sample.corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const std::vector<std::int64_t> chosen = chooseCells(mesh.cells);
  const auto corners = static_cast<std::int64_t>(sample.corners);
  std::int64_t first = 0;
  auto next = chosen.begin();
  forEachStretch(mesh.corners, sample.corners,
    [&](std::span<const std::uint32_t> stretch)
    {
      const std::int64_t end = first + static_cast<std::int64_t>(stretch.size()) / corners;
      for (; next != chosen.end() && *next < end; ++next)
      {
        const auto cell =
          stretch.subspan(static_cast<std::size_t>((*next - first) * corners), sample.corners);
        sample.vertices.insert(sample.vertices.end(), cell.begin(), cell.end());
      }
      first = end;
    });
  mesh.doublePositions ? fillPositions<double>(mesh, sample) : fillPositions<float>(mesh, sample);
  return sample;
}

} // namespace smg
