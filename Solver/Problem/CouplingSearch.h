// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/FacetCopies.h"
#include "Solver/Problem/OpenValues.h"
#include "Solver/Problem/Selection.h"
#include "smg/ProblemDescription.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

class TiedClasses;

/** The vertices that the periodic sides and the interfaces of a description couple, found in the
 * reading of the stream that prepares its selections. */
class CouplingSearch
{
public:
  /** Throws Error if an entry is invalid. */
  CouplingSearch(
    const ProblemDescription& description, MeshColumns& columns, Selections& selections);

  /** Whether the description couples anything. */
  bool any() const { return !this->Sides.empty(); }
  /** What does not match is left out, and no error of end(). */
  void acceptEmpty() { this->IsStrict = false; }

  /** Adds a block, for which the selections have been prepared. */
  void add(const MeshBlock& block);
  /** Throws Error, which names the place in the description and in the mesh, if facets have no
   * copy. `parts`: as of Selection. */
  void end(const MeshParts* parts);

  /** Null before end(), or without couplings. */
  const std::shared_ptr<const VertexCouplings>& couplings() const { return this->Found; }

private:
  /** The facets of a place. */
  struct Side
  {
    Side(std::string place, Selection* selected, Pool& memory, int corners)
      : key(std::move(place))
      , selection(selected)
      , facets(memory, corners)
    {
    }

    std::string key;
    Selection* selection;
    FacetList facets;
  };

  void addSide(
    const Where& where, const std::string& key, MeshColumns& columns, Selections& selections);
  std::vector<VertexCouplings::Tie> pairsOf(std::size_t entry) const;
  std::vector<VertexCouplings::Link> linksOf(std::size_t entry) const;
  void addLinks(TiedClasses& classes, std::vector<VertexCouplings::Link>& links) const;
  /** Throws Error on facets without a copy, unless these are accepted. */
  void failAlone(const Side& side, const FacetCopies& copies, const std::string& sentence) const;

  const MeshColumns& Columns;
  std::size_t ValueColumns;
  std::vector<ProblemDescription::Periodic> Periodic;
  std::vector<ProblemDescription::Interface> Interfaces;
  std::deque<Side> Sides; ///< two of each periodic pair, then one of each interface
  OpenValues<double> Points;
  bool IsStrict = true;
  std::shared_ptr<const VertexCouplings> Found;
  Reservation Reserved; ///< of what was found
};

} // namespace smg
