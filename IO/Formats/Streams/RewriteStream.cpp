// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Streams/StreamFileWriter.h"
#include "IO/Mesh/Columns.h"
#include "IO/Results/MovedVertices.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
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
  StreamEvent event;
  for (elements.next(event); event.kind != StreamEvent::End; elements.next(event))
  {
    const bool isVertex = event.kind == StreamEvent::Vertex;
    for (std::size_t k = 0; isVertex && k < ranges.size(); ++k)
    {
      const float value = k < 3 ? event.position[k] : event.floats[k - 3];
      ranges[k] = { std::min(ranges[k][0], value), std::max(ranges[k][1], value) };
    }
  }
  header.bounds = { ranges[0][0], ranges[0][1], ranges[1][0], ranges[1][1], ranges[2][0],
    ranges[2][1] };
  header.floatRanges.assign(ranges.begin() + 3, ranges.end());
}

/** Writes elements as they are read. */
void copyElements(MovedElements& elements, StreamFileWriter& writer, std::size_t corners)
{
  // The last cell, until it is known which of its vertices it finalises.
  std::optional<StreamEvent> cell;
  StreamEvent event;
  do
  {
    elements.next(event);
    if (cell && event.kind == StreamEvent::Finalization)
    {
      // In the last cell, which all formats support, if the vertex is a corner of it.
      const auto all = std::span(cell->corners).first(corners);
      const auto corner = std::ranges::find(all, event.corners[0]);
      if (corner != all.end())
      {
        cell->finalMask |= 1U << (corner - all.begin());
        continue;
      }
    }
    if (cell)
    {
      writer.cell(std::span(cell->corners).first(corners), cell->finalMask, cell->ints);
      cell.reset();
    }
    if (event.kind == StreamEvent::Vertex)
    {
      writer.vertex(event.position, event.floats, event.ints);
    }
    else if (event.kind == StreamEvent::Cell)
    {
      cell = event;
    }
    else if (event.kind == StreamEvent::Finalization)
    {
      writer.finalization(event.corners[0]);
    }
  } while (event.kind != StreamEvent::End);
}

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
  copyElements(elements, *writer, static_cast<std::size_t>(cornersOf(cellType)));
  if (beforeEnd)
  {
    beforeEnd();
  }
  writer->finish();
}

} // namespace smg
