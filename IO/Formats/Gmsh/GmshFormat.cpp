// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Gmsh/GmshData.h"
#include "IO/Formats/Gmsh/GmshInput.h"
#include "IO/Formats/Gmsh/GmshSections.h"
#include "IO/Formats/Gmsh/WriteGmsh.h"
#include "IO/Import/FileNumbers.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"

#include <array>
#include <string>
#include <vector>

namespace smg
{

namespace
{

/** Reads the sections of a Gmsh file. */
class GmshReader
{
public:
  GmshReader(InputFile& file, RawMeshBuilder& builder)
    : Input(file, &builder.workspace())
    , Builder(builder)
    , Nodes(builder.workspace(), "nodes")
    , NodeNumbers(builder.workspace())
    , ElementNumbers(builder.workspace())
    , Tags(builder)
    , Data(builder)
  {
  }

  void read()
  {
    try
    {
      for (std::string name = this->Input.sectionName(); !name.empty();
           name = this->Input.sectionName())
      {
        this->readSection(name);
      }
      this->Data.finish(this->NodeNumbers, this->ElementNumbers);
      this->Tags.finish();
    }
    catch (const MeshError& error)
    {
      this->Input.fail(error.what());
    }
  }

private:
  void readSection(const std::string& name)
  {
    // Version 1 has only these sections.
    const bool isFirstVersion = name == "$NOD" || name == "$ELM";
    const std::string end = (isFirstVersion ? "$END" : "$End") + name.substr(1);
    if (isFirstVersion && !this->Input.hasFormat())
    {
      this->Input.setFirstVersion();
    }
    if (name == "$MeshFormat")
    {
      this->Input.readFormat();
      this->Input.endSection(end);
      return;
    }
    if (name == "$PhysicalNames")
    {
      this->Tags.readNames(this->Input);
      this->Input.endSection(end);
      return;
    }
    const bool areOfNodes = name == "$NodeData", areOfElements = name == "$ElementData";
    if ((areOfNodes || areOfElements) && this->Input.hasFormat() && !this->Builder.looks())
    {
      this->Data.read(this->Input, areOfNodes ? ColumnOf::Vertices : ColumnOf::Elements);
      this->Input.endSection(end);
      return;
    }
    if (name == "$ElementNodeData" && !this->Builder.looks())
    {
      this->Builder.note("Data of the nodes of elements ($ElementNodeData) are left out.");
    }
    const bool areEntities = name == "$Entities" && this->Input.hasBlocks();
    const bool areParts = name == "$PartitionedEntities" && this->Input.hasBlocks();
    const bool hasGroups = areEntities || areParts;
    const bool isParametric = name == "$ParametricNodes";
    const bool areNodes = name == "$Nodes" || name == "$NOD" || isParametric;
    if (!areNodes && name != "$Elements" && name != "$ELM" && !hasGroups)
    {
      this->Input.skipSection(end);
      return;
    }
    if (!this->Input.hasFormat())
    {
      this->Input.fail("the section $MeshFormat is missing");
    }
    if (areNodes && this->Builder.looks() && !this->Input.isBinary())
    {
      this->HasNodes = true;
      this->Input.skipSection(end);
      return;
    }
    if (hasGroups)
    {
      areEntities ? this->Tags.readEntities(this->Input)
                  : this->Tags.readPartitionedEntities(this->Input);
    }
    else
    {
      areNodes ? this->readNodeSection(isParametric) : this->readElementSection();
    }
    this->Input.endNumbers();
    this->Input.endSection(end);
  }

  void readNodeSection(bool isParametric)
  {
    if (this->HasNodes)
    {
      this->Input.fail("there are two sections of nodes");
    }
    this->HasNodes = true;
    this->Input.hasBlocks() ? this->readNodeBlocks() : this->readNodes(isParametric);
    this->Nodes.finish();
    this->Nodes.numberCorners(this->Builder);
  }

  void readElementSection()
  {
    if (!this->HasNodes)
    {
      this->Input.fail("the elements come before the nodes");
    }
    if (this->Input.hasBlocks())
    {
      this->readElementBlocks();
    }
    else
    {
      this->Input.isBinary() ? this->readElementGroups() : this->readElements();
    }
  }

  void addNode(std::int64_t tag)
  {
    this->NodeNumbers.add(tag, this->Nodes.count());
    this->Nodes.add(tag);
  }

  void readPoint()
  {
    std::array<double, 3> point{};
    for (double& coordinate : point)
    {
      coordinate = this->Input.number("a coordinate of a node");
    }
    this->Builder.vertex(point[0], point[1], point[2]);
  }

  /** `areParametric`: with the entity of the geometry to which each node belongs, and its
   * parameters there. */
  void readNodes(bool areParametric)
  {
    constexpr std::size_t NodeBytes = 28;
    const std::int64_t nodes = this->Input.lineCount("the number of nodes", 8, NodeBytes);
    this->Input.beginNumbers();
    if (this->Builder.looks() && !areParametric)
    {
      this->Input.skipNumbers(nodes, NodeBytes);
      return;
    }
    for (std::int64_t i = 0; i < nodes; ++i)
    {
      this->addNode(this->Input.integer("the tag of a node"));
      this->readPoint();
      if (areParametric)
      {
        const std::int64_t dimension = this->Input.integer("the dimension of an entity");
        this->Input.integer("the tag of an entity");
        const std::int64_t parameters = dimension == 1 || dimension == 2 ? dimension : 0;
        for (std::int64_t k = 0; k < parameters; ++k)
        {
          this->Input.number("a parameter of a node");
        }
      }
    }
  }

  void readNodeBlocks()
  {
    this->Input.beginNumbers();
    const std::int64_t blocks = this->Input.count("the number of blocks", 8, 20);
    const std::int64_t nodes = this->Input.count("the number of nodes", 8, 28);
    this->skipLimits();
    for (std::int64_t block = 0; block < blocks; ++block)
    {
      this->readNodeBlock();
    }
    if (!this->Builder.looks())
    {
      this->checkSum(this->Nodes.count(), nodes, "nodes");
    }
  }

  /** The least and the largest tag, which version 4.0 does not have. */
  void skipLimits()
  {
    if (!this->Input.isFourZero())
    {
      this->Input.longInteger("the least tag");
      this->Input.longInteger("the largest tag");
    }
  }

  struct Entity
  {
    std::int64_t dimension, tag;
  };

  /** The entity of a block: its dimension and tag, in version 4.0 the other way round. */
  Entity readEntity()
  {
    const bool tagFirst = this->Input.isFourZero();
    const std::int64_t first =
      this->Input.integer(tagFirst ? "the tag of an entity" : "the dimension of an entity");
    const std::int64_t second =
      this->Input.integer(tagFirst ? "the dimension of an entity" : "the tag of an entity");
    return tagFirst ? Entity{ second, first } : Entity{ first, second };
  }

  /** A tag of a node or element in a block. */
  std::int64_t blockTag(const char* what)
  {
    return this->Input.isFourZero() ? this->Input.integer(what) : this->Input.longInteger(what);
  }

  void readNodeBlock()
  {
    const std::int64_t dimension = this->readEntity().dimension;
    const std::int64_t parametric = this->Input.integer("whether there are parameters");
    if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1)
    {
      this->Input.fail("a block of nodes begins with its dimension, 0 to 3, its tag, and whether "
                       "there are parameters, 0 or 1");
    }
    const std::int64_t nodes = this->Input.count("the number of nodes of a block", 8, 28);
    const bool tagsFirst = !this->Input.isFourZero();
    if (this->Builder.looks())
    {
      const std::int64_t numbers = 3 + dimension * parametric;
      this->Input.skipNumbers(nodes, (tagsFirst ? sizeof(std::int64_t) : sizeof(std::int32_t)) +
                                       static_cast<std::size_t>(numbers) * sizeof(double));
      return;
    }
    for (std::int64_t i = 0; tagsFirst && i < nodes; ++i)
    {
      this->addNode(this->blockTag("the tag of a node"));
    }
    for (std::int64_t i = 0; i < nodes; ++i)
    {
      if (!tagsFirst)
      {
        this->addNode(this->blockTag("the tag of a node"));
      }
      this->readPoint();
      for (std::int64_t k = 0; k < dimension * parametric; ++k)
      {
        this->Input.number("a parameter of a node");
      }
    }
  }

  /** Elements of versions 1 and 2, as text: each with its type. */
  void readElements()
  {
    const std::int64_t elements = this->Input.lineCount("the number of elements", 8, 8);
    for (std::int64_t i = 0; i < elements; ++i)
    {
      const std::int64_t number = this->Input.integer("the tag of an element");
      const GmshElementType type = this->readType();
      const GroupAndEntity tags = this->readTags(
        this->Input.isFirstVersion() ? 2 : this->Input.count("the number of tags", 2, 4));
      if (this->Input.isFirstVersion())
      {
        this->checkNodes(type, this->Input.integer("the number of nodes of an element"));
      }
      this->readTaggedElement(number, type, tags);
    }
  }

  /** Elements of version 2, binary: one header for a number of elements of the same type. */
  void readElementGroups()
  {
    const std::int64_t elements = this->Input.lineCount("the number of elements", 8, 8);
    this->Input.beginNumbers();
    for (std::int64_t done = 0; done < elements;)
    {
      const GmshElementType type = this->readType();
      const std::int64_t group = this->Input.integer("the number of elements of a group");
      const std::int64_t tags = this->Input.integer("the number of tags");
      this->Input.requireRoom(tags, "the number of tags", sizeof(std::int32_t));
      this->Input.requireRoom(group, "the number of elements of a group",
        sizeof(std::int32_t) * static_cast<std::size_t>(1 + tags + type.nodes));
      if (group < 1 || group > elements - done)
      {
        this->Input.fail("a group has " + std::to_string(group) + " elements, but there are " +
                         std::to_string(elements - done) + " left");
      }
      for (std::int64_t i = 0; i < group; ++i)
      {
        const std::int64_t number = this->Input.integer("the tag of an element");
        this->readTaggedElement(number, type, this->readTags(tags));
      }
      done += group;
    }
  }

  void readElementBlocks()
  {
    this->Input.beginNumbers();
    const std::int64_t blocks = this->Input.count("the number of blocks", 8, 20);
    const std::int64_t elements = this->Input.count("the number of elements", 4, 8);
    const std::int64_t before = this->Builder.elements();
    this->skipLimits();
    for (std::int64_t block = 0; block < blocks; ++block)
    {
      const Entity entity = this->readEntity();
      const GmshTags::Physicals groups = this->Tags.groupsOf(entity.dimension, entity.tag);
      const GmshElementType type = this->readType();
      const std::int64_t count = this->Input.count("the number of elements of a block", 4, 8);
      for (std::int64_t i = 0; i < count; ++i)
      {
        const std::int64_t number = this->blockTag("the tag of an element");
        this->readCorners(type, [this] { return this->blockTag("a node of an element"); });
        this->addElement(number, type, groups, entity.tag);
      }
    }
    this->checkSum(this->Builder.elements() - before, elements, "elements");
  }

  /** Of version 1, which says how many nodes follow. */
  void checkNodes(GmshElementType type, std::int64_t nodes)
  {
    if (nodes != type.nodes)
    {
      this->Input.fail("an element of " + std::to_string(nodes) + " nodes has a type of " +
                       std::to_string(type.nodes));
    }
  }

  GmshElementType readType()
  {
    const std::int64_t number = this->Input.integer("the type of an element");
    const GmshElementType type = gmshElementType(number);
    if (type.nodes == 0)
    {
      this->Input.fail("elements of type " + std::to_string(number) + " are not known");
    }
    return type;
  }

  struct GroupAndEntity
  {
    std::int64_t group, entity;
  };

  /** The tags of an element of version 2: a physical group, an entity, and others. */
  GroupAndEntity readTags(std::int64_t tags)
  {
    std::array<std::int64_t, 2> first{ GmshTags::NoGroup, GmshTags::FirstEntity };
    for (std::int64_t k = 0; k < tags; ++k)
    {
      const std::int64_t tag = this->Input.integer("a tag of an element");
      if (k < 2)
      {
        first[static_cast<std::size_t>(k)] = tag;
      }
    }
    return { first[0], first[1] };
  }

  /** An element of versions 1 and 2. One that is in several groups is there once for each, one
   * after the other. */
  void readTaggedElement(std::int64_t number, GmshElementType type, GroupAndEntity tags)
  {
    const std::array before = this->Corners;
    this->readCorners(type, [this] { return this->Input.integer("a node of an element"); });
    const GmshTags::Physicals groups = this->Tags.groupOf(type.dimension, tags.group);
    const bool isLast = this->LastType == type && before == this->Corners &&
                        tags.group != GmshTags::NoGroup && this->LastGroup != GmshTags::NoGroup &&
                        tags.group != this->LastGroup;
    this->LastType = type;
    this->LastGroup = tags.group;
    if (isLast)
    {
      this->ElementNumbers.add(number, this->Builder.elements() - 1, type.dimension);
      this->Builder.alsoIn(this->Builder.elements() - 1, type.dimension,
        std::span(this->Corners).first(type.corners), groups.set);
      return;
    }
    this->addElement(number, type, groups, tags.entity);
  }

  void readCorners(GmshElementType type, const auto& readTag)
  {
    this->Corners.fill(0);
    for (std::size_t k = 0; k < type.nodes; ++k)
    {
      const std::int64_t tag = readTag();
      if (k < type.corners)
      {
        this->Corners[k] = tag;
      }
    }
  }

  /** Adds the element whose corners were read. */
  void addElement(std::int64_t number, GmshElementType type, const GmshTags::Physicals& groups,
    std::int64_t entity)
  {
    this->ElementNumbers.add(number, this->Builder.elements(), type.dimension);
    this->Tags.add(groups, type.dimension, entity);
    this->Builder.element(
      type.dimension, std::span(this->Corners).first(type.corners), type.nodes > type.corners);
  }

  void checkSum(std::int64_t found, std::int64_t promised, const std::string& things)
  {
    if (found != promised)
    {
      this->Input.fail("the blocks have " + std::to_string(found) + ' ' + things +
                       ", but the section says " + std::to_string(promised));
    }
  }

  GmshInput Input;
  RawMeshBuilder& Builder;
  FileNumbers Nodes;
  GmshNumbers NodeNumbers, ElementNumbers; ///< for data
  GmshTags Tags;
  GmshData Data;
  std::array<std::int64_t, 8> Corners{}; ///< of the last element
  GmshElementType LastType;
  std::int64_t LastGroup = GmshTags::NoGroup;
  bool HasNodes = false;
};

void importGmsh(InputFile& file, RawMeshBuilder& builder)
{
  GmshReader(file, builder).read();
}

bool isGmsh(std::string_view start)
{
  const std::string_view text = textStart(start);
  return text.starts_with("$MeshFormat") || text.starts_with("$NOD");
}

constexpr FileSuffix GmshSuffixes[] = { { ".msh", true, true, FileForm::Text } };

} // namespace

const Format GmshFormat{
  .name = "Gmsh",
  .suffixes = GmshSuffixes,
  .description = "versions 1.0, 2.x, 4.0 and 4.1, text and binary; written as 2.2",
  .cells = "all of Gmsh; the corners of higher-order cells",
  .holdsColumns = true,
  .groups = GroupForm::Elements,
  .hasMagic = isGmsh,
  .parse = parseWith<importGmsh>,
  .typicalBytes = { 250, 4 },
  .bytes = bytesOfGmsh,
  .writer = makeGmshWriter,
  .scratch = scratchOfGmsh,
  .maxCorners = 4,
};

} // namespace smg
