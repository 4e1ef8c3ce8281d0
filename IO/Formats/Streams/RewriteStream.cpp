// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Streams/StreamFileWriter.h"
#include "IO/Formats/Streams/StreamsFormat.h"
#include "IO/Mesh/Columns.h"
#include "IO/Results/MovedVertices.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

namespace
{

/** The elements of a streaming mesh file with the vertices moved. */
class MovedElements
{
public:
  MovedElements(const std::filesystem::path& in, const std::filesystem::path& out,
    MovedVertices& moved, const ProgressFunction& progress)
    : Reader(openStreamFile(in, progress))
    , Out(out)
    , Moved(moved)
  {
  }

  void next(StreamEvent& event)
  {
    this->Reader->next(event);
    if (event.kind == StreamEvent::Vertex)
    {
      const std::int64_t vertex = this->Vertices++;
      if (this->Moved.find(vertex))
      {
        event.position = singlePrecision(this->Moved.position(), vertex, this->Out.string());
      }
    }
    else if (event.kind == StreamEvent::End)
    {
      this->Moved.check(this->Vertices, this->Reader->name());
    }
  }

private:
  std::unique_ptr<StreamFileReader> Reader;
  const std::filesystem::path& Out;
  MovedVertices& Moved;
  std::int64_t Vertices = 0;
};

/** Finds the bounds of the vertices, and of their further values, for the header. */
void findBounds(MovedElements& elements, StreamFileHeader& header)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<std::array<float, 2>> ranges(3 + header.vertexFloats, { infinity, -infinity });
  const auto extend = [](std::array<float, 2>& range, float value) {
    range = { std::min(range[0], value), std::max(range[1], value) };
  };
  StreamEvent event;
  for (elements.next(event); event.kind != StreamEvent::End; elements.next(event))
  {
    if (event.kind == StreamEvent::Vertex)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        extend(ranges[axis], event.position[axis]);
      }
      for (std::size_t k = 0; k < event.floats.size(); ++k)
      {
        extend(ranges[3 + k], event.floats[k]);
      }
    }
  }
  header.bounds = { ranges[0][0], ranges[0][1], ranges[1][0], ranges[1][1], ranges[2][0],
    ranges[2][1] };
  header.floatRanges.assign(ranges.begin() + 3, ranges.end());
}

/** Writes elements as they are read. */
class ElementCopier
{
public:
  ElementCopier(StreamFileWriter& writer, std::size_t corners)
    : Writer(writer)
    , Corners(corners)
  {
  }

  void take(const StreamEvent& event)
  {
    if (event.kind == StreamEvent::Finalization && this->finalizeInCell(event.corners[0]))
    {
      return;
    }
    this->writeCell();
    if (event.kind == StreamEvent::Vertex)
    {
      this->Writer.vertex(event.position, event.floats, event.ints);
    }
    else if (event.kind == StreamEvent::Cell)
    {
      this->Cell = event;
    }
    else if (event.kind == StreamEvent::Finalization)
    {
      this->Writer.finalization(event.corners[0]);
    }
  }

private:
  /** Declares a vertex final in the last cell, which all formats support, if it is a corner. */
  bool finalizeInCell(std::int64_t vertex)
  {
    if (!this->Cell)
    {
      return false;
    }
    const auto end = this->Cell->corners.begin() + static_cast<std::ptrdiff_t>(this->Corners);
    const auto corner = std::find(this->Cell->corners.begin(), end, vertex);
    if (corner == end)
    {
      return false;
    }
    this->Cell->finalMask |= 1U << (corner - this->Cell->corners.begin());
    return true;
  }

  void writeCell()
  {
    if (this->Cell)
    {
      this->Writer.cell(std::span(this->Cell->corners).first(this->Corners), this->Cell->finalMask,
        this->Cell->ints);
      this->Cell.reset();
    }
  }

  StreamFileWriter& Writer;
  std::size_t Corners;
  /** The last cell, until it is known which of its vertices it finalises. */
  std::optional<StreamEvent> Cell;
};

} // namespace

void rewriteStream(const std::filesystem::path& in, const std::filesystem::path& out,
  MovedVertices& moved, const ProgressFunction& progress, const std::function<void()>& beforeEnd)
{
  StreamFileHeader header = openStreamFile(in)->header();
  const CellType cellType = cellTypeOf(header.format);
  header.format = *streamFormatOfName(out);
  if (!isText(header.format))
  {
    // Other programs for the binary formats fail at comments.
    header.comments.clear();
  }
  double begin = 0.0;
  if (header.bounds)
  {
    begin = 0.5;
    MovedElements all(in, out, moved, partOf(progress, 0.0, begin));
    findBounds(all, header);
  }
  MovedElements elements(in, out, moved, partOf(progress, begin, 1.0));
  const std::unique_ptr<StreamFileWriter> writer = createStreamFile(out, header);
  ElementCopier copier(*writer, static_cast<std::size_t>(cornersOf(cellType)));
  StreamEvent event;
  do
  {
    elements.next(event);
    copier.take(event);
  } while (event.kind != StreamEvent::End);
  if (beforeEnd)
  {
    beforeEnd();
  }
  writer->finish();
}

} // namespace smg
