// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "IO/External/ExternalSort.h"
#include "IO/Formats/Gmsh/GmshInput.h"
#include "IO/Import/RawMeshBuilder.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** The numbers that a file gives its nodes or elements. Consecutive ones take no room. */
class GmshNumbers
{
public:
  /** Numbers that follow each other, of places that do. */
  struct Run
  {
    std::int64_t first;
    std::uint32_t place, count;
    std::int64_t dimension; ///< of elements
    auto operator<=>(const Run&) const = default;
  };

  explicit GmshNumbers(Workspace& workspace)
    : Runs(workspace)
  {
  }

  /** Adds the number of the node or element at this place, from 0; an element may have several. */
  void add(std::int64_t number, std::int64_t place, int dimension = 0)
  {
    const auto next = static_cast<std::uint32_t>(place);
    if (this->Last.count > 0 && number > this->Last.first &&
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(this->Last.first) ==
          this->Last.count &&
        next == this->Last.place + this->Last.count && dimension == this->Last.dimension)
    {
      ++this->Last.count;
      return;
    }
    this->close();
    this->Last = { number, next, 1, dimension };
  }
  /** To be called after the last one, or between two. */
  void close()
  {
    if (this->Last.count > 0)
    {
      this->Runs.put(this->Last);
      this->Last.count = 0;
    }
  }
  RecordFile<Run>& runs() { return this->Runs; }

private:
  RecordFile<Run> Runs;
  Run Last{};
};

/**
 * The sections $NodeData and $ElementData: columns of the numbers that they have for nodes or
 * elements, by the numbers of these and in any order; NaN where they have none. Of several time
 * steps of a name the last one counts. Kept in scratch files, and sorted out of core in the end.
 */
class GmshData
{
public:
  explicit GmshData(RawMeshBuilder& builder)
    : Builder(builder)
  {
  }

  /** Reads a section, after its first line. */
  void read(GmshInput& input, ColumnOf of);
  /** After the last section: makes the columns. */
  void finish(GmshNumbers& nodes, GmshNumbers& elements);

private:
  struct Section
  {
    std::string name;
    ColumnOf of;
    std::int64_t step = 0, steps = 1;
    std::size_t components = 1;
    BucketFile rows; ///< a number and its values

    std::size_t rowBytes() const
    {
      return sizeof(std::int64_t) + this->components * sizeof(double);
    }
  };

  Section& sectionOf(const GmshInput::DataHeader& header, ColumnOf of);
  struct Found
  {
    std::int64_t unknown = 0; ///< values of no node or element
    std::int64_t ofCells = 0; ///< values of elements that are cells
  };
  Found place(Section& section, GmshNumbers& numbers, RowSort& placed);
  void fill(Section& section, GmshNumbers& numbers);

  RawMeshBuilder& Builder;
  std::vector<Section> Sections;
};

} // namespace smg
