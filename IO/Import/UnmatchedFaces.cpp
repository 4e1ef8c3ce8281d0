// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/UnmatchedFaces.h"

#include "IO/External/ExternalSort.h"
#include "Solver/Core/DisjointSets.h"
#include "Solver/Core/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

// Where two bodies with different triangles on the face between them are welded, that face stays a
// crack: at a merged vertex, boundary faces of both sides lie upon each other. Two faces do if
// their outward normals are opposite, their angles at the vertex overlap, and each has the
// tetrahedron of the other one on its outer side; the last condition tells a crack from the thin
// edge of a body.
//
// A narrow notch, too, has such faces, and the two sides of a curved contact lie upon each other
// only roughly. The faces at a vertex form fans, in which neighbours share an edge that no third
// face has. The sides of a notch are in one fan, those of a contact in two, since at the rim four
// faces meet or the edges differ. So normals may differ by 20 degrees between fans, but by a
// thousandth within one, where only triangles that differ inside of a contact remain.
//
// Cost: faces of cells with a merged vertex are sorted by their corners, those of one cell get the
// positions of their corners in two more sorts, and are sorted by their merged vertices. Of a mesh
// whose cells all have vertices of their own these are all of the faces, else those at contacts.

namespace smg
{
namespace
{

/** A face of a cell: its corners in ascending order, and the corner of the cell opposite to it. */
using CellFace = std::array<std::uint32_t, 4>;

/** A corner of a boundary face, or its position: `place` is four times the number of the face and
 * the number of the corner. */
struct FaceCorner
{
  std::uint64_t vertex, place;
  auto operator<=>(const FaceCorner&) const = default;
};
struct LocatedCorner
{
  std::uint64_t place;
  Vector position;
  auto operator<=>(const LocatedCorner&) const = default;
};

/** A boundary face at one of its vertices: the other corners, and the edges to them and to the
 * corner of the cell that is opposite to the face. */
struct FaceAtVertex
{
  std::uint64_t vertex, face;
  std::array<std::uint32_t, 2> others;
  std::array<Vector, 2> edges;
  Vector opposite;
  auto operator<=>(const FaceAtVertex&) const = default;
};

double lengthOf(const Vector& a)
{
  return std::sqrt(dot(a, a));
}

/** The plane of a face at a vertex. */
struct FacePlane
{
  Vector normal, first, second; ///< outward; along the first edge; towards the second one
  double angle;                 ///< between the edges
};

/** None of faces without an area or a volume. */
std::optional<FacePlane> planeOf(const FaceAtVertex& face)
{
  const Vector normal = cross(face.edges[0], face.edges[1]);
  const double area = lengthOf(normal), height = dot(normal, face.opposite);
  if (!(area > 0.0) || height == 0.0)
  {
    return std::nullopt;
  }
  FacePlane plane;
  plane.normal = scaled((height > 0.0 ? -1.0 : 1.0) / area, normal);
  plane.first = scaled(1.0 / lengthOf(face.edges[0]), face.edges[0]);
  plane.second = cross(scaled(1.0 / area, normal), plane.first);
  plane.angle = std::atan2(area, dot(face.edges[0], face.edges[1]));
  return plane;
}

/** Whether the angle of the face, projected to the plane, overlaps that of the plane. */
bool anglesOverlap(const FacePlane& plane, const FaceAtVertex& face)
{
  constexpr double Turn = 2.0 * std::numbers::pi, Least = 1e-3;
  double angles[2];
  for (std::size_t k = 0; k < 2; ++k)
  {
    angles[k] = std::atan2(dot(plane.second, face.edges[k]), dot(plane.first, face.edges[k]));
  }
  if (angles[0] > angles[1])
  {
    std::swap(angles[0], angles[1]);
  }
  if (angles[1] - angles[0] > Turn / 2.0)
  {
    angles[0] = std::exchange(angles[1], angles[0] + Turn);
  }
  const auto overlap = [&](double turn)
  { return std::min(plane.angle, angles[1] + turn) - std::max(0.0, angles[0] + turn); };
  return std::max({ overlap(-Turn), overlap(0.0), overlap(Turn) }) > Least;
}

/** The faces at a vertex, of which those that lie upon others are found. */
class FacesAtVertex
{
public:
  /** No mesh for computations has more; what is beyond them is not compared. */
  static constexpr std::size_t Most = 1024;

  void add(const FaceAtVertex& face)
  {
    const std::optional<FacePlane> plane = planeOf(face);
    if (plane && this->Faces.size() < Most)
    {
      this->Faces.push_back(face);
      this->Planes.push_back(*plane);
    }
  }

  /** Calls take(face) for the number of each face that lies upon another one; forgets all. */
  template <class Take>
  void finish(Take&& take)
  {
    const std::size_t count = this->Faces.size();
    DisjointSets<std::uint32_t> fans = this->fans();
    std::vector<std::uint8_t> found(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      for (std::uint32_t j = 0; j < i; ++j)
      {
        if (this->lieUpon(i, j, fans.first(i) == fans.first(j)))
        {
          found[i] = found[j] = 1;
        }
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (found[i] != 0)
      {
        take(this->Faces[i].face);
      }
    }
    this->Faces.clear();
    this->Planes.clear();
  }

private:
  /** Joins faces that have an edge which no third one has. */
  DisjointSets<std::uint32_t> fans() const
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges; // and their faces
    for (std::uint32_t i = 0; i < this->Faces.size(); ++i)
    {
      for (const std::uint32_t other : this->Faces[i].others)
      {
        edges.emplace_back(other, i);
      }
    }
    std::ranges::sort(edges);
    DisjointSets<std::uint32_t> sets(this->Faces.size());
    for (auto first = edges.begin(); first != edges.end();)
    {
      const auto last = std::find_if(
        first, edges.end(), [&](const auto& edge) { return edge.first != first->first; });
      if (last - first == 2)
      {
        sets.join(first->second, (first + 1)->second);
      }
      first = last;
    }
    return sets;
  }

  bool lieUpon(std::size_t i, std::size_t j, bool inOneFan) const
  {
    const double cosine = inOneFan ? std::cos(1e-3) : std::cos(std::numbers::pi / 9.0);
    const FaceAtVertex &a = this->Faces[i], &b = this->Faces[j];
    const FacePlane &ofA = this->Planes[i], &ofB = this->Planes[j];
    return dot(ofA.normal, ofB.normal) < -cosine &&
           dot(ofA.normal, b.opposite) > 1e-9 * lengthOf(b.opposite) &&
           dot(ofB.normal, a.opposite) > 1e-9 * lengthOf(a.opposite) && anglesOverlap(ofA, b);
  }

  std::vector<FaceAtVertex> Faces;
  std::vector<FacePlane> Planes;
};

/** The faces at joined vertices that one cell has. */
RecordFile<CellFace> boundaryFaces(
  const RawMesh& mesh, const VertexFilter& joined, Workspace& workspace)
{
  ExternalSort<CellFace> faces(workspace, workspace.available() / 2);
  RecordFile<std::uint32_t>::Reader cells(mesh.corners);
  for (CellFace cell{}; cells.next(std::span(cell));)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      CellFace face = cell;
      std::swap(face[k], face[3]);
      std::sort(face.begin(), face.begin() + 3);
      if (std::any_of(face.begin(), face.begin() + 3, [&](auto v) { return joined.has(v); }))
      {
        faces.put(face);
      }
    }
  }
  faces.sort();
  RecordFile<CellFace> boundary(workspace);
  CellFace face{}, next{};
  for (bool has = faces.next(next); has;)
  {
    face = next;
    int copies = 0;
    for (; has && std::equal(face.begin(), face.begin() + 3, next.begin()); ++copies)
    {
      has = faces.next(next);
    }
    if (copies == 1)
    {
      boundary.put(face);
    }
  }
  boundary.close();
  return boundary;
}

/** Calls take(position) for each vertex. */
template <class Real, class Take>
void visitPositions(const RawMesh& mesh, Take&& take)
{
  BucketFile::Reader positions(mesh.positions);
  for (std::array<Real, 3> point{}; positions.get(point);)
  {
    take(Vector{ point[0], point[1], point[2] });
  }
}

/** Sorts the corners of the faces, with their positions, by faces. */
void placeFaceCorners(const RawMesh& mesh, const RecordFile<CellFace>& faces, Workspace& workspace,
  ExternalSort<LocatedCorner>& placed)
{
  ExternalSort<FaceCorner> corners(workspace, workspace.available() / 2);
  RecordFile<CellFace>::Reader reader(faces);
  std::uint64_t place = 0;
  for (CellFace face{}; reader.next(face);)
  {
    for (const std::uint32_t vertex : face)
    {
      corners.put({ vertex, place++ });
    }
  }
  corners.sort();
  FaceCorner corner{};
  bool has = corners.next(corner);
  auto take = [&, vertex = std::uint64_t(0)](const Vector& position) mutable
  {
    for (; has && corner.vertex == vertex; has = corners.next(corner))
    {
      placed.put({ corner.place, position });
    }
    ++vertex;
  };
  mesh.doublePositions ? visitPositions<double>(mesh, take) : visitPositions<float>(mesh, take);
  placed.sort();
}

/** Sorts the faces by their joined vertices. */
void placeFaces(const RecordFile<CellFace>& faces, ExternalSort<LocatedCorner>& placed,
  const VertexFilter& joined, ExternalSort<FaceAtVertex>& atVertices)
{
  RecordFile<CellFace>::Reader reader(faces);
  std::uint64_t number = 0;
  for (CellFace face{}; reader.next(face); ++number)
  {
    std::array<LocatedCorner, 4> corners{};
    for (LocatedCorner& corner : corners)
    {
      placed.next(corner);
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      if (joined.has(face[k]))
      {
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        const auto edge = [&](std::size_t to)
        { return difference(corners[to].position.data(), corners[k].position.data()); };
        atVertices.put({ face[k], number, { face[a], face[b] }, { edge(a), edge(b) }, edge(3) });
      }
    }
  }
  atVertices.sort();
}

} // namespace

std::int64_t unmatchedFaces(const RawMesh& mesh, const VertexFilter& joined, Workspace& workspace)
{
  const RecordFile<CellFace> faces = boundaryFaces(mesh, joined, workspace);
  const std::int64_t memory = workspace.available() / 4;
  ExternalSort<FaceAtVertex> atVertices(workspace, memory);
  {
    ExternalSort<LocatedCorner> placed(workspace, memory);
    placeFaceCorners(mesh, faces, workspace, placed);
    placeFaces(faces, placed, joined, atVertices);
  }
  ExternalSort<std::uint64_t> found(workspace, memory);
  const auto take = [&found](std::uint64_t face) { found.put(face); };
  FacesAtVertex atVertex;
  FaceAtVertex face{};
  for (std::uint64_t vertex = 0; atVertices.next(face);)
  {
    if (face.vertex != vertex)
    {
      atVertex.finish(take);
      vertex = face.vertex;
    }
    atVertex.add(face);
  }
  atVertex.finish(take);
  found.sort();
  std::int64_t count = 0;
  for (std::uint64_t number = 0, last = UINT64_MAX; found.next(number); last = number)
  {
    count += number != last ? 1 : 0;
  }
  return count;
}

} // namespace smg
