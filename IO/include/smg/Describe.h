// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/Groups.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace smg
{

/** How to describe a mesh. */
struct DescribeOptions
{
  /** Limit of the accounted memory, bytes; more than 0. About 350 bytes of a surface, 200 of a
   * solid are needed for each vertex that is open at once: in a stream order, about its width. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  /** Progress callback; empty: none. */
  ProgressFunction progress;
};

/**
 * What describe() finds. Every cell with distinct corners counts for the numbers of facets, edges
 * and vertices, duplicates, too, as in ConversionReport; for lengths, areas, volumes and the
 * quality only those with weight, as in a solve: those that are not degenerate and that CellFlags
 * does not mark.
 */
struct SMG_EXPORT MeshDescription
{
  /** A value of a column, in the widest type of its kind; none: there is no finite one. */
  using Number = std::variant<std::monostate, std::int64_t, std::uint64_t, double>;
  /** A column of integers has tags if it has one component and at most so many different values. */
  static constexpr std::size_t MostTags = 64;

  /** A value of a column and how often it occurs. */
  struct Tag
  {
    Number value;           ///< of the column
    std::int64_t count = 0; ///< tuples with this value
  };
  /** What values a column has. */
  struct Column
  {
    ColumnSpec spec;             ///< name and type
    std::vector<Number> minimum; ///< least finite value of each component
    std::vector<Number> maximum; ///< greatest finite value of each component
    std::int64_t not_finite = 0; ///< values that are infinite or not a number
    std::vector<Tag> tags;       ///< ascending; empty: it has none
  };
  /** A group and how large it is. */
  struct Group
  {
    smg::Group group;       ///< its name, number and kind
    std::int64_t count = 0; ///< of its vertices, facets or cells; of cells those with weight
    double measure = 0;     ///< their length, area or volume; 0 of vertices
  };
  /** The lengths of the edges, in the unit of the mesh; 0 without any. */
  struct EdgeLength
  {
    double minimum = 0; ///< of all cells with distinct corners
    double mean = 0;    ///< each edge for each of its cells: the unit of SmoothingSize::MeanEdges
    double maximum = 0; ///< of all cells with distinct corners
  };
  /**
   * The mean ratio of the cells, 1 for regular ones and near 0 for flat ones: 4 sqrt(3) A / sum l^2
   * of triangles and 12 (3 V)^(2/3) / sum l^2 of tetrahedra, with the lengths l of all edges (Liu
   * and Joe, Relationship between tetrahedron shape measures, 1994).
   */
  struct Quality
  {
    double minimum = 0; ///< 0 without cells
    double mean = 0;    ///< 0 without cells
    /** Cells with an angle, of tetrahedra a dihedral one, of more than 166 degrees: the vertices of
     * such triangles are stiff, and get nodes of their own in the hierarchy. */
    std::int64_t slivers = 0;
    /** Cells so flat that a solve scales their stiffness down, which its report notes. */
    std::int64_t scaled_cells = 0;
  };
  /** How well the type of the coordinates resolves the mesh. */
  struct Resolution
  {
    /** The largest coordinate over the diagonal of the bounds: from about 10 on, the distance of
     * the mesh from the origin costs digits. */
    double offset = 0;
    double digits = 0; ///< decimal digits of a coordinate, relative to the diagonal
  };

  CellType cell_type = CellType::Triangle; ///< the kind of the cells
  std::int64_t vertices = 0;               ///< of the stream
  std::int64_t cells = 0;                  ///< of the stream
  std::int64_t isolated_vertices = 0;      ///< of no cell, beside the stream or in it
  std::int64_t bodies = 0;                 ///< connected: cells that share a vertex are of one body
  std::int64_t largest_body = 0;           ///< cells of the body that has the most
  /** Edges of one triangle, faces of one tetrahedron. */
  std::int64_t boundary_facets = 0;
  /** Parts of the boundary: loops of edges, or surfaces. Those that touch in a vertex are one. */
  std::int64_t boundary_parts = 0;
  /** Of a solid: places of boundary faces at which several lie, as of bodies that touch without
   * sharing vertices; of more than 65,536 faces an estimate. A note says between which groups. */
  std::int64_t coincident_facets = 0;
  std::int64_t nonmanifold_facets = 0; ///< edges of more triangles than two, faces of tetrahedra
  /** Edges of more than two triangles, of the surface or of the boundary of the solid. */
  std::int64_t nonmanifold_edges = 0;
  /** Vertices whose triangles, of the surface or of the boundary of the solid, are not all
   * connected across edges at the vertex. Those at an edge of three triangles are. */
  std::int64_t nonmanifold_vertices = 0;
  /** Edges with two triangles that are wound against each other; 0 of solids. */
  std::int64_t turned_edges = 0;
  std::int64_t inverted_cells = 0;   ///< tetrahedra of negative volume; 0 of surfaces
  bool closed = false;               ///< a surface without boundary edges, with a cell
  bool consistently_wound = true;    ///< no turned edge; all tetrahedra have the same orientation
  std::int64_t degenerate_cells = 0; ///< a repeated corner, or no area or volume
  std::int64_t coincident_cells = 0; ///< with two vertices at the same place, up to rounding
  std::int64_t duplicate_cells = 0;  ///< as CellFlags has them
  EdgeLength edge_length;            ///< of the cells
  double area = 0;                   ///< of the surface, or of the boundary of the solid
  /** Of a solid; enclosed by all triangles of a surface, positive if the normals point outwards:
   * not a number unless at each edge as many triangles run in one direction as in the other. */
  double volume = 0;
  /** The part of a surface's volume that is of bodies wound inside out, or of cavities of others:
   * it counts as negative in `volume`. Not a number if that is not. */
  double turned_volume = 0;
  double boundary_length = 0;         ///< of the boundary edges of a surface; 0 of solids
  Quality quality;                    ///< of the cells with weight
  std::array<double, 6> bounds{};     ///< xmin, xmax, ymin, ymax, zmin, zmax
  double diagonal = 0;                ///< of the bounds
  Resolution resolution;              ///< of the coordinates
  std::vector<Column> vertex_columns; ///< in the order of the mesh
  std::vector<Column> cell_columns;   ///< in the order of the mesh
  std::vector<Group> groups;          ///< in the order of the mesh
  std::int64_t pool_bytes_peak = 0;   ///< most accounted memory at once, bytes
  std::vector<std::string> notes;     ///< remarks for the user, a sentence each

  /**
   * The description as a JSON object with the names above, except that a surface has
   * `boundary_edges` and `boundary_loops`, a solid `boundary_faces`, `boundary_surfaces` and
   * `nonmanifold_faces`, and what does not apply is left out. docs/info.md lists the names.
   * @param indent spaces by which each level is indented; -1: all on one line
   */
  std::string json(int indent = 2) const;
};

/**
 * Describes a mesh from one reading of its stream with all columns: bodies, boundary, what is not
 * manifold, lengths, area, volume, quality of the cells, ranges and tags of the columns. The result
 * does not depend on the blocks of the stream. The memory grows with its open vertices, and so in a
 * stream order like the square root of a surface's number of vertices.
 * @param mesh the mesh
 * @param options memory limit and progress
 * @throws Error if the mesh cannot be read or is not valid, or the memory limit is too low
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT MeshDescription describe(const StoredMesh& mesh, const DescribeOptions& options = {});

/** What meshInfo() says besides what the mesh itself does. */
struct MeshInfoOptions
{
  std::filesystem::path file = {};              ///< the entry `file`
  const ConversionReport* conversion = nullptr; ///< of the mesh; null: it is a .vsm file
  /** Whether a solve reads `file` in breadth-first order, not in the order of the mesh: its
   * expected cost is that of the usual span. */
  bool reorders = false;
  const MeshDescription* description = nullptr; ///< the entry `description`; null: none
  int indent = 2; ///< spaces by which each level is indented; -1: all on one line
};

/**
 * What is known of a mesh without reading it, as `smg info --report` writes it: a JSON object with
 * kind and number of cells and vertices, bounds, width, span, columns, how the file is stored, and
 * under `expected_solve` the expected cost of a solve for one value at each vertex. docs/info.md
 * lists the names.
 * @param mesh the mesh, in a .vsm file: an OpenedMesh, or with other columns
 * @param options what else to say
 * @throws Error if the file cannot be read
 */
SMG_EXPORT std::string meshInfo(const StoredMesh& mesh, const MeshInfoOptions& options = {});

} // namespace smg
