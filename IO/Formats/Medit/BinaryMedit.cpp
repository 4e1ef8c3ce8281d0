// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/BinaryInput.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Medit/MeditSections.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

namespace
{

/** Codes of keywords besides those of MeditSections. */
constexpr std::int32_t DimensionCode = 3, VerticesCode = 4, EndCode = 54;
constexpr std::array<std::int32_t, 4> HigherOrderCodes{ 24, 27, 30, 33 };

/** The byte order of a file that begins with the number 1; none for others. */
std::optional<std::endian> orderOfMedit(std::string_view start)
{
  for (const std::endian order : { std::endian::little, std::endian::big })
  {
    if (start.size() >= 4 && numberAt<std::int32_t>(start.data(), order) == 1)
    {
      return order;
    }
  }
  return {};
}

/**
 * Reads the sections of a binary Medit file (.meshb): the number 1, the version, then sections,
 * each with the code of its keyword, the position in the file of the next one, the number of its
 * entries, and these. Version 1 has coordinates of single precision, 3 and 4 have positions of 64
 * bits, 4 also integers.
 */
class BinaryMeditReader
{
public:
  BinaryMeditReader(InputFile& file, std::endian order, RawMeshBuilder& builder)
    : Input(file, 4, order)
    , Builder(builder)
    , Groups(builder)
  {
  }

  void read()
  {
    this->Input.locateErrors(
      [this]
      {
        this->readSections();
        this->VertexReferences->finish();
        this->VertexLabels.groupVertices(this->Builder, this->VertexReferences->column(), 1);
        this->Groups.finish();
        this->Builder.checkCorners();
      });
    this->ElementReferences->finish();
  }

private:
  void readSections()
  {
    this->Version = this->Input.take<std::int32_t>("the version");
    if (this->Version < 1 || this->Version > 4)
    {
      throw MeshError("the version " + std::to_string(this->Version) +
                      " is not read, only 1 to 4: save the mesh as text (.mesh)");
    }
    if (this->Version == 1)
    {
      this->Builder.useSinglePrecision();
    }
    this->VertexReferences.emplace(this->Builder, ColumnOf::Vertices, ReferenceName);
    this->ElementReferences.emplace(this->Builder, ColumnOf::Elements, ReferenceName);
    this->Builder.numberVertices(1);
    for (bool more = true; more;)
    {
      const auto code = this->Input.take<std::int32_t>("the code of a keyword");
      const std::int64_t next = this->Version >= 3
                                  ? this->Input.take<std::int64_t>("the place of a section")
                                  : this->Input.take<std::int32_t>("the place of a section");
      more = code != EndCode && next != 0;
      this->readSection(code);
      if (more)
      {
        this->moveTo(next);
      }
    }
  }

  void moveTo(std::int64_t next)
  {
    if (next < static_cast<std::int64_t>(this->Input.offset()))
    {
      throw MeshError("the next section should begin at byte " + std::to_string(next) +
                      ", which is before the end of this one");
    }
    this->Input.moveTo(static_cast<std::size_t>(next));
  }

  void readSection(std::int32_t code)
  {
    if (code == DimensionCode)
    {
      this->Dimension = this->Input.take<std::int32_t>("the dimension");
      if (this->Dimension != 2 && this->Dimension != 3)
      {
        throw MeshError("the dimension must be 2 or 3");
      }
      return;
    }
    if (code == VerticesCode)
    {
      this->readVertices();
      return;
    }
    if (std::ranges::find(HigherOrderCodes, code) != HigherOrderCodes.end())
    {
      throw MeshError("cells of higher order are not read: save the mesh with straight cells");
    }
    const auto* const section = std::ranges::find(MeditSections, code, &MeditSection::code);
    if (section != MeditSections.end())
    {
      this->readElements(*section);
    }
    const auto* const list = std::ranges::find(MeditLists, code, &MeditList::code);
    if (list != MeditLists.end() && !this->Builder.looks())
    {
      const std::int64_t count = this->count("the number of entries", 1, 0);
      for (std::int64_t i = 0; i < count; ++i)
      {
        this->Groups.list(*list, this->integer("a number of a list"));
      }
    }
  }

  std::int64_t integer(const char* what)
  {
    return this->Version == 4 ? this->Input.take<std::int64_t>(what)
                              : this->Input.take<std::int32_t>(what);
  }
  std::size_t integerBytes() const { return this->Version == 4 ? 8 : 4; }

  /** The number of entries with this many integers, and bytes of other numbers. */
  std::int64_t count(const char* what, std::size_t integers, std::size_t bytes)
  {
    const std::int64_t count = this->integer(what);
    this->Input.requireRoom(count, integers * this->integerBytes() + bytes, what);
    return count;
  }

  void readVertices()
  {
    if (this->Builder.vertices() > 0)
    {
      throw MeshError("there are two sections of vertices");
    }
    const auto axes = static_cast<std::size_t>(this->Dimension);
    const bool isSingle = this->Version == 1;
    const std::int64_t count =
      this->count("the number of vertices", 1, axes * (isSingle ? sizeof(float) : sizeof(double)));
    if (this->Builder.looks())
    {
      return; // the next section says where it begins
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::array<double, 3> point{};
      for (std::size_t axis = 0; axis < axes; ++axis)
      {
        point[axis] =
          isSingle ? static_cast<double>(this->Input.take<float>()) : this->Input.take<double>();
      }
      this->Builder.vertex(point[0], point[1], point[2]);
      const std::int64_t reference = this->integer("a label");
      this->VertexReferences->add(reference);
      this->VertexLabels.add(reference);
    }
  }

  void readElements(const MeditSection& section)
  {
    const std::int64_t count = this->count("the number of elements", section.corners + 1, 0);
    std::array<std::int64_t, 8> storage{};
    const std::span<std::int64_t> corners = std::span(storage).first(section.corners);
    this->Groups.beginSection(section, count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (std::int64_t& corner : corners)
      {
        corner = this->integer("a vertex of an element");
      }
      const std::int64_t reference = this->integer("a label");
      this->Groups.add(section, corners, reference);
      if (section.dimension > 1)
      {
        this->ElementReferences->add(reference, section.dimension);
      }
    }
  }

  BinaryInput Input;
  RawMeshBuilder& Builder;
  std::int32_t Version = 0, Dimension = 3;
  std::optional<LabelColumn> VertexReferences, ElementReferences;
  LabelGroups VertexLabels;
  MeditGroups Groups;
};

/** Whether the file begins with the number 1, a version, and the section of the dimension. */
bool isBinaryMedit(std::string_view start)
{
  constexpr std::size_t SignBytes = 12;
  const std::optional<std::endian> order = orderOfMedit(start);
  if (!order || start.size() < SignBytes)
  {
    return false;
  }
  const auto version = numberAt<std::int32_t>(start.data() + 4, *order);
  return version >= 1 && version <= 4 &&
         numberAt<std::int32_t>(start.data() + 8, *order) == DimensionCode;
}

constexpr FileSuffix BinaryMeditSuffixes[] = { { ".meshb" } };

void importBinaryMedit(InputFile& file, RawMeshBuilder& builder)
{
  const std::optional<std::endian> order = orderOfMedit(file.at(0, 4));
  if (!order)
  {
    file.fail(0, "a binary Medit file begins with the number 1");
  }
  BinaryMeditReader(file, *order, builder).read();
}

} // namespace

const Format BinaryMeditFormat{
  .name = "binary Medit",
  .suffixes = BinaryMeditSuffixes,
  .description = "versions 1 to 4",
  .cells = "as Medit",
  .hasMagic = isBinaryMedit,
  .alwaysHasMagic = true,
  .parse = parseWith<importBinaryMedit>,
  .typicalBytes = { 130, 4 },
};

} // namespace smg
