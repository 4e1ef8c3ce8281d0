// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Medit/MeditSections.h"

#include <string>

namespace smg
{

void MeditGroups::beginSection(const MeditSection& section, std::int64_t count)
{
  constexpr std::size_t MostSections = 1000;
  if (section.dimension < 3 && this->Stretches.size() < MostSections)
  {
    this->Stretches.push_back({ section.keyword,
      section.dimension == 1 ? this->EdgeCount : this->Builder.elements(), count });
  }
}

void MeditGroups::add(
  const MeditSection& section, std::span<const std::int64_t> corners, std::int64_t reference)
{
  const GroupSet set = reference == 0
                         ? GroupTable::None
                         : this->Builder.groups().numbered(section.dimension, reference);
  if (section.dimension == 1)
  {
    this->Edges.add(static_cast<std::uint32_t>(this->EdgeCount++), { 1 }, corners);
    this->Builder.grouped(1, corners, set);
    return;
  }
  if (section.dimension == 2)
  {
    this->Surfaces.add(static_cast<std::uint32_t>(this->Builder.elements()), { 2 }, corners);
  }
  this->Builder.setGroups(set);
  this->Builder.element(section.dimension, corners);
}

void MeditGroups::list(const MeditList& list, std::int64_t number)
{
  if (list.items.empty())
  {
    this->Builder.grouped(0, std::span(&number, 1), this->Builder.groups().named(0, list.group));
    return;
  }
  std::int64_t left = number;
  for (const Stretch& stretch : this->Stretches)
  {
    if (stretch.keyword == list.items && left > 0 && left <= stretch.count)
    {
      const bool areEdges = list.items == "Edges";
      const auto element = static_cast<std::uint32_t>(stretch.first + (left - 1));
      (areEdges ? this->Edges : this->Surfaces)
        .put(element, this->Builder.groups().named(areEdges ? 1 : 2, list.group));
      return;
    }
    left -= stretch.keyword == list.items ? stretch.count : 0;
  }
  throw MeshError("number " + std::to_string(number) + " of the section '" +
                  std::string(list.keyword) + "' is not one of the section '" +
                  std::string(list.items) + "' before it");
}

void MeditGroups::finish()
{
  this->Edges.finish([this](const ListedElements::Found& found)
    { this->Builder.grouped(1, found.corners, static_cast<GroupSet>(found.list)); });
  this->Surfaces.finish([this](const ListedElements::Found& found)
    { this->Builder.alsoIn(found.element, 2, found.corners, static_cast<GroupSet>(found.list)); });
}

} // namespace smg
