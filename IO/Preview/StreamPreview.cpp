// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/StreamPreview.h"

#include "IO/Preview/ClusterGrid.h"
#include "IO/Preview/KeptRows.h"
#include "IO/Preview/OpenFaces.h"
#include "Solver/Core/Progress.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <unordered_set>

namespace smg
{
namespace
{

/** The vertices that a later cell may use, and their clusters. */
class PreviewBuilder
{
public:
  PreviewBuilder(const StreamInfo& info, ClusterGrid grid)
    : Type(info.cellType)
    , Grid(std::move(grid))
    , Rows(info.vertexColumns)
  {
  }

  void add(const MeshBlock& block)
  {
    this->Rows.take(block);
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
    // Scanning all open faces is only worthwhile if there are many more of them than last time.
    if (this->Type == CellType::Triangle || this->Faces.size() > 2 * this->FacesKept + 100000)
    {
      this->forgetBelow(block.finalized);
    }
  }

  MeshPiece finish()
  {
    this->forgetBelow(this->First + static_cast<std::int64_t>(this->Window.size()));
    this->Grid.finish();
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
      if (this->Grid.clusters()[vertex.cluster].id == id)
      {
        this->Rows.keep(id);
        this->thinRows();
      }
    }
    return vertex.cluster;
  }

  using Vector = std::array<double, 3>;

  /** The area-weighted normal of a triangle. */
  static Vector normalOf(const Vector& a, const Vector& b, const Vector& c)
  {
    const double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
    const double v[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
    return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
  }
  Vector normalOf(const OpenFaces::Face& face) const
  {
    const auto point = [&](std::size_t k) -> const Vector&
    { return this->Window[face[k] - this->First].point; };
    return normalOf(point(0), point(1), point(2));
  }

  /** Whether the orientation of the triangle of these clusters is opposite to that of the mesh. */
  bool isTurned(const std::array<int, 3>& triangle) const
  {
    const auto cluster = [&](int k) -> const ClusterGrid::Representative&
    { return this->Grid.clusters()[triangle[k]]; };
    const Vector own = normalOf(cluster(0).point, cluster(1).point, cluster(2).point);
    double along = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vector& normal = cluster(k).normal;
      along += std::inner_product(own.begin(), own.end(), normal.begin(), 0.0);
    }
    return along < 0.0;
  }

  void triangle(const OpenFaces::Face& face)
  {
    // A corner that coarsens the grid invalidates the clusters of the others.
    std::array<int, 3> clusters{};
    for (int generation = -1; generation != this->Grid.generation();)
    {
      generation = this->Grid.generation();
      for (std::size_t k = 0; k < 3; ++k)
      {
        clusters[k] = this->clusterOf(face[k]);
      }
    }
    this->Grid.addTriangle(clusters[0], clusters[1], clusters[2], this->normalOf(face));
  }

  /** Releases the rows of vertices that no longer represent their cluster, once there are many. */
  void thinRows()
  {
    const auto& clusters = this->Grid.clusters();
    if (this->Rows.size() < 2 * clusters.size() + 1000)
    {
      return;
    }
    std::unordered_set<std::int64_t> present;
    for (const ClusterGrid::Representative& cluster : clusters)
    {
      present.insert(cluster.id);
    }
    this->Rows.thin([&present](std::int64_t id) { return present.count(id) > 0; });
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
    this->Rows.forgetBelow(this->First);
  }

  /** The clusters that triangles use, by ascending stream index. */
  MeshPiece collect() const
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
    MeshPiece preview;
    std::vector<std::int64_t> number(clusters.size(), -1);
    for (const int cluster : order)
    {
      number[cluster] = static_cast<std::int64_t>(preview.ids.size());
      preview.ids.push_back(clusters[cluster].id);
      const auto& point = clusters[cluster].point;
      preview.positions.insert(preview.positions.end(), point.begin(), point.end());
      const auto& normal = clusters[cluster].normal;
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      for (const double component : normal)
      {
        preview.normals.push_back(length > 0.0 ? static_cast<float>(component / length) : 0.0F);
      }
    }
    for (const auto& [a, b, c] : this->Grid.triangles())
    {
      // The triangle of the representatives may have the opposite orientation.
      const bool isTurned = this->isTurned({ a, b, c });
      preview.corners.insert(
        preview.corners.end(), { number[a], number[isTurned ? c : b], number[isTurned ? b : c] });
    }
    preview.vertexColumns = this->Rows.gather(preview.ids);
    preview.ghost.assign(preview.ids.size(), 0);
    preview.finalized.assign(preview.ids.size(), 1);
    return preview;
  }

  CellType Type;
  ClusterGrid Grid;
  KeptRows Rows;
  OpenFaces Faces;
  std::size_t FacesKept = 0;
  std::deque<Vertex> Window;
  std::int64_t First = 0; ///< stream index of the window's first vertex
};

/** The box of the block's vertices. */
std::array<double, 6> boundsOf(const MeshBlock& block)
{
  std::array<double, 6> bounds{};
  for (std::size_t axis = 0; axis < 3 && !block.positions.empty(); ++axis)
  {
    double& low = bounds[2 * axis] = block.positions[axis];
    double& high = bounds[2 * axis + 1] = block.positions[axis];
    for (std::size_t i = axis; i < block.positions.size(); i += 3)
    {
      low = std::min(low, block.positions[i]);
      high = std::max(high, block.positions[i]);
    }
  }
  return bounds;
}

} // namespace

MeshPiece makePreview(
  MeshSource& mesh, std::int64_t maximumPoints, const ProgressFunction& progress)
{
  Progress done(progress);
  const StreamInfo& info = mesh.info();
  MeshBlock block;
  bool isBlock = mesh.next(block);
  const bool isKnown = info.bounds != std::array<double, 6>{};
  PreviewBuilder builder(
    info, ClusterGrid(isKnown ? info.bounds : boundsOf(block), maximumPoints, !isKnown));
  for (; isBlock; isBlock = mesh.next(block))
  {
    builder.add(block);
    if (info.cells > 0)
    {
      const double cell =
        static_cast<double>(block.firstCell) + block.corners.size() / cornersOf(info.cellType);
      done.update(cell / static_cast<double>(info.cells));
    }
  }
  done.update(1.0);
  return builder.finish();
}

std::string emptyPreview(std::int64_t maximumPoints)
{
  return "a preview of at most " + std::to_string(maximumPoints) +
         " points shows nothing of this mesh: every triangle shrinks to an edge or a point.";
}

} // namespace smg
