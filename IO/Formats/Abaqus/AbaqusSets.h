// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "IO/Import/FileNumbers.h"
#include "IO/Import/ListedElements.h"
#include "IO/Import/RawMeshBuilder.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/**
 * The sets and surfaces of an input file of Abaqus: lists of nodes, of elements and of sides of
 * elements, by their labels or by the names of other sets. They are groups of the mesh.
 *
 * A set may be part of other sets and surfaces that come later, so that what membership means is
 * known in the end. Entries are in scratch files; sets themselves are in memory.
 */
class AbaqusSets
{
public:
  explicit AbaqusSets(RawMeshBuilder& builder);

  /** What the members of sets with names of their own are. */
  enum Kind
  {
    OfNodes,
    OfElements,
    OfSides, ///< of elements: surfaces
    Kinds
  };

  /** The set of this name in any spelling, which is made if need be; an internal one is no group.
   * Throws MeshError if there are too many. */
  std::uint32_t set(Kind kind, const std::string& name, bool isInternal = false);
  /** The same; none: there is no such set. */
  std::optional<std::uint32_t> find(Kind kind, const std::string& name) const;

  void addNode(std::uint32_t set, std::int64_t label);
  void addElement(
    std::uint32_t set, std::int64_t label, std::uint32_t side = ListedElements::Whole);
  /** All members of `part`, also later ones, are in `whole`, or this side of each. */
  void include(std::uint32_t part, std::uint32_t whole, std::uint32_t side = ListedElements::Whole);

  /** To be called before the element is added to the builder: it is in this set, too. */
  void element(
    ElementKind kind, std::span<const std::int64_t> corners, std::optional<std::uint32_t> set);

  /** After the last line: passes all members to the builder. The numbers are finished. */
  void finish(FileNumbers& nodes, FileNumbers& elements);

private:
  struct Inclusion
  {
    std::uint32_t whole, side;
  };
  struct Set
  {
    Kind kind;
    std::string name;
    bool isInternal;
    std::vector<Inclusion> wholes;
  };
  /** What membership of a set means: of which sets its members are, and which sides of them. */
  struct Meaning
  {
    std::vector<std::uint32_t> sets;
    std::vector<Inclusion> sides;
    std::array<std::optional<GroupSet>, GroupTable::Dimensions> groups; ///< of `sets`
  };
  /** Consecutive elements of a set. */
  struct Stretch
  {
    std::uint32_t set;
    std::int64_t first, end;
  };

  Meaning meaningOf(std::uint32_t set) const;
  GroupSet groupsOf(std::uint32_t set, int dimension);
  GroupSet groupsOf(Meaning& meaning, int dimension);
  void addStretches();
  void takeSide(const ListedElements::Found& found, std::uint32_t set, std::uint32_t side);

  RawMeshBuilder& Builder;
  std::vector<Set> Sets;
  std::array<std::map<std::string, std::uint32_t>, Kinds> ByName; ///< in capitals
  ListedNodes Nodes;
  RecordFile<std::uint32_t> ElementLabels;
  struct Entry
  {
    std::uint32_t set, side;
  };
  RecordFile<Entry> ElementEntries;
  ListedElements Listed;
  std::vector<Stretch> Stretches;
  std::pair<std::uint32_t, ElementKind> Current{ NoIndex,
    {} }; ///< set and kind of the last element
  std::vector<Meaning> Meanings;
  std::int64_t Unknown = 0; ///< entries without a node, an element or a side
};

} // namespace smg
