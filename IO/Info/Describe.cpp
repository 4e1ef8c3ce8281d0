// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Describe.h"

#include "IO/Info/ColumnSummary.h"
#include "IO/Info/GroupSummary.h"
#include "IO/Info/StreamTopology.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Assembly/Elements.h"
#include "Solver/Core/Text.h"
#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Multigrid/Setup/SliverRows.h"
#include "smg/CellWeights.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

// The description of a mesh, from one reading of its stream. Windows of open vertices hold what is
// needed of the cells so far: positions and bodies (MeshMeasures), and triangles around vertices
// (StreamTopology). All sums run over the cells, or the vertices as they become final, in the order
// of the stream, so that blocks do not change a bit.

namespace smg
{
namespace
{

constexpr PoolUse DescriptionMemory{ "the description of the mesh",
  "raise the memory limit, or convert the mesh with the order bfs if it has another" };

/** Lengths, areas, volumes and quality of cells, and what is wrong with some. */
class ShapeSums
{
public:
  explicit ShapeSums(CellType type)
    : Type(type)
  {
  }

  /** Adds a cell; `flags` are bits of CellFlag. */
  void add(const std::int64_t* corners, unsigned flags, const MeshMeasures& points)
  {
    this->Duplicates += (flags & DuplicateCell) != 0 ? 1 : 0;
    const int count = cornersOf(this->Type);
    if (hasRepeatedCorner(corners, count))
    {
      ++this->Degenerate;
      return;
    }
    const double* at[4] = {};
    for (int k = 0; k < count; ++k)
    {
      at[k] = points.point(corners[k]);
    }
    double lengths[6];
    this->addLengths(at, lengths);
    const CellWeights weights = cellWeights(this->Type, at);
    if ((flags & DegenerateCell) != 0 || weights.measure == 0.0)
    {
      ++this->Degenerate;
      this->Coincident += hasCoincidentCorners(at, count) ? 1 : 0;
      return;
    }
    if (this->Type == CellType::Tetrahedron)
    {
      const auto edge = [&](int k) { return difference(at[k], at[0]); };
      this->Inverted += dot(edge(1), cross(edge(2), edge(3))) < 0.0 ? 1 : 0;
    }
    if (flags == 0)
    {
      this->addQuality(at, lengths, weights);
    }
  }

  /** Passes on the sums. */
  void finish(MeshDescription& description) const
  {
    description.degenerate_cells = this->Degenerate;
    description.coincident_cells = this->Coincident;
    description.duplicate_cells = this->Duplicates;
    description.inverted_cells = this->Inverted;
    if (this->Longest >= this->Shortest)
    {
      description.edge_length.minimum = this->Shortest;
      description.edge_length.maximum = this->Longest;
    }
    (this->Type == CellType::Triangle ? description.area : description.volume) = this->Size;
    if (this->Weighted > 0)
    {
      description.quality = { this->WorstQuality,
        this->SumOfQuality / static_cast<double>(this->Weighted), this->Slivers, this->Scaled };
    }
    if (this->Type == CellType::Tetrahedron)
    {
      const std::int64_t solid = description.cells - this->Degenerate;
      description.consistently_wound = this->Inverted == 0 || this->Inverted == solid;
    }
  }

private:
  void addLengths(const double* const* points, double* lengths)
  {
    for (int e = 0; e < edgesOf(this->Type); ++e)
    {
      const int* ends = edgeCorners(this->Type, e);
      const Vector edge = difference(points[ends[0]], points[ends[1]]);
      lengths[e] = std::sqrt(dot(edge, edge));
      this->Shortest = std::min(this->Shortest, lengths[e]);
      this->Longest = std::max(this->Longest, lengths[e]);
    }
  }

  /** Adds size and quality of a cell with weight. */
  void addQuality(const double* const* points, const double* lengths, const CellWeights& weights)
  {
    double squares = 0.0;
    for (int e = 0; e < edgesOf(this->Type); ++e)
    {
      squares += lengths[e] * lengths[e];
    }
    const double root = std::cbrt(3.0 * weights.measure);
    const double quality = this->Type == CellType::Triangle
                             ? 4.0 * std::numbers::sqrt3 * weights.measure / squares
                             : 12.0 * root * root / squares;
    ++this->Weighted;
    this->Size += weights.measure;
    this->SumOfQuality += quality;
    this->WorstQuality = std::min(this->WorstQuality, quality);
    this->Slivers += this->isSliver(lengths, weights) ? 1 : 0;
    this->Scaled += flatnessFactor(this->Type, points, weights) < 1.0 ? 1 : 0;
  }

  /** By the weight that makes the rows of triangles stiff, half the cotangent of an angle. That of
   * a tetrahedron is a third of it, times the length of the edge opposite, which comes last from
   * the other end in the list of edges. */
  bool isSliver(const double* lengths, const CellWeights& weights) const
  {
    const int edges = edgesOf(this->Type);
    for (int e = 0; e < edges; ++e)
    {
      const double unit = this->Type == CellType::Triangle ? 1.0 : lengths[edges - 1 - e] / 3.0;
      if (weights.weight[e] < SliverRows::Triangles * unit)
      {
        return true;
      }
    }
    return false;
  }

  CellType Type;
  double Shortest = std::numeric_limits<double>::infinity(), Longest = 0.0;
  double Size = 0.0; ///< sum of areas or volumes
  double WorstQuality = 1.0, SumOfQuality = 0.0;
  std::int64_t Weighted = 0; ///< cells that count for these
  std::int64_t Degenerate = 0, Coincident = 0, Duplicates = 0, Inverted = 0, Slivers = 0,
               Scaled = 0;
};

/** Describes a mesh stream that comes block by block. */
class Describer
{
public:
  Describer(const StreamInfo& info, std::int64_t memoryLimit)
    : Info(info)
    , Memory(memoryLimit, DescriptionMemory)
    , Check(info.cellType)
    // As the topology, which tells whether they enclose a volume.
    , Measures(this->Memory, info.cellType, true)
    , Topology(this->Memory, info.cellType)
    , Shapes(info.cellType)
    , Groups(info)
    , VertexColumns(info.vertexColumns.begin(), info.vertexColumns.end())
    , CellColumns(info.cellColumns.begin(), info.cellColumns.end())
  {
  }

  void add(const MeshBlock& block)
  {
    this->Check.add(block);
    this->Measures.add(block);
    this->Topology.extend(this->Check.vertices());
    const std::ptrdiff_t groups = findColumn(
      block.cellColumns, MeshGroups::columnSpec(GroupOf::Cells, cornersOf(this->Info.cellType)));
    const std::span<const GroupSet> sets =
      groups < 0 ? std::span<const GroupSet>()
                 : block.cellColumns[static_cast<std::size_t>(groups)].as<GroupSet>();
    forAllCells(this->Info.cellType, block,
      [&](const std::int64_t* corners, unsigned flags, std::size_t c)
      {
        this->Shapes.add(corners, flags, this->Measures);
        if (!hasRepeatedCorner(corners, cornersOf(this->Info.cellType)))
        {
          this->Topology.add(corners, sets.empty() ? GroupSet(0) : sets[c]);
        }
      });
    this->Groups.add(block, this->Measures);
    this->Topology.close(block.finalized, this->Measures);
    for (std::size_t k = 0; k < this->VertexColumns.size(); ++k)
    {
      this->VertexColumns[k].add(block.vertexColumns[k]);
    }
    for (std::size_t k = 0; k < this->CellColumns.size(); ++k)
    {
      this->CellColumns[k].add(block.cellColumns[k]);
    }
  }

  MeshDescription finish()
  {
    this->Check.finish(this->Info);
    this->Topology.close(this->Check.vertices(), this->Measures);
    this->Measures.finish();
    MeshDescription description;
    description.cell_type = this->Info.cellType;
    description.vertices = this->Check.vertices();
    description.cells = this->Check.cells();
    this->Shapes.finish(description);
    this->finishTopology(description);
    this->finishExtent(description);
    for (const ColumnSummary& column : this->VertexColumns)
    {
      description.vertex_columns.push_back(column.result());
    }
    for (const ColumnSummary& column : this->CellColumns)
    {
      description.cell_columns.push_back(column.result());
    }
    description.groups = this->Groups.result();
    description.pool_bytes_peak = this->Memory.peak();
    if (std::string note =
          unweldedNote(this->Info.cellType, description.vertices, description.cells);
        !note.empty())
    {
      description.notes.push_back(std::move(note));
    }
    else
    {
      this->noteCoincidentFaces(description);
    }
    return description;
  }

private:
  void finishTopology(MeshDescription& description) const
  {
    const TopologyCounts& counts = this->Topology.counts();
    description.isolated_vertices = this->Measures.isolated();
    description.bodies = this->Measures.bodies();
    description.largest_body = this->Measures.largestBody();
    description.boundary_facets = counts.boundaryFacets;
    description.boundary_parts = counts.boundaryParts;
    description.nonmanifold_facets = counts.nonManifoldFacets;
    description.nonmanifold_edges = counts.nonManifoldEdges;
    description.nonmanifold_vertices = counts.nonManifoldVertices;
    if (this->Info.cellType == CellType::Tetrahedron)
    {
      description.area = counts.boundarySize;
      return;
    }
    description.boundary_length = counts.boundarySize;
    description.turned_edges = counts.turnedEdges;
    description.closed = counts.boundaryFacets == 0 && description.cells > 0;
    description.consistently_wound = counts.turnedEdges == 0;
    const bool encloses = description.closed && counts.unbalancedEdges == 0;
    description.volume = encloses ? this->Measures.volume() : std::nan("");
    description.turned_volume = encloses ? this->Measures.turnedVolume() : std::nan("");
  }

  /** Interfaces of which two bodies have a copy each: they are connected nowhere there. */
  void noteCoincidentFaces(MeshDescription& description) const
  {
    const StreamTopology::CoincidentFaces faces = this->Topology.coincidentFaces();
    description.coincident_facets = faces.count;
    if (faces.count == 0)
    {
      return;
    }
    const auto nameOfSet = [this](std::int32_t set)
    {
      std::vector<std::string> names;
      for (const std::uint32_t group : this->Info.groups.sets[static_cast<std::size_t>(set)])
      {
        names.push_back('\'' + this->Info.groups.groups[group].label() + '\'');
      }
      return names.empty() ? std::string("cells of no group") : listed(names, "and");
    };
    std::string between;
    for (const auto& [sets, places] : faces.places)
    {
      if (!this->Info.groups.empty())
      {
        between += (between.empty() ? ": " : "; ") + std::to_string(places) + " between " +
                   nameOfSet(sets.first) + " and " + nameOfSet(sets.second);
      }
    }
    description.notes.push_back(
      std::string(faces.isExact ? "" : "About ") + std::to_string(faces.count) +
      " faces of the boundary lie on others" + between +
      ": bodies are not connected there, unless these points are merged (option --weld).");
  }

  void finishExtent(MeshDescription& description) const
  {
    description.edge_length.mean = this->Measures.meanEdge();
    description.diagonal = this->Measures.diagonal();
    double largest = 0.0;
    for (std::size_t k = 0; k < 3 && description.vertices > 0; ++k)
    {
      const double low = this->Measures.low()[k], high = this->Measures.high()[k];
      description.bounds[2 * k] = low;
      description.bounds[2 * k + 1] = high;
      largest = std::max({ largest, std::fabs(low), std::fabs(high) });
    }
    if (description.diagonal > 0.0)
    {
      // Half a unit in the last place of the largest coordinate, relative to the diagonal.
      const double rounding = this->Info.doublePositions ? 0x1p-53 : 0x1p-24;
      description.resolution.offset = largest / description.diagonal;
      description.resolution.digits = -std::log10(rounding * description.resolution.offset);
    }
  }

  const StreamInfo& Info;
  Pool Memory;
  StreamCheck Check;
  MeshMeasures Measures;
  StreamTopology Topology;
  ShapeSums Shapes;
  GroupSummary Groups;
  std::vector<ColumnSummary> VertexColumns, CellColumns;
};

} // namespace

MeshDescription describe(const StoredMesh& mesh, const DescribeOptions& options)
{
  const StreamInfo& info = mesh.info();
  const auto source = mesh.source(columnNames(info.vertexColumns), columnNames(info.cellColumns));
  Describer describer(source->info(), options.memoryLimit);
  visitBlocks(*source, options.progress, 0.0, 1.0,
    [&describer](const MeshBlock& block) { describer.add(block); });
  MeshDescription description = describer.finish();
  if (const std::filesystem::path file = mesh.file(); !file.empty())
  {
    description.isolated_vertices +=
      VsmReader(file, nullptr, mesh.fileFingerprint()).isolatedVertices();
  }
  return description;
}

} // namespace smg
