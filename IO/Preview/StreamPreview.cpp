// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/StreamPreview.h"

#include "IO/Preview/ClusterGrid.h"
#include "IO/Preview/OpenFaces.h"

#include <algorithm>
#include <deque>

namespace smg
{
namespace
{

/** The vertices that a cell to come may use, and the clusters they belong to. */
class PreviewBuilder
{
public:
  PreviewBuilder(const StreamInfo& info, std::int64_t maximumPoints)
    : Type(info.cellType)
    , Grid(info.bounds, maximumPoints)
  {
  }

  void add(const MeshBlock& block)
  {
    for (std::size_t i = 0; i < block.positions.size(); i += 3)
    {
      this->Window.push_back(
        { { block.positions[i], block.positions[i + 1], block.positions[i + 2] }, -1, -1 });
    }
    const std::size_t corners = cornersOf(this->Type);
    for (std::size_t i = 0; i + corners <= block.corners.size(); i += corners)
    {
      if (this->Type == CellType::Triangle)
      {
        this->triangle({ block.corners[i], block.corners[i + 1], block.corners[i + 2] });
      }
      else
      {
        this->Faces.add(std::span<const std::int64_t, 4>(block.corners.data() + i, 4));
      }
    }
    // Looking through all open faces pays when there are many more of them than last time.
    if (this->Type == CellType::Triangle || this->Faces.size() > 2 * this->FacesKept + 100000)
    {
      this->forgetBelow(block.finalized);
    }
  }

  StreamPreview finish()
  {
    this->forgetBelow(this->First + static_cast<std::int64_t>(this->Window.size()));
    return this->collect();
  }

private:
  struct Vertex
  {
    std::array<double, 3> point;
    int cluster;
    int generation;
  };

  int clusterOf(std::int64_t id)
  {
    Vertex& vertex = this->Window[id - this->First];
    if (vertex.generation != this->Grid.generation())
    {
      vertex.cluster = this->Grid.cluster(id, vertex.point);
      vertex.generation = this->Grid.generation();
    }
    return vertex.cluster;
  }

  void triangle(const OpenFaces::Face& face)
  {
    const int a = this->clusterOf(face[0]);
    const int b = this->clusterOf(face[1]);
    const int c = this->clusterOf(face[2]);
    this->Grid.addTriangle(a, b, c);
  }

  void forgetBelow(std::int64_t finalized)
  {
    this->Faces.closeBelow(
      finalized, [this](const OpenFaces::Face& face) { this->triangle(face); });
    this->FacesKept = this->Faces.size();
    const auto forgotten = std::clamp<std::int64_t>(
      finalized - this->First, 0, static_cast<std::int64_t>(this->Window.size()));
    this->Window.erase(this->Window.begin(), this->Window.begin() + forgotten);
    this->First += forgotten;
  }

  /** The clusters that triangles use, by ascending stream index. */
  StreamPreview collect() const
  {
    const auto& clusters = this->Grid.clusters();
    std::vector<char> isUsed(clusters.size(), 0);
    for (const auto& triangle : this->Grid.triangles())
    {
      for (const int cluster : triangle)
      {
        isUsed[cluster] = 1;
      }
    }
    std::vector<int> order;
    for (std::size_t i = 0; i < clusters.size(); ++i)
    {
      if (isUsed[i])
      {
        order.push_back(static_cast<int>(i));
      }
    }
    std::sort(order.begin(), order.end(),
      [&clusters](int a, int b) { return clusters[a].id < clusters[b].id; });
    StreamPreview preview;
    std::vector<std::int64_t> number(clusters.size(), -1);
    for (const int cluster : order)
    {
      number[cluster] = static_cast<std::int64_t>(preview.ids.size());
      preview.ids.push_back(clusters[cluster].id);
      const auto& point = clusters[cluster].point;
      preview.positions.insert(preview.positions.end(), point.begin(), point.end());
    }
    for (const auto& [a, b, c] : this->Grid.triangles())
    {
      preview.triangles.insert(preview.triangles.end(), { number[a], number[b], number[c] });
    }
    return preview;
  }

  CellType Type;
  ClusterGrid Grid;
  OpenFaces Faces;
  std::size_t FacesKept = 0;
  std::deque<Vertex> Window;
  std::int64_t First = 0; ///< stream index of the window's first vertex
};

} // namespace

StreamPreview makePreview(
  MeshSource& mesh, std::int64_t maximumPoints, const ProgressFunction& progress)
{
  Progress done(progress);
  PreviewBuilder builder(mesh.info(), maximumPoints);
  const double cells = static_cast<double>(std::max<std::int64_t>(mesh.info().cells, 1));
  const int corners = cornersOf(mesh.info().cellType);
  MeshBlock block;
  while (mesh.next(block))
  {
    builder.add(block);
    const double cell = static_cast<double>(block.firstCell) + block.corners.size() / corners;
    done.update(cell / cells);
  }
  done.update(1.0);
  return builder.finish();
}

} // namespace smg
