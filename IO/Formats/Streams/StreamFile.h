// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
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

/** The supported streaming mesh formats. */
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

/** The streaming format of the suffix of a file name, in upper or lower case; none for another. */
std::optional<StreamFormat> streamFormatOfName(const std::filesystem::path& path);

/** Whether a suffix, in lower case, is that of a streaming format, including unsupported ones. */
bool isStreamSuffix(std::string_view suffix);

/** Finds the format of a streaming mesh file by its content, or by its suffix if the content is
 * ambiguous. Throws Error if it is none of the four, by name for SMC, SMD, SVC and gzip. */
SMG_EXPORT StreamFormat detectStreamFormat(const std::filesystem::path& path);

/** How far the content of a file, whatever its name, resembles a streaming format. */
enum class Resemblance
{
  None,
  Possible, ///< it may be of another format as well: an OBJ file of vertices and triangles alone
  Sure      ///< it has what only a streaming format has
};

/** The resemblance of a file to SMA, SMB, SVA and SVB; none if it cannot be read. */
Resemblance resemblanceToStream(const std::filesystem::path& path);

/** Vertex columns for the values of a SVA or SVB vertex beyond its three coordinates. */
inline constexpr const char* StreamScalarName = "Scalar";         ///< float32
inline constexpr const char* StreamIntegerName = "IntegerScalar"; ///< int32, also a cell column

/** The header of a streaming mesh file. */
struct StreamFileHeader
{
  StreamFormat format = StreamFormat::Sma;
  std::int64_t vertices = -1; ///< -1: not given
  std::int64_t cells = -1;    ///< -1: not given
  /** xmin, xmax, ymin, ymax, zmin, zmax, if given. */
  std::optional<std::array<double, 6>> bounds;
  /** Whether vertices come after the last cell that uses them; otherwise before the first. */
  bool postOrder = false;
  int vertexFloats = 0; ///< further floats per vertex, beyond the coordinates
  /** Least and largest value of each further float; only for writing, with the bounds. */
  std::vector<std::array<float, 2>> floatRanges;
  int vertexInts = 0;                ///< integers per vertex
  int cellInts = 0;                  ///< integers per cell
  std::vector<std::string> comments; ///< of the header
  /** The comments are in memory: a file with more bytes of them, each with its end, is refused. */
  static constexpr std::int64_t MaxCommentBytes = std::int64_t(1) << 20;
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
  /** The further values of the vertex, or of the cell, in the numbers of StreamFileHeader. */
  std::vector<float> floats;
  std::vector<std::int32_t> ints;
};

/**
 * Reads a streaming mesh file element by element, in memory independent of the file. Checks syntax,
 * finite coordinates, indices (in a pre-order file they name earlier vertices) and the counts of
 * the header. Every failure is an Error with file and position.
 */
class StreamFileReader
{
public:
  virtual ~StreamFileReader() = default;
  const StreamFileHeader& header() const { return this->Header; }
  const std::string& name() const { return this->Input.name(); }
  /** The next element; `End` at the end and after it. */
  void next(StreamEvent& event);
  /** Throws Error: the name of the file, the place of the last element, and `what`. */
  [[noreturn]] void fail(const std::string& what) const;

protected:
  StreamFileReader(
    const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress)
    : Input(path, progress)
    , Corners(cornersOf(cellTypeOf(format)))
  {
    this->Header.format = format;
  }

  /** Fills in an element that has no further values yet; false at the end of the file. */
  virtual bool read(StreamEvent& event) = 0;
  /** The position of the last element: "line 12", or "element 7 at byte 112". */
  virtual std::string place() const = 0;
  /** The vertex of an index in the file, which is relative if it is negative; none if that is not
   * a vertex. `most`: the vertices for which the file has room. */
  std::optional<std::int64_t> vertexOf(std::int64_t index, std::int64_t most) const;

  InputFile Input;
  int Corners; ///< of a cell
  StreamFileHeader Header;
  std::int64_t Vertices = 0, Cells = 0; ///< so far

private:
  void checkEnd() const;
};

/** Opens a streaming mesh file of any of the four formats. Reading reports progress. */
std::unique_ptr<StreamFileReader> openStreamFile(
  const std::filesystem::path& path, const ProgressFunction& progress = {});

// The parsers of the text formats (TextStreamReader.cpp) and of the binary ones
// (BinaryStreamReader.cpp), for detection and openStreamFile(). All throw Error.

/** Opens SMA or SVA. */
std::unique_ptr<StreamFileReader> openTextStream(
  const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress);
/** The format of a text, by the first line that only one of them can have. */
std::optional<StreamFormat> formatOfText(InputFile& file);
/** Vertices and triangles alone are OBJ as well; other lines are of one format only. */
Resemblance resemblanceOfText(InputFile& file);

/** Opens SMB or SVB. */
std::unique_ptr<StreamFileReader> openBinaryStream(
  const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress);
/** Reads the beginning of a SMB or SVB file. */
StreamFileHeader readBinaryHeader(InputFile& file, StreamFormat format);

/** First bytes of the binary formats. */
constexpr std::uint8_t SmbVersion = 0;
constexpr std::uint8_t SvbVersion = 4;

/** Elements of a full block of the binary formats. */
constexpr int BinaryBlockElements = 32;

} // namespace smg
