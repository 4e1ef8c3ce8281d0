// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/GmshTags.h"

#include "IO/Mesh/AttributeNames.h"

#include <cstddef>

namespace smg
{

GmshTags::GmshTags(RawMeshBuilder& builder)
  : Physical(builder, ImportColumn::Of::Elements, PhysicalTagName, NoGroup)
  , Geometrical(builder, ImportColumn::Of::Elements, GeometricalTagName, FirstEntity)
  , GroupMemory(builder.workspace().pool())
{
}

void GmshTags::readEntities(GmshInput& input)
{
  input.beginNumbers();
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& count : counts)
  {
    count = input.count("the number of entities", 8, 32);
  }
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension)
  {
    for (std::int64_t i = 0; i < counts[dimension]; ++i)
    {
      const std::int64_t entity = input.integer("the tag of an entity");
      for (int bound = dimension == 0 ? 3 : 0; bound < 6; ++bound)
      {
        input.number("a bound of an entity");
      }
      const std::int64_t groups = input.count("the number of physical groups", 2, 4);
      for (std::int64_t k = 0; k < groups; ++k)
      {
        const std::int64_t group = input.integer("the tag of a physical group");
        this->setGroup(dimension, entity, group);
      }
      const std::int64_t bounding =
        dimension == 0 ? 0 : input.count("the number of bounding entities", 2, 4);
      for (std::int64_t k = 0; k < bounding; ++k)
      {
        input.integer("the tag of a bounding entity");
      }
    }
  }
}

void GmshTags::setGroup(std::size_t dimension, std::int64_t entity, std::int64_t group)
{
  constexpr std::size_t Step = 1024;
  constexpr std::int64_t NodeBytes = 64; // of a map
  auto& groups = this->Groups[dimension];
  const bool isNew = groups.emplace(entity, group).second; // the first one stays
  if (isNew && groups.size() % Step == 1)
  {
    this->GroupMemory.resize(this->GroupMemory.bytes() + std::int64_t(Step) * NodeBytes);
  }
}

std::int64_t GmshTags::groupOf(std::int64_t dimension, std::int64_t entity) const
{
  if (dimension < 0 || dimension >= std::int64_t(this->Groups.size()))
  {
    return NoGroup;
  }
  const auto& groups = this->Groups[static_cast<std::size_t>(dimension)];
  const auto found = groups.find(entity);
  return found == groups.end() ? NoGroup : found->second;
}

void GmshTags::add(std::int64_t group, std::int64_t entity)
{
  this->Physical.add(group);
  this->Geometrical.add(entity);
}

void GmshTags::finish()
{
  this->Physical.finish();
  this->Geometrical.finish();
}

} // namespace smg
