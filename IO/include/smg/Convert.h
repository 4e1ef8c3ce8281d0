// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/ProblemDescription.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace smg
{

struct ArrayView;

/** The stream orders that a conversion makes: see docs/convert.md. */
enum class StreamOrder
{
  BreadthFirst, ///< "bfs": breadth-first from planned starts, component after component
  Axis,         ///< "axis": along the longest side of the bounds
  Keep,         ///< "keep": the order of the cells in the file
  Spectral      ///< "spectral": along the Fiedler vector
};

/**
 * The order with this name: "bfs", "axis", "keep" or "spectral".
 * @throws Error naming these if there is no such order
 */
SMG_EXPORT StreamOrder streamOrder(std::string_view name);

/** The name of an order: "bfs", "axis", "keep" or "spectral". */
SMG_EXPORT std::string_view nameOf(StreamOrder order);

/** Which cells of a file become the cells of the stream. */
enum class CellChoice
{
  Only,      ///< all of them; a file with surface cells and volume cells is an error
  Triangles, ///< the surface cells; volume cells are left out
  Tetrahedra ///< the volume cells; surface cells are left out
};

/** What numbers the vertices and cells of a mesh file. */
enum class Numbering
{
  OfColumns, ///< its int64 columns OriginalId and OriginalCellId if it has them: it is a part of
             ///< another file, or has another order; else its rows
  OfRows     ///< its rows; columns of these names are renamed
};

/** Groups of facets that a problem couples (ProblemDescription::periodic and interfaces). */
struct CoupledGroups
{
  /** The names of the groups of one side and of the other. */
  std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> periodic;
  /** The names of the groups of each contact. */
  std::vector<std::vector<std::string>> interfaces;
};

/** The groups that a problem couples. Sides that are other places are left out. */
SMG_EXPORT CoupledGroups coupledGroups(const ProblemDescription& problem);

/** How to convert. */
struct ConversionOptions
{
  /** The order of the stream. */
  StreamOrder order = StreamOrder::BreadthFirst;
  /** The memory limit used if none is given, bytes: 256 MiB. */
  static constexpr std::int64_t DefaultMemory = std::int64_t(256) << 20;

  /** Limit of the accounted memory, bytes, at least 16 MiB; 0: DefaultMemory. */
  std::int64_t memoryLimit = 0;
  /** Which cells to keep. */
  CellChoice cells = CellChoice::Only;
  /** Distance, in the unit of the coordinates, within which points are merged; 0: points of equal
   * coordinates; none: no points. */
  std::optional<double> weld;
  /** Turn triangles so that those of a body are wound alike, and outwards if it is closed. Closed
   * bodies that lie in others keep their winding relative to these: cavities stay cavities. */
  bool orient = false;
  std::int64_t timeStep = 0; ///< of a file with time steps (VTKHDF): which one, from 0
  /** Which partition of a file with partitions (VTKHDF) to read, from 0; none: all, joined. */
  std::optional<std::int64_t> partition;
  /** What a problem couples: the order keeps coupled vertices near each other, so that its solve
   * takes as little memory as one without couplings. The mesh is the same. */
  CoupledGroups coupled;
  /** What numbers the vertices and cells of a file. */
  Numbering numbering = Numbering::OfColumns;
  /** Write vertices and cells in the order of the original file; the input must be a .vsm file. */
  bool restoreOrder = false;
  /** Compression of a .vsm file. */
  Codec codec = Codec::Zstd;
  bool text = false; ///< of the result: see WriteMeshOptions
  /** Text on the origin of the mesh for the header of a .vsm file, in UTF-8; empty: none. */
  std::string origin;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Limit of the bytes of scratch files that exist at once; 0: none. */
  std::int64_t scratchLimit = 0;
  /**
   * The folder of a checkpoint (see CheckpointOptions::folder), which has the scratch files: if the
   * program is killed, the same conversion continues after the last complete stage, and removes the
   * checkpoint when the result is complete. Stages are the import, with merging points, and the
   * order; copies in the order of a stream and restoring an order have none. With openMesh(), the
   * checkpoint keeps the converted file until Solution::removeCheckpoint(). Empty: none.
   */
  std::filesystem::path checkpoint;
  /** Threads that compute; 0: one per core. The result does not depend on them. */
  int threads = 0;
  /** Progress callback; empty: none. */
  ProgressFunction progress;
};

/** What a conversion did. A count of -1 is not known, or does not apply to the kind of cells. */
struct SMG_EXPORT ConversionReport
{
  /** Wall-clock times, seconds. */
  struct Seconds
  {
    double import = 0; ///< reading the file and merging points
    double order = 0;  ///< making the order, or looking for degenerate and duplicate cells
    double write = 0;  ///< writing the result
    double total = 0;  ///< from the start to the end
  };

  std::string order;                      ///< "bfs", "axis", "keep", "spectral" or "restored"
  std::int64_t time_steps = 0;            ///< of the file that was read; 0: it has none
  std::int64_t partitions = 0;            ///< of the file that was read; 0: it has none
  std::int64_t vertices = 0;              ///< of the stream
  std::int64_t cells = 0;                 ///< of the stream
  std::int64_t isolated_vertices = 0;     ///< vertices of no cell: kept beside a .vsm stream
  std::int64_t merged_points = 0;         ///< points merged with others
  std::int64_t degenerate_cells = 0;      ///< cells without area or volume: flagged
  std::int64_t duplicate_cells = 0;       ///< cells with the corners of an earlier one: flagged
  std::int64_t dropped_cells = 0;         ///< left out: points, lines, cells of the other kind
  std::int64_t triangulated_polygons = 0; ///< polygons and strips split into triangles
  std::int64_t split_cells = 0;           ///< hexahedra, wedges, pyramids split into tetrahedra
  std::int64_t higher_order_cells = 0;    ///< cells of which only the corners were used
  std::int64_t inverted_cells = -1;       ///< tetrahedra of negative volume
  std::int64_t components = -1;           ///< components connected by edges
  std::int64_t boundary_edges = -1;       ///< edges of one triangle
  std::int64_t nonmanifold_edges = -1;    ///< edges of more than two triangles
  std::int64_t nonmanifold_vertices = -1; ///< vertices of triangles not connected across edges
  /** Whether OriginalId or OriginalCellId is a column of the file itself: see convert(). */
  bool keeps_numbers = false;
  std::int64_t width = -1;                ///< StreamInfo::width of the result
  std::int64_t span = -1;                 ///< StreamInfo::span of the result
  double mean_width = 0;                  ///< mean over the cells of the number of vertices alive
  std::int64_t pool_bytes_peak = 0;       ///< most accounted memory at once, bytes
  std::int64_t rss_bytes_peak = 0;        ///< largest resident memory of the process, bytes
  std::int64_t scratch_bytes_peak = 0;    ///< most bytes of scratch files at once
  std::int64_t scratch_bytes_read = 0;    ///< read from scratch files
  std::int64_t scratch_bytes_written = 0; ///< written to scratch files
  std::int64_t pages = 0;                 ///< pages of vertices for the breadth-first order
  std::int64_t page_loads = 0;            ///< how often a page was loaded to make this order
  double cpu_seconds = 0;                 ///< processor time of all threads of the process
  Seconds seconds;                        ///< wall-clock times
  std::vector<std::string> notes;         ///< remarks for the user, a sentence each

  /** What of the cells of the file is left out or counts for nothing, a sentence each. */
  std::vector<std::string> changes() const;
  /**
   * The report as a JSON object with the names above.
   * @param indent spaces by which each level is indented; -1: all on one line
   */
  std::string json(int indent = 2) const;
};

/**
 * Brings a mesh into a stream order and writes it, in a fixed amount of memory whatever its size.
 *
 * The stream is compact (see StreamInfo). Vertices of no cell are left out of it; a .vsm file keeps
 * them beside it. Degenerate and duplicate cells stay and are flagged in the cell column
 * `CellFlags`. The columns `OriginalId` and `OriginalCellId` hold the places in the file, from 0.
 * If the file has int64 columns of these names already, those are kept instead; columns of another
 * type with these names are renamed (`OriginalId_1`), with a note.
 *
 * @param in a mesh file of any format in docs/formats.md, recognised by its content, or by its
 * suffix where that leaves it open; perhaps compressed by gzip. At most 4,294,967,294 vertices and
 * as many cells.
 * @param out the result, in the format of its suffix, one that is written according to
 * docs/formats.md; with `restoreOrder`, one that is restored
 * @param options how to convert
 * @throws Error if the input is not valid, the output cannot be written or its format does not hold
 * such cells, the memory limit is below 16 MiB, the disk has too little room for the scratch files
 * (as far as known, before they are written), or these would exceed their limit
 * @throws Cancelled if the progress callback returns false. Neither output nor scratch files remain
 * after an exception.
 */
SMG_EXPORT ConversionReport convert(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options = {});

/** A mesh file of any format, open as a .vsm file. */
class SMG_EXPORT OpenedMesh : public StoredMesh
{
public:
  /** Removes the converted file, if there is one. */
  ~OpenedMesh() override;

  const StreamInfo& info() const override;
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override;
  std::string fingerprint() const override;
  std::filesystem::path file() const override;

  /** The reader of the .vsm file, valid as long as this. */
  VsmReader& reader();
  /** What the conversion did, valid as long as this; null if the file is a .vsm file itself. */
  const ConversionReport* conversion() const;

private:
  friend std::unique_ptr<OpenedMesh> openMesh(
    const std::filesystem::path& path, const ConversionOptions& options);
  friend std::unique_ptr<OpenedMesh> openArrays(
    const ArrayView& points, const ArrayView& cells, const ConversionOptions& options);
  OpenedMesh();

  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

/**
 * Opens a mesh file of any format that convert() reads. A .vsm file is read as it is; any other
 * file is converted to a .vsm file in the scratch folder, which lives as long as the OpenedMesh.
 * @param path the mesh file
 * @param options how to convert; a streaming format (SMA, SMB, SVA, SVB) keeps its order
 * @throws Error as convert(), and if the file is a .vsm file but `cells`, `weld`, `timeStep` or
 * `partition` asks for a part or another mesh
 * @throws Cancelled as convert()
 */
SMG_EXPORT std::unique_ptr<OpenedMesh> openMesh(
  const std::filesystem::path& path, const ConversionOptions& options = {});

} // namespace smg
