// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Abaqus/AbaqusLines.h"
#include "IO/Formats/Abaqus/AbaqusSets.h"
#include "IO/Formats/Abaqus/AbaqusShapes.h"
#include "IO/Formats/Abaqus/AbaqusWriter.h"
#include "IO/Import/FileNumbers.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Format.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>

// Input files of Abaqus and CalculiX: nodes and elements with labels of any order, sets and
// surfaces of them, also of other sets. Everything that is not of the mesh (materials, steps) is
// passed.

namespace smg
{

namespace
{

class AbaqusReader
{
public:
  AbaqusReader(InputFile& file, RawMeshBuilder& builder)
    : Lines(file)
    , Builder(builder)
    , Nodes(builder.workspace(), "nodes", true)
    , Elements(builder.workspace(), "elements", true)
    , Sets(builder)
  {
  }

  void read()
  {
    this->Builder.numberVertices(1);
    this->Lines.scanner().locateErrors(
      [this]
      {
        try
        {
          for (AbaqusKeyword keyword; this->Lines.next(keyword);)
          {
            this->readKeyword(keyword);
          }
        }
        catch (const MeshError& error)
        {
          throw MeshError(error.what(), error.line() > 0 ? error.line() : this->Lines.line());
        }
        this->finish();
      });
  }

private:
  void readKeyword(const AbaqusKeyword& keyword)
  {
    this->refuse(keyword);
    if (keyword.name == "NODE")
    {
      this->readNodes(keyword);
    }
    else if (keyword.name == "ELEMENT")
    {
      this->readElements(keyword);
    }
    else if (this->Builder.looks())
    {
      return;
    }
    else if (keyword.name == "NSET" || keyword.name == "ELSET")
    {
      this->readSet(keyword);
    }
    else if (keyword.name == "SURFACE")
    {
      this->readSurface(keyword);
    }
  }

  /** What has a mesh that is not in the file as it is. */
  void refuse(const AbaqusKeyword& keyword)
  {
    static constexpr std::string_view Generators[] = { "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN",
      "ELCOPY", "SYSTEM" };
    if (keyword.name == "INCLUDE" || keyword.has("INPUT"))
    {
      throw MeshError("another file is included, which is not read: put its content here");
    }
    if (std::ranges::find(Generators, keyword.name) != std::end(Generators))
    {
      throw MeshError("*" + keyword.name +
                      " makes or moves nodes or elements, which is not done: let the program that "
                      "knows it write the mesh as it is");
    }
    if (keyword.name == "PART" || keyword.name == "INSTANCE")
    {
      int& count = keyword.name == "PART" ? this->Parts : this->Instances;
      const bool isPlaced = keyword.name == "INSTANCE" && this->Lines.nextData();
      if (++count > 1 || isPlaced)
      {
        throw MeshError("there are several parts or instances, or one that is moved: only a single "
                        "one, where it is, is read: export the mesh without parts and assemblies");
      }
    }
  }

  void readNodes(const AbaqusKeyword& keyword)
  {
    if (this->Builder.looks())
    {
      return;
    }
    if (const std::string system = keyword.value("SYSTEM"); !system.empty() && system != "R")
    {
      throw MeshError("the nodes have cylindrical or spherical coordinates, which are not read");
    }
    const std::string name = keyword.value("NSET");
    const std::uint32_t set = name.empty() ? 0 : this->Sets.set(AbaqusSets::OfNodes, name);
    while (this->Lines.nextData())
    {
      const std::int64_t label = this->Lines.integer("the label of a node");
      const double x = this->Lines.real("a coordinate"), y = this->Lines.real("a coordinate");
      this->Builder.vertex(x, y, this->Lines.real("a coordinate"));
      this->Nodes.add(label);
      if (!name.empty())
      {
        this->Sets.addNode(set, label);
      }
    }
  }

  void readElements(const AbaqusKeyword& keyword)
  {
    const std::string type = upperCase(keyword.value("TYPE"));
    const std::optional<AbaqusShape> shape = abaqusShape(type);
    if (!shape)
    {
      this->OtherTypes.insert(type.substr(0, MaxTypeBytes));
      return;
    }
    std::optional<std::uint32_t> set;
    if (const std::string name = keyword.value("ELSET"); !name.empty())
    {
      set = this->Sets.set(AbaqusSets::OfElements, name, keyword.has("INTERNAL"));
    }
    std::array<std::int64_t, 8> storage{};
    const std::span<std::int64_t> corners = std::span(storage).first(shape->corners);
    while (this->Lines.nextData())
    {
      this->Builder.setLine(this->Lines.line());
      const std::int64_t label = this->Lines.integer("the label of an element");
      for (std::size_t k = 0; k < shape->nodes; ++k)
      {
        const std::int64_t node = this->Lines.integerInLines("a node of an element");
        if (k < corners.size())
        {
          corners[k] = node;
        }
      }
      if (!this->Builder.looks())
      {
        this->Elements.add(label);
        this->Sets.element(*shape, corners, set);
      }
      this->Builder.element(shape->dimension, corners, shape->nodes > shape->corners);
    }
  }

  void readSet(const AbaqusKeyword& keyword)
  {
    const bool ofNodes = keyword.name == "NSET";
    const AbaqusSets::Kind kind = ofNodes ? AbaqusSets::OfNodes : AbaqusSets::OfElements;
    const std::string name = keyword.value(keyword.name);
    if (name.empty())
    {
      throw MeshError("the set has no name");
    }
    if (ofNodes && keyword.has("ELSET"))
    {
      this->Builder.note(
        "The set of nodes " + inQuotes(name) + ", of those of elements, is left out.");
      return;
    }
    const std::uint32_t set = this->Sets.set(kind, name, keyword.has("INTERNAL"));
    while (this->Lines.nextData())
    {
      if (keyword.has("GENERATE"))
      {
        this->readRange(ofNodes, set);
        continue;
      }
      while (const std::optional<std::string_view> field = this->Lines.field())
      {
        if (!field->empty())
        {
          this->readMember(kind, set, *field, ListedElements::Whole);
        }
      }
    }
  }

  /** A label, or the name of another set. */
  void readMember(
    AbaqusSets::Kind kind, std::uint32_t set, std::string_view field, std::uint32_t side)
  {
    if (const std::optional<std::int64_t> label = parseInteger(field))
    {
      kind == AbaqusSets::OfNodes ? this->Sets.addNode(set, *label)
                                  : this->Sets.addElement(set, *label, side);
      return;
    }
    const std::optional<std::uint32_t> part = this->Sets.find(kind, nameOf(field));
    if (!part)
    {
      throw MeshError(
        inQuotes(field) + " is neither a label nor the name of a set before this line",
        this->Lines.line());
    }
    this->Sets.include(*part, set, side);
  }

  /** Without quotation marks, and without the instance before a point. */
  static std::string nameOf(std::string_view field)
  {
    const std::size_t point = field.find('.');
    field = field.substr(point == std::string_view::npos ? 0 : point + 1);
    const bool isQuoted = field.size() > 1 && field.front() == '"' && field.back() == '"';
    return std::string(isQuoted ? field.substr(1, field.size() - 2) : field);
  }

  void readRange(bool ofNodes, std::uint32_t set)
  {
    const FileNumbers& numbers = ofNodes ? this->Nodes : this->Elements;
    const std::int64_t first = this->Lines.integer("the first label of a range");
    const std::int64_t last = this->Lines.integer("the last label of a range");
    const std::string_view text = this->Lines.field().value_or("");
    const std::int64_t step = text.empty() ? 1 : parseInteger(text).value_or(0);
    const std::int64_t begin = std::max<std::int64_t>(first, 1);
    const std::int64_t end = std::min(last, numbers.largest());
    if (step < 1 || (end - begin) / step > 4 * numbers.count() + 1000)
    {
      throw MeshError("the range cannot be right: its step is not positive, or it has many more "
                      "labels than there are before this line",
        this->Lines.line());
    }
    for (std::int64_t label = begin; label <= end; label += step)
    {
      ofNodes ? this->Sets.addNode(set, label) : this->Sets.addElement(set, label);
    }
  }

  void readSurface(const AbaqusKeyword& keyword)
  {
    const std::string name = keyword.value("NAME");
    const std::string type = upperCase(keyword.value("TYPE"));
    const bool ofNodes = type == "NODE";
    if (name.empty() || keyword.has("COMBINE") || (!ofNodes && !type.empty() && type != "ELEMENT"))
    {
      this->Builder.note("The surface " + inQuotes(name) +
                         " is left out: only lists of nodes or of sides of elements are read.");
      return;
    }
    const AbaqusSets::Kind kind = ofNodes ? AbaqusSets::OfNodes : AbaqusSets::OfElements;
    const std::uint32_t set =
      this->Sets.set(ofNodes ? AbaqusSets::OfNodes : AbaqusSets::OfSides, name);
    while (this->Lines.nextData())
    {
      const std::string member(this->Lines.field().value_or(""));
      std::uint32_t side = ListedElements::Whole;
      if (!ofNodes)
      {
        const std::string face = upperCase(this->Lines.field().value_or(""));
        const std::optional<std::uint32_t> number = abaqusSideNumber(face);
        if (!number)
        {
          throw MeshError(inQuotes(face) + " of the surface " + inQuotes(name) +
                            " is no side of elements: they are S1 to S6, E1 to E4, SPOS and SNEG",
            this->Lines.line());
        }
        side = *number;
      }
      this->readMember(kind, set, member, side);
    }
  }

  void finish()
  {
    if (!this->OtherTypes.empty())
    {
      std::string names;
      for (const std::string& type : this->OtherTypes)
      {
        names += (names.empty() ? "" : ", ") + inQuotes(type);
      }
      this->Builder.note("Elements of these types are left out: " + names + '.');
    }
    if (this->Builder.looks())
    {
      return;
    }
    this->Nodes.finish();
    this->Elements.finish();
    this->Sets.finish(this->Nodes, this->Elements);
    this->Nodes.numberCorners(this->Builder);
    this->Builder.checkCorners();
  }

  static constexpr std::size_t MaxTypeBytes = 32;

  AbaqusLines Lines;
  RawMeshBuilder& Builder;
  FileNumbers Nodes, Elements;
  AbaqusSets Sets;
  std::set<std::string> OtherTypes;
  int Parts = 0, Instances = 0;
};

void importAbaqus(InputFile& file, RawMeshBuilder& builder)
{
  AbaqusReader(file, builder).read();
}

/** Keyword lines begin with a star and a letter, and comments with two stars. */
bool looksLikeAbaqus(std::string_view start, std::optional<std::uint64_t>)
{
  std::string_view text = textStart(start);
  const char lineEnd = lineEndOf(text);
  while (text.starts_with("**"))
  {
    text = trimmed(afterLine(text, lineEnd));
  }
  return text.size() > 1 && text[0] == '*' && std::isalpha(static_cast<unsigned char>(text[1]));
}

constexpr FileSuffix AbaqusSuffixes[] = { { ".inp", true, true, FileForm::Text } };

} // namespace

const Format AbaqusFormat{
  .name = "Abaqus",
  .suffixes = AbaqusSuffixes,
  .description = "input files, also of CalculiX: nodes, elements, sets and surfaces",
  .cells = "solids, shells and plane elements; the corners of higher-order ones",
  .groups = GroupForm::Sides,
  .looksLike = looksLikeAbaqus,
  .parse = parseWith<importAbaqus>,
  .typicalBytes = { 230, 4 },
  .bytes = bytesOfAbaqus,
  .writer = makeAbaqusWriter,
  .maxCorners = 4,
};

} // namespace smg
