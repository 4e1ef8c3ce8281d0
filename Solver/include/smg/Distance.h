// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"
#include "smg/Solve.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** Vertex column with the distance (float64), in the unit of the mesh; infinite where no source is
 * reached. */
inline constexpr const char* DistanceName = "Distance";
/** Vertex column with the number of the nearest source (int64); -1: none. */
inline constexpr const char* DistanceSourceName = "DistanceSource";
/** Vertex column with the place of DistanceDescription::from that the nearest source is of (int32);
 * -1: none. */
inline constexpr const char* DistanceGroupName = "DistanceGroup";
/** Vertex column with the unit gradient of the distance (3 x float64); 0 where there is none. */
inline constexpr const char* DistanceDirectionName = "DistanceDirection";

/** How the lengths of paths on a surface are computed. Those through solids are approximate. */
enum class PathAccuracy : std::uint8_t
{
  Automatic,  ///< exact on surfaces that are known to have at most MaxExactVertices vertices
  Exact,      ///< up to rounding: the shortest paths on the triangles; takes 10 to 50 us a vertex
  Approximate ///< within some 1 % on scans, too long on long thin triangles; about 1 us a vertex
};

/** Up to how many vertices PathAccuracy::Automatic is exact. */
inline constexpr std::int64_t MaxExactVertices = 1'000'000;

/** The largest number of vertices of DistanceDescription::to. */
inline constexpr std::int64_t MaxPaths = 1000;

/** A distance: from what, and which of its results are wanted. */
struct DistanceDescription
{
  /**
   * The sources, at least one: vertices with the distance 0. What selects cells selects their
   * vertices. Of a wall distance they select faces of the boundary; without any, all of it is wall.
   */
  std::vector<Where> from;
  /**
   * Of a tetrahedral mesh: the Euclidean distance to the nearest boundary triangle, through
   * anything, instead of the length of the shortest path within the mesh.
   */
  bool wall = false;
  /**
   * The nearest source of each vertex: the number of a vertex in the original file, or in the
   * stream if the mesh has no column OriginalId. Of a wall distance that of the nearest corner of
   * the nearest triangle.
   */
  bool source = false;
  /**
   * Of which place of `from` the nearest source is: its index, from 0. Of a vertex, or of a face of
   * the wall, that several places select, the first one. Without any place, all of the wall is 0.
   */
  bool group = false;
  /** The unit gradient: where the shortest path comes from, away from the source. 0 at sources. */
  bool direction = false;
  /**
   * Vertices whose shortest paths are wanted, at most MaxPaths: Report::Distance::paths. Paths are
   * those on a surface of exact distances, which Automatic then chooses.
   */
  std::vector<Where> to = {};
  /** Of paths on a surface. */
  PathAccuracy accuracy = PathAccuracy::Automatic;
  /** Of paths, more than 0, in the unit of the mesh: a vertex that is farther counts as not
   * reached. A mesh of which a small part is within takes about the time of that part, and a
   * reading. */
  double within = std::numeric_limits<double>::infinity();
};

/** Whether the distances of a mesh with this description are exact, up to rounding. */
SMG_EXPORT bool isExactDistance(const StreamInfo& mesh, const DistanceDescription& description);

/** How to compute distances. The result depends on `maxPasses` alone. */
struct DistanceOptions
{
  /** Limit of the accounted memory, bytes; more than 0. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  /** Compute threads of a wall distance, at least 1; 0: one a core. */
  int threads = 0;
  /** Largest number of passes over the mesh, at least 1. */
  int maxPasses = 200;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Limit of the bytes of scratch files that exist at once; 0: none. */
  std::int64_t scratchLimit = 0;
  /** Progress callback; empty: none. */
  ProgressFunction progress;
};

/** The columns of the distances of a description: Distance, then DistanceSource,
 * DistanceGroup and DistanceDirection if wanted. Their components are the columns of the Solution.
 */
SMG_EXPORT std::vector<ColumnSpec> distanceColumns(const DistanceDescription& description);

/**
 * Computes the distance of every vertex from sources: along a surface, through a tetrahedral mesh,
 * or to its walls.
 *
 * A front marches through a window of the stream, forwards and backwards until nothing changes:
 * exactly, by the intervals of edges that see one image of a source, or by the eikonal equation
 * |grad d| = 1 (docs/distance.md). The memory grows with the span of the stream, and with the front
 * of exact distances; if the span is not known, the mesh is read once more.
 *
 * @param mesh the mesh; read once, and once more if sources are selected by points, cells or the
 * boundary; of a wall distance read twice or more
 * @param description sources and wanted results
 * @param options memory, scratch files, progress
 * @param name what error messages call the description, for instance its file
 * @return the columns of distanceColumns(); Report::distance has the figures. It keeps its scratch
 * files until it is destroyed.
 * @throws Error if there is no source or a selection is empty or not valid, an option is out of
 * range, the mesh is not valid, the memory limit is below the need (with both figures, and before
 * the mesh is read if its span is known), scratch files would exceed their limit, or one cannot be
 * written or read. Vertices that no source reaches are no error: see Report::Distance::unreached.
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> distance(const StoredMesh& mesh,
  const DistanceDescription& description, const DistanceOptions& options = {},
  const std::string& name = "distance");

} // namespace smg
