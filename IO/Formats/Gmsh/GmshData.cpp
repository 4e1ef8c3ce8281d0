// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/GmshData.h"

#include "IO/Files/FileNames.h"
#include "IO/Import/ImportColumn.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

// Values are sorted by the numbers of their nodes or elements, merged with the numbers of the mesh,
// which gives their places, and sorted by these.

namespace smg
{
namespace
{

/** A number as a key that sorts as it. */
std::uint64_t keyOf(std::int64_t number)
{
  return static_cast<std::uint64_t>(number) ^ std::uint64_t(1) << 63;
}

/** From a number to one that is not smaller, without overflow. */
std::uint64_t distanceOf(std::int64_t first, std::int64_t number)
{
  return static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(first);
}

std::int64_t numberOfKey(std::uint64_t key)
{
  return static_cast<std::int64_t>(key ^ std::uint64_t(1) << 63);
}

} // namespace

/** The section of this name: one of another time step is begun anew, one of the same goes on, as
 * that of another partition. */
GmshData::Section& GmshData::sectionOf(const GmshInput::DataHeader& header, ColumnOf of)
{
  const std::string name = header.name.empty() ? "data" : oneLine(header.name);
  const auto found = std::ranges::find_if(this->Sections,
    [&](const Section& section) { return section.of == of && section.name == name; });
  const auto components = static_cast<std::size_t>(header.components);
  if (found == this->Sections.end())
  {
    return this->Sections.emplace_back(
      Section{ name, of, header.step, 1, components, BucketFile(this->Builder.workspace()) });
  }
  if (found->step != header.step || found->components != components)
  {
    found->steps += found->step != header.step ? 1 : 0;
    found->step = header.step;
    found->components = components;
    found->rows = BucketFile(this->Builder.workspace());
  }
  return *found;
}

void GmshData::read(GmshInput& input, ColumnOf of)
{
  const GmshInput::DataHeader header = input.dataHeader();
  Section& section = this->sectionOf(header, of);
  std::vector<double> values(section.components);
  for (std::int64_t i = 0; i < header.entries; ++i)
  {
    const std::int64_t number =
      input.integer(of == ColumnOf::Vertices ? "the tag of a node" : "the tag of an element");
    for (double& value : values)
    {
      value = input.anyNumber("a value");
    }
    section.rows.put(0, number);
    section.rows.append(0, std::as_bytes(std::span(values)));
  }
  section.rows.close();
  input.endNumbers();
}

void GmshData::finish(GmshNumbers& nodes, GmshNumbers& elements)
{
  for (GmshNumbers* numbers : { &nodes, &elements })
  {
    numbers->close();
    numbers->runs().close();
  }
  for (Section& section : this->Sections)
  {
    if (section.steps > 1)
    {
      this->Builder.note("The data " + inQuotes(section.name) + " have " +
                         std::to_string(section.steps) + " time steps, of which the last is read.");
    }
    this->fill(section, section.of == ColumnOf::Vertices ? nodes : elements);
  }
}

/** Sorts the values of a section by the places of their nodes or elements. */
GmshData::Found GmshData::place(Section& section, GmshNumbers& numbers, RowSort& placed)
{
  Workspace& space = this->Builder.workspace();
  const std::size_t valueBytes = section.rowBytes() - sizeof(std::int64_t);
  const std::int64_t memory = space.available() / 4;
  RowSort rows(space, memory, valueBytes);
  BucketFile::Reader reader(section.rows);
  std::vector<std::byte> values(valueBytes);
  for (std::int64_t number = 0; reader.get(number) && reader.read(values);)
  {
    std::memcpy(rows.put(keyOf(number)), values.data(), valueBytes);
  }
  rows.sort();
  ExternalSort<GmshNumbers::Run> runs(space, memory);
  RecordFile<GmshNumbers::Run>::Reader unsorted(numbers.runs());
  for (GmshNumbers::Run run{}; unsorted.next(run);)
  {
    runs.put(run);
  }
  runs.sort();
  Found found;
  GmshNumbers::Run run{};
  bool has = runs.next(run);
  for (RowSort::Row row; rows.next(row);)
  {
    const std::int64_t number = numberOfKey(row.key);
    while (has && number > run.first && distanceOf(run.first, number) >= run.count)
    {
      has = runs.next(run);
    }
    if (!has || number < run.first)
    {
      ++found.unknown;
      continue;
    }
    found.ofCells += run.dimension == this->Builder.dimension() ? 1 : 0;
    std::memcpy(placed.put(run.place + distanceOf(run.first, number)), row.bytes, valueBytes);
  }
  placed.sort();
  return found;
}

void GmshData::fill(Section& section, GmshNumbers& numbers)
{
  Workspace& space = this->Builder.workspace();
  const std::size_t valueBytes = section.rowBytes() - sizeof(std::int64_t);
  RowSort placed(space, space.available() / 6, valueBytes);
  const Found found = this->place(section, numbers, placed);
  section.rows = BucketFile(space);
  const bool ofVertices = section.of == ColumnOf::Vertices;
  if (found.unknown > 0)
  {
    this->Builder.note("Of the data " + inQuotes(section.name) + ", " +
                       counted(found.unknown, "value belongs", "values belong") + " to no " +
                       (ofVertices ? "node" : "element") + " of the file: left out.");
  }
  if (!ofVertices && found.ofCells == 0)
  {
    this->Builder.note(
      "The data " + inQuotes(section.name) + " are left out, since no cell of the mesh has any.");
    return;
  }
  ImportColumn column(this->Builder, section.of,
    { section.name, ScalarType::Float64, static_cast<int>(section.components) });
  const std::vector<double> none(section.components, std::numeric_limits<double>::quiet_NaN());
  const auto count =
    static_cast<std::uint64_t>(ofVertices ? this->Builder.vertices() : this->Builder.elements());
  RowSort::Row row;
  bool has = placed.next(row);
  for (std::uint64_t place = 0; column.exists() && place < count; ++place)
  {
    const bool isHere = has && row.key == place;
    column.append(isHere ? std::span(row.bytes, valueBytes) : std::as_bytes(std::span(none)));
    while (has && row.key <= place)
    {
      has = placed.next(row);
    }
  }
  column.close();
}

} // namespace smg
