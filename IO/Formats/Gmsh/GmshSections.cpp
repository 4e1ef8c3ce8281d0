// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/GmshSections.h"

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace smg
{

namespace
{

/** Types with consecutive numbers and the same shape. */
struct Run
{
  std::size_t first;
  GmshElementType shape;
  std::initializer_list<std::uint16_t> nodes;
};

constexpr std::size_t GmshTypes = 132;

/** Gmsh numbers the types in the order of their introduction: by order, complete ones and those
 * without inner nodes. */
constexpr std::array<GmshElementType, GmshTypes> makeGmshTypes()
{
  constexpr GmshElementType Point{ 0, 1 }, Line{ 1, 2 }, Triangle{ 2, 3 }, Quadrilateral{ 2, 4 },
    Tetrahedron{ 3, 4 }, Hexahedron{ 3, 8 }, Prism{ 3, 6 }, Pyramid{ 3, 5 };
  std::array<GmshElementType, GmshTypes> types{};
  for (const Run& run : {
         Run{ 1, Line, { 2 } },
         Run{ 2, Triangle, { 3 } },
         Run{ 3, Quadrilateral, { 4 } },
         Run{ 4, Tetrahedron, { 4 } },
         Run{ 5, Hexahedron, { 8 } },
         Run{ 6, Prism, { 6 } },
         Run{ 7, Pyramid, { 5 } },
         Run{ 8, Line, { 3 } },
         Run{ 9, Triangle, { 6 } },
         Run{ 10, Quadrilateral, { 9 } },
         Run{ 11, Tetrahedron, { 10 } },
         Run{ 12, Hexahedron, { 27 } },
         Run{ 13, Prism, { 18 } },
         Run{ 14, Pyramid, { 14 } },
         Run{ 15, Point, { 1 } },
         Run{ 16, Quadrilateral, { 8 } },
         Run{ 17, Hexahedron, { 20 } },
         Run{ 18, Prism, { 15 } },
         Run{ 19, Pyramid, { 13 } },
         Run{ 20, Triangle, { 9, 10, 12, 15, 15, 21 } },
         Run{ 26, Line, { 4, 5, 6 } },
         Run{ 29, Tetrahedron, { 20, 35, 56, 22, 28 } },
         Run{ 36, Quadrilateral, { 16, 25, 36, 12, 16, 20 } },
         Run{ 42, Triangle, { 28, 36, 45, 55, 66 } },
         Run{ 47, Quadrilateral, { 49, 64, 81, 100, 121 } },
         Run{ 52, Triangle, { 18, 21, 24, 27, 30 } },
         Run{ 57, Quadrilateral, { 24, 28, 32, 36, 40 } },
         Run{ 62, Line, { 7, 8, 9, 10, 11 } },
         Run{ 71, Tetrahedron, { 84, 120, 165, 220, 286 } },
         Run{ 79, Tetrahedron, { 34, 40, 46, 52, 58 } },
         Run{ 90, Prism, { 40, 75 } },
         Run{ 92, Hexahedron, { 64, 125, 216, 343, 512, 729, 1000 } },
         Run{ 99, Hexahedron, { 32, 44, 56, 68, 80, 92, 104 } },
         Run{ 106, Prism, { 126, 196, 288, 405, 550, 24, 33, 42, 51, 60, 69, 78 } },
         Run{ 118, Pyramid, { 30, 55, 91, 140, 204, 285, 385, 21, 29, 37, 45, 53, 61, 69 } },
       })
  {
    std::size_t type = run.first;
    for (const std::uint16_t nodes : run.nodes)
    {
      types[type++] = { run.shape.dimension, run.shape.corners, nodes };
    }
  }
  return types;
}

} // namespace

GmshElementType gmshElementType(std::int64_t type)
{
  static constexpr std::array<GmshElementType, GmshTypes> types = makeGmshTypes();
  return type < 0 || type >= std::int64_t(GmshTypes) ? GmshElementType()
                                                     : types[static_cast<std::size_t>(type)];
}

GmshTags::GmshTags(RawMeshBuilder& builder)
  : Builder(builder)
  , Physical(builder, ColumnOf::Elements, PhysicalTagName, NoGroup)
  , Geometrical(builder, ColumnOf::Elements, GeometricalTagName, FirstEntity)
  , GroupMemory(builder.workspace().pool())
{
}

void GmshTags::finish()
{
  this->Physical.finish();
  this->Geometrical.finish();
  if (this->Volumes > 0 && !this->HasSolids)
  {
    this->Builder.note("The geometry has " + counted(this->Volumes, "volume", "volumes") +
                       ", but the file no tetrahedra or other solids, so that it is read as a "
                       "surface. Gmsh writes only what is in a physical group: name the volumes, "
                       "too (Physical Volume), or set Mesh.SaveAll.");
  }
}

void GmshTags::readNames(GmshInput& input)
{
  const std::int64_t names = input.lineCount("the number of names", 5, 5);
  for (std::int64_t i = 0; i < names; ++i)
  {
    const GmshInput::PhysicalName named = input.physicalName();
    this->Builder.groups().setName(named.dimension, named.group, named.name);
  }
}

void GmshTags::readEntities(GmshInput& input)
{
  input.beginNumbers();
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& count : counts)
  {
    count = input.count("the number of entities", 8, 32);
  }
  this->Volumes = counts[3];
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension)
  {
    for (std::int64_t i = 0; i < counts[dimension]; ++i)
    {
      this->readEntity(input, dimension, false);
    }
  }
}

void GmshTags::readPartitionedEntities(GmshInput& input)
{
  input.beginNumbers();
  input.longInteger("the number of partitions");
  const std::int64_t ghosts = input.count("the number of ghost entities", 4, 8);
  for (std::int64_t i = 0; i < 2 * ghosts; ++i)
  {
    input.integer("a ghost entity or its partition");
  }
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& count : counts)
  {
    count = input.count("the number of entities", 8, 32);
  }
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension)
  {
    for (std::int64_t i = 0; i < counts[dimension]; ++i)
    {
      this->readEntity(input, dimension, true);
    }
  }
}

void GmshTags::readEntity(GmshInput& input, std::size_t dimension, bool isPartitioned)
{
  const auto skipIntegers = [&input](const char* number, const char* what)
  {
    const std::int64_t count = input.count(number, 2, 4);
    for (std::int64_t k = 0; k < count; ++k)
    {
      input.integer(what);
    }
  };
  const std::int64_t entity = input.integer("the tag of an entity");
  bool isBorder = false; // between parts: it has the tags of groups of what was cut
  if (isPartitioned)
  {
    isBorder = input.integer("the dimension of the entity that was cut") >
               static_cast<std::int64_t>(dimension);
    input.integer("the tag of the entity that was cut");
    skipIntegers("the number of partitions of an entity", "a partition");
  }
  // A point has a box, too, in version 4.0.
  for (int bound = dimension == 0 && !input.isFourZero() ? 3 : 0; bound < 6; ++bound)
  {
    input.number("a bound of an entity");
  }
  const std::int64_t groups = input.count("the number of physical groups", 2, 4);
  for (std::int64_t k = 0; k < groups; ++k)
  {
    const std::int64_t group = input.integer("the tag of a physical group");
    if (!isBorder)
    {
      this->addGroup(dimension, entity, group);
    }
  }
  if (dimension > 0)
  {
    skipIntegers("the number of bounding entities", "the tag of a bounding entity");
  }
}

void GmshTags::addGroup(std::size_t dimension, std::int64_t entity, std::int64_t group)
{
  constexpr std::size_t Step = 1024;
  constexpr std::int64_t NodeBytes = 64; // of a map
  auto& entities = this->Groups[dimension];
  const auto [found, isNew] = entities.try_emplace(entity);
  if (isNew && entities.size() % Step == 1)
  {
    this->GroupMemory.resize(this->GroupMemory.bytes() + std::int64_t(Step) * NodeBytes);
  }
  Physicals& all = found->second;
  // Gmsh negates the tag of a group in which an entity is turned.
  group = group == INT64_MIN ? NoGroup : std::abs(group);
  GroupTable& table = this->Builder.groups();
  all.first = all.first == NoGroup ? group : all.first;
  all.set = table.join(all.set,
    group == NoGroup ? GroupTable::None : table.numbered(static_cast<int>(dimension), group));
}

GmshTags::Physicals GmshTags::groupsOf(std::int64_t dimension, std::int64_t entity) const
{
  if (dimension < 0 || dimension >= std::int64_t(this->Groups.size()))
  {
    return {};
  }
  const auto& entities = this->Groups[static_cast<std::size_t>(dimension)];
  const auto found = entities.find(entity);
  return found == entities.end() ? Physicals{} : found->second;
}

} // namespace smg
