// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "smg/VsmReader.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace smg
{

/**
 * Converts the elements of a streaming mesh file to a compact mesh stream: cells in the order of
 * the file, each as soon as all of its vertices are known, vertices numbered by first use. Vertices
 * of no cell are stored in the table of the isolated ones.
 *
 * The data of waiting vertices and cells are stored in pages (PagedArray.h), which are released
 * when their vertices are final. All else is a block of cells with its vertices, and as many
 * isolated vertices: memory that does not depend on the file.
 */
class StreamAssembler
{
public:
  /** `memory`: bytes for the pages. */
  StreamAssembler(const StreamFileReader& reader, VsmWriter& writer,
    const std::filesystem::path& scratch, std::int64_t memory);

  /** The columns of the stream, to create the writer. */
  static StreamInfo infoOf(const StreamFileHeader& header);

  /** Adds the next element of the file. */
  void take(const StreamEvent& event);
  /** To be called at the end of the file. */
  void finish();

  std::int64_t isolatedVertices() const { return this->Vertices - this->Used; }

private:
  static constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::max();

  /** A vertex of the file. */
  struct Vertex
  {
    std::array<float, 3> position;
    std::uint32_t unused;
    std::int64_t number; ///< its stream index + 1, or 0 if no delivered cell uses it
    std::int64_t until;  ///< needed until this many cells are delivered, or always
  };
  static_assert(sizeof(Vertex) == 32);

  void takeVertex(const StreamEvent& event);
  void takeCell(const StreamEvent& event);
  void finalize(std::int64_t vertex);
  /** Delivers the cells at the head of the queue whose vertices are complete. */
  void deliver();
  void deliverCell(const std::array<std::int64_t, 4>& corners);
  std::int64_t introduce(std::int64_t vertex);
  /** Appends the index of a vertex in the file and its further values to the columns. */
  void pushValues(std::int64_t vertex, std::vector<Column>& columns);
  /** Releases data that are not needed any more. */
  void forget();
  /** A vertex that no cell uses. */
  void setAside(std::int64_t vertex);
  void flushIsolated();
  void flush();

  const StreamFileReader& Reader;
  const StreamFileHeader& Header;
  VsmWriter& Writer;
  int Corners;

  std::int64_t Vertices = 0;  ///< that have come
  std::int64_t Cells = 0;     ///< that have come
  std::int64_t Delivered = 0; ///< cells delivered
  std::int64_t Used = 0;      ///< vertices delivered

  PagedArray<Vertex> FileVertices;               ///< by place in the file
  PagedArray<std::int32_t> Values;               ///< further values of these, bits of floats too
  PagedArray<std::array<std::int64_t, 4>> Queue; ///< corners of the cells, by place in the file
  PagedArray<std::int32_t> CellValues;
  PagedArray<std::int64_t> Until;   ///< like Vertex::until, by stream index
  std::int64_t FirstFileVertex = 0; ///< earlier vertices are not needed any more
  std::int64_t FirstStreamVertex = 0;

  MeshBlock Block; ///< the current block
  IsolatedVertices Aside;
  std::int64_t AsideCount = 0; ///< vertices set aside
};

} // namespace smg
