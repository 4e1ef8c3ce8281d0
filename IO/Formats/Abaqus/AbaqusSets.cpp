// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Abaqus/AbaqusSets.h"

#include "IO/Formats/Abaqus/AbaqusLines.h"
#include "IO/Formats/Abaqus/AbaqusShapes.h"
#include "Solver/Core/Text.h"

#include <utility>

namespace smg
{
namespace
{

constexpr std::uint32_t Whole = ListedElements::Whole;
/** The element is in the group of the set already, and now in what else that means. */
constexpr std::uint32_t Further = Whole - 1;

} // namespace

AbaqusSets::AbaqusSets(RawMeshBuilder& builder)
  : Builder(builder)
  , Nodes(builder.workspace())
  , ElementLabels(builder.workspace())
  , ElementEntries(builder.workspace())
  , Listed(builder.workspace())
{
}

std::uint32_t AbaqusSets::set(Kind kind, const std::string& name, bool isInternal)
{
  const auto [found, isNew] =
    this->ByName[kind].emplace(upperCase(name), static_cast<std::uint32_t>(this->Sets.size()));
  if (isNew)
  {
    if (this->Sets.size() >= GroupSets::Most)
    {
      throw MeshError("there are more than " + std::to_string(GroupSets::Most) + " sets");
    }
    this->Sets.push_back({ kind, name, isInternal, {} });
  }
  return found->second;
}

std::optional<std::uint32_t> AbaqusSets::find(Kind kind, const std::string& name) const
{
  const auto found = this->ByName[kind].find(upperCase(name));
  return found == this->ByName[kind].end() ? std::nullopt : std::optional(found->second);
}

void AbaqusSets::addNode(std::uint32_t set, std::int64_t label)
{
  this->Nodes.put(label, set);
}

void AbaqusSets::addElement(std::uint32_t set, std::int64_t label, std::uint32_t side)
{
  this->ElementLabels.put(ListedNodes::placeOf(label));
  this->ElementEntries.put({ set, side });
}

void AbaqusSets::include(std::uint32_t part, std::uint32_t whole, std::uint32_t side)
{
  constexpr std::size_t Most = 65536;
  std::vector<Inclusion>& wholes = this->Sets[part].wholes;
  if (wholes.size() >= Most)
  {
    throw MeshError("a set is part of more than " + std::to_string(Most) + " others");
  }
  wholes.push_back({ whole, side });
}

void AbaqusSets::element(
  ElementKind kind, std::span<const std::int64_t> corners, std::optional<std::uint32_t> set)
{
  const std::int64_t number = this->Builder.elements();
  this->Listed.add(static_cast<std::uint32_t>(number), kind, corners);
  const std::pair now(set.value_or(NoIndex), kind);
  if (now != this->Current)
  {
    this->Current = now;
    const bool isGroup = set && !this->Sets[*set].isInternal;
    this->Builder.setGroups(isGroup ? this->groupsOf(*set, kind.dimension) : GroupTable::None);
  }
  if (!set)
  {
    return;
  }
  constexpr std::size_t Most = 1 << 20;
  if (this->Stretches.empty() || this->Stretches.back().set != *set ||
      this->Stretches.back().end != number)
  {
    if (this->Stretches.size() >= Most)
    {
      throw MeshError("there are more than " + std::to_string(Most) + " blocks of elements");
    }
    this->Stretches.push_back({ *set, number, number });
  }
  ++this->Stretches.back().end;
}

/** Follows the sets of which a set is part, each once. */
AbaqusSets::Meaning AbaqusSets::meaningOf(std::uint32_t set) const
{
  Meaning meaning;
  std::vector<std::uint32_t> open{ set };
  std::vector<bool> seen(this->Sets.size(), false);
  seen[set] = true;
  while (!open.empty())
  {
    const std::uint32_t next = open.back();
    open.pop_back();
    if (!this->Sets[next].isInternal)
    {
      meaning.sets.push_back(next);
    }
    for (const Inclusion& inclusion : this->Sets[next].wholes)
    {
      if (inclusion.side != Whole)
      {
        meaning.sides.push_back(inclusion);
      }
      else if (!seen[inclusion.whole])
      {
        seen[inclusion.whole] = true;
        open.push_back(inclusion.whole);
      }
    }
  }
  return meaning;
}

GroupSet AbaqusSets::groupsOf(std::uint32_t set, int dimension)
{
  return this->Builder.groups().named(dimension, this->Sets[set].name);
}

GroupSet AbaqusSets::groupsOf(Meaning& meaning, int dimension)
{
  std::optional<GroupSet>& groups = meaning.groups[static_cast<std::size_t>(dimension)];
  if (!groups)
  {
    groups = GroupTable::None;
    for (const std::uint32_t set : meaning.sets)
    {
      groups = this->Builder.groups().join(*groups, this->groupsOf(set, dimension));
    }
  }
  return *groups;
}

void AbaqusSets::finish(FileNumbers& nodes, FileNumbers& elements)
{
  for (std::uint32_t set = 0; set < this->Sets.size(); ++set)
  {
    this->Meanings.push_back(this->meaningOf(set));
  }
  this->Unknown += this->Nodes.finish(nodes, [this](std::int64_t node, std::uint32_t set)
    { this->Builder.grouped(0, std::span(&node, 1), this->groupsOf(this->Meanings[set], 0)); });
  this->addStretches();
  this->ElementEntries.close();
  {
    RecordFile<Entry>::Reader entries(this->ElementEntries);
    elements.find(this->ElementLabels,
      [&](std::uint32_t element)
      {
        Entry entry{};
        entries.next(entry);
        element == NoIndex ? void(++this->Unknown)
                           : this->Listed.put(element, entry.set, entry.side);
      });
  }
  this->Unknown += this->Listed.finish(
    [this](const ListedElements::Found& found)
    {
      Meaning& meaning = this->Meanings[found.list];
      const bool isFurther = found.side == Further;
      if (found.side != Whole && !isFurther)
      {
        for (const std::uint32_t set : meaning.sets)
        {
          this->takeSide(found, set, found.side);
        }
        return;
      }
      const int dimension = found.kind.dimension;
      for (const std::uint32_t set : meaning.sets)
      {
        if (!isFurther || set != found.list)
        {
          this->Builder.alsoIn(
            found.element, dimension, found.corners, this->groupsOf(set, dimension));
        }
      }
      for (const Inclusion& side : meaning.sides)
      {
        this->takeSide(found, side.whole, side.side);
      }
    });
  if (this->Unknown > 0)
  {
    this->Builder.note(counted(this->Unknown, "entry", "entries") +
                       " of sets and surfaces name no node, element or side of an element that is "
                       "read, and are left out.");
  }
}

/** The elements of blocks, which are in the groups of their sets, are entries where these mean
 * more. */
void AbaqusSets::addStretches()
{
  for (const Stretch& stretch : this->Stretches)
  {
    const Meaning& meaning = this->Meanings[stretch.set];
    const bool meansMore = meaning.sets.size() > 1 || !meaning.sides.empty() ||
                           (this->Sets[stretch.set].isInternal && !meaning.sets.empty());
    for (std::int64_t element = stretch.first; meansMore && element < stretch.end; ++element)
    {
      this->Listed.put(static_cast<std::uint32_t>(element), stretch.set, Further);
    }
  }
}

/** Puts a side of an element into the group of a surface. */
void AbaqusSets::takeSide(
  const ListedElements::Found& found, std::uint32_t set, std::uint32_t number)
{
  const ElementSide side = abaqusSide(found.kind, found.corners.size(), number);
  if (side.isWhole)
  {
    this->Builder.alsoIn(
      found.element, side.dimension, found.corners, this->groupsOf(set, side.dimension));
    return;
  }
  if (side.corners.empty())
  {
    ++this->Unknown;
    return;
  }
  std::array<std::int64_t, 4> corners{};
  for (std::size_t k = 0; k < side.corners.size(); ++k)
  {
    corners[k] = found.corners[side.corners[k]];
  }
  this->Builder.grouped(side.dimension, std::span(corners).first(side.corners.size()),
    this->groupsOf(set, side.dimension));
}

} // namespace smg
