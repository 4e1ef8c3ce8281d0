// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialInput.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The streaming mesh formats that are read and written. */
enum class StreamFormat
{
  Sma, ///< triangles, text
  Smb, ///< triangles, binary
  Sva, ///< tetrahedra, text
  Svb  ///< tetrahedra, binary
};

constexpr std::string_view nameOf(StreamFormat format)
{
  constexpr std::string_view names[] = { "SMA", "SMB", "SVA", "SVB" };
  return names[static_cast<int>(format)];
}

constexpr CellType cellTypeOf(StreamFormat format)
{
  return format == StreamFormat::Sma || format == StreamFormat::Smb ? CellType::Triangle
                                                                    : CellType::Tetrahedron;
}

constexpr bool isText(StreamFormat format)
{
  return format == StreamFormat::Sma || format == StreamFormat::Sva;
}

/** The streaming format that a file name's suffix stands for, in any case; none for another. */
std::optional<StreamFormat> streamFormatOfName(const std::filesystem::path& path);

/** Whether a suffix, in lower case, is one of streaming formats, also of those that are not read.
 */
bool isStreamSuffix(std::string_view suffix);

/**
 * Finds the format of a streaming mesh file by its content, by its suffix where the content leaves
 * it open. Throws Error if it is none of the four, by name for SMC, SMD, SVC and gzip.
 */
SMG_EXPORT StreamFormat detectStreamFormat(const std::filesystem::path& path);

/** Vertex columns that the values of a SVA or SVB vertex beyond its three coordinates become. */
inline constexpr const char* StreamScalarName = "Scalar";         ///< float32
inline constexpr const char* StreamIntegerName = "IntegerScalar"; ///< int32, also a cell column

/** What the beginning of a streaming mesh file says. */
struct StreamFileHeader
{
  StreamFormat format = StreamFormat::Sma;
  std::int64_t vertices = -1; ///< -1: not given
  std::int64_t cells = -1;    ///< -1: not given
  /** xmin, xmax, ymin, ymax, zmin, zmax, if given. */
  std::optional<std::array<double, 6>> bounds;
  /** Vertices come after the last cell that uses them, else before the first. */
  bool postOrder = false;
  int vertexFloats = 0; ///< further floats a vertex, beyond the coordinates
  /** Least and largest value of each further float; only for writing, with the bounds. */
  std::vector<std::array<float, 2>> floatRanges;
  int vertexInts = 0;                ///< integers a vertex
  int cellInts = 0;                  ///< integers a cell
  std::vector<std::string> comments; ///< of the header
};

/** One element of a streaming mesh file. Indices count the file's vertices from 0. */
struct StreamEvent
{
  enum Kind
  {
    Vertex,
    Cell,
    Finalization, ///< no later cell uses vertex corners[0]
    End
  };
  Kind kind = End;
  std::array<float, 3> position{};
  std::array<std::int64_t, 4> corners{};
  /** Bit k: no later cell uses vertex corners[k]. */
  unsigned finalMask = 0;
  /** The further values of the vertex, or of the cell: StreamFileHeader says how many. */
  std::vector<float> floats;
  std::vector<std::int32_t> ints;
};

/**
 * Reads a streaming mesh file element by element, in memory that does not depend on the file.
 * Checked while reading: syntax, finite coordinates, indices (in a pre-order file they name
 * vertices that have come), the counts of the header. Every failure is an Error with file and
 * place.
 */
class StreamFileReader
{
public:
  virtual ~StreamFileReader() = default;
  const StreamFileHeader& header() const { return this->Header; }
  std::string name() const { return this->Input.name(); }
  /** The next element; `End` for ever at the end. */
  void next(StreamEvent& event);
  /** Where the last element stands: "line 12", or "element 7 at byte 112". */
  virtual std::string place() const = 0;
  /** How much of the file has been read, 0 to 1. */
  double fraction() const;

protected:
  explicit StreamFileReader(const std::filesystem::path& path)
    : Input(path)
  {
  }

  /** Fills in an element that has no further values yet; false at the end of the file. */
  virtual bool read(StreamEvent& event) = 0;
  [[noreturn]] void fail(const std::string& what) const;

  SequentialInput Input;
  StreamFileHeader Header;
  std::int64_t Vertices = 0, Cells = 0; ///< so far

private:
  void checkEnd() const;
};

/** Opens a streaming mesh file of any of the four formats. */
std::unique_ptr<StreamFileReader> openStreamFile(const std::filesystem::path& path);

} // namespace smg
