// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Nastran/NastranCards.h"
#include "IO/Import/FileNumbers.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/ListedElements.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

namespace
{

/** An entry of elements: number, property, nodes. */
struct NastranElement
{
  std::string_view name;
  int dimension;
  std::size_t corners;
  bool hasMore; ///< fields behind the corners are nodes
};
constexpr NastranElement NastranElements[] = { { "CTETRA", 3, 4, true }, { "CPYRAM", 3, 5, true },
  { "CPYRA", 3, 5, true }, { "CPENTA", 3, 6, true }, { "CHEXA", 3, 8, true },
  { "CTRIA3", 2, 3, false }, { "CTRIAR", 2, 3, false }, { "CTRIA6", 2, 3, true },
  { "CQUAD4", 2, 4, false }, { "CQUADR", 2, 4, false }, { "CQUAD8", 2, 4, true },
  { "CQUAD", 2, 4, true }, { "CROD", 1, 2, false }, { "CBAR", 1, 2, false },
  { "CBEAM", 1, 2, false }, { "CTUBE", 1, 2, false } };

/** Reads the grid points and elements of a bulk data file: the numbers of properties are groups,
 * and so are sets of grid points (SET1, SET3). */
class NastranReader
{
public:
  NastranReader(InputFile& file, RawMeshBuilder& builder)
    : Cards(file)
    , Builder(builder)
    , Nodes(builder.workspace(), "grid points", true)
    , Listed(builder.workspace())
    , Properties(builder, ColumnOf::Elements, ReferenceName, 1)
  {
  }

  void read()
  {
    this->Builder.numberVertices(1);
    this->Cards.scanner().locateErrors(
      [this]
      {
        try
        {
          while (this->Cards.next() && this->Cards.name() != "ENDDATA")
          {
            this->readCard();
          }
        }
        catch (const MeshError& error)
        {
          throw MeshError(error.what(), error.line() > 0 ? error.line() : this->Cards.line());
        }
        this->finish();
      });
    this->Properties.finish();
  }

private:
  void readCard()
  {
    const std::string& name = this->Cards.name();
    if (name == "GRID")
    {
      this->readGrid();
    }
    else if (name == "SET1" || name == "SET3")
    {
      this->readSet();
    }
    else if (name.starts_with("INCLUDE"))
    {
      throw MeshError("another file is included, which is not read: put its content here");
    }
    else if (const auto* const element =
               std::ranges::find(NastranElements, name, &NastranElement::name);
             element != std::end(NastranElements))
    {
      this->readElement(*element);
    }
  }

  void readGrid()
  {
    if (this->Builder.looks())
    {
      return;
    }
    const std::int64_t number = this->Cards.requiredInteger(0, "the number of a grid point");
    if (this->Cards.integer(1, "the number of a coordinate system").value_or(0) != 0)
    {
      throw MeshError("the grid point " + std::to_string(number) +
                      " has coordinates in another system than the basic one, which are not read");
    }
    std::array<double, 3> point{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = this->Cards.real(2 + axis, "a coordinate").value_or(0.0);
    }
    this->Builder.vertex(point[0], point[1], point[2]);
    this->Nodes.add(number);
  }

  void readElement(const NastranElement& element)
  {
    this->Cards.requiredInteger(0, "the number of an element");
    // Without a property an element has one of its own.
    const std::int64_t property = this->Cards.integer(1, "the number of a property").value_or(0);
    std::array<std::int64_t, 8> corners{};
    for (std::size_t k = 0; k < element.corners; ++k)
    {
      corners[k] = this->Cards.requiredInteger(2 + k, "a grid point of an element");
    }
    bool hasMore = false;
    for (std::size_t i = 2 + element.corners; element.hasMore && i < this->Cards.fields(); ++i)
    {
      hasMore = hasMore || this->Cards.integer(i, "a grid point of an element").value_or(0) > 0;
    }
    this->Builder.setLine(this->Cards.line());
    this->Builder.setGroups(property == 0
                              ? GroupTable::None
                              : this->Builder.groups().numbered(element.dimension, property));
    this->Builder.element(element.dimension, std::span(corners).first(element.corners), hasMore);
    this->Properties.add(property);
  }

  void readSet()
  {
    const std::int64_t number = this->Cards.requiredInteger(0, "the number of a set");
    const bool isTyped = this->Cards.name() == "SET3";
    if (this->Builder.looks() || (isTyped && this->Cards.field(1) != "GRID"))
    {
      return;
    }
    const GroupSet set = this->Builder.groups().numbered(0, number);
    std::int64_t last = 0;
    for (std::size_t i = isTyped ? 2 : 1; i < this->Cards.fields(); ++i)
    {
      if (this->Cards.field(i) == "THRU")
      {
        this->addRange(last + 1, this->Cards.requiredInteger(++i, "the end of a range"), set);
      }
      else if (const auto node = this->Cards.integer(i, "a grid point of a set"))
      {
        last = *node;
        this->Listed.put(last, set);
      }
    }
  }

  void addRange(std::int64_t first, std::int64_t last, GroupSet set)
  {
    constexpr std::size_t Most = 1 << 20;
    if (this->Ranges.size() == Most)
    {
      throw MeshError("there are more than " + std::to_string(Most) + " ranges of grid points");
    }
    this->Ranges.push_back({ first, last, set });
  }

  void finish()
  {
    if (this->Builder.looks())
    {
      return;
    }
    // Grid points may come after the sets.
    const std::int64_t largest = this->Nodes.largest();
    const std::int64_t most = 4 * this->Nodes.count() + 1000;
    for (const Range& range : this->Ranges)
    {
      const std::int64_t first = std::max<std::int64_t>(range.first, 1);
      const std::int64_t last = std::min(range.last, largest);
      if (last - first > most)
      {
        throw MeshError("a range of grid points has many more numbers than there are grid points");
      }
      for (std::int64_t node = first; node <= last; ++node)
      {
        this->Listed.put(node, range.set);
      }
    }
    this->Nodes.finish();
    this->Listed.finish(this->Nodes, [this](std::int64_t node, std::uint32_t set)
      { this->Builder.grouped(0, std::span(&node, 1), static_cast<GroupSet>(set)); });
    this->Nodes.numberCorners(this->Builder);
    this->Builder.checkCorners();
  }

  struct Range
  {
    std::int64_t first, last;
    GroupSet set;
  };

  NastranCards Cards;
  RawMeshBuilder& Builder;
  FileNumbers Nodes;
  ListedNodes Listed;
  std::vector<Range> Ranges;
  LabelColumn Properties;
};

void importNastran(InputFile& file, RawMeshBuilder& builder)
{
  NastranReader(file, builder).read();
}

constexpr FileSuffix NastranSuffixes[] = { { ".bdf", true, true, FileForm::Text },
  { ".nas", true, true, FileForm::Text } };

} // namespace

const Format NastranFormat{
  .name = "Nastran",
  .suffixes = NastranSuffixes,
  .description = "bulk data in small, large and free fields",
  .cells = "solids and shells; the corners of higher-order ones",
  .parse = parseWith<importNastran>,
  .typicalBytes = { 250, 4 },
};

} // namespace smg
