// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/CouplingSearch.h"

#include "Solver/Assembly/Facets.h"
#include "Solver/Core/Text.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Problem/TiedClasses.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

// From places in a description to pairs of vertices. The facets of both sides of a periodic pair,
// and of each interface, are collected while the stream is read: their number is that of a section
// through the mesh, which is what a solve has in memory anyway. Then each facet finds its copy
// (FacetCopies), and with it the copies of its corners.

namespace smg
{

namespace
{

std::string textOf(const Vector& point)
{
  return '(' + shortest(static_cast<float>(point[0])) + ", " +
         shortest(static_cast<float>(point[1])) + ", " + shortest(static_cast<float>(point[2])) +
         ')';
}

/** What an entry says of it, 0: nothing. */
double toleranceOf(double given, const FacetList& first, const FacetList& second)
{
  return given > 0.0 ? given : usualTolerance(first, second);
}

} // namespace

CouplingSearch::CouplingSearch(
  const ProblemDescription& description, MeshColumns& columns, Selections& selections)
  : Columns(columns)
  , ValueColumns(static_cast<std::size_t>(description.columns))
  , Periodic(description.periodic)
  , Interfaces(description.interfaces)
  , Points(columns.memory(), 3)
  , Reserved(columns.memory())
{
  const bool isAny = !this->Periodic.empty() || !this->Interfaces.empty();
  if (isAny && description.weights != Weights::Cotangent)
  {
    columns.fail(
      this->Periodic.empty() ? "interface" : "periodic", "goes with cotangent weights only");
  }
  for (std::size_t k = 0; k < this->Periodic.size(); ++k)
  {
    const std::string key = nameOfEntry("periodic", k);
    std::vector<double>& jump = this->Periodic[k].jump;
    if (jump.size() > 1 && jump.size() != this->ValueColumns)
    {
      columns.fail(key + ".jump", "must have one number, or one for each of the " +
                                    std::to_string(this->ValueColumns) + " columns");
    }
    jump.resize(this->ValueColumns, jump.size() == 1 ? jump[0] : 0.0);
    this->addSide(this->Periodic[k].from, key, columns, selections);
    this->addSide(this->Periodic[k].to, key, columns, selections);
  }
  for (std::size_t k = 0; k < this->Interfaces.size(); ++k)
  {
    const std::string key = nameOfEntry("interface", k);
    if (!(this->Interfaces[k].coefficient >= 0.0) ||
        !std::isfinite(this->Interfaces[k].coefficient))
    {
      columns.fail(key + ".coefficient", "must be a finite number that is not negative");
    }
    this->addSide(this->Interfaces[k].where, key, columns, selections);
  }
}

void CouplingSearch::addSide(
  const Where& where, const std::string& key, MeshColumns& columns, Selections& selections)
{
  Selection* selection = selections.add(where, DataPlace::Facets, ColumnOwner::Cells, key);
  if (!selection || selection->needsPreparing())
  {
    columns.fail(key, "needs facets: a group, a region or a column");
  }
  this->Sides.emplace_back(key, selection, columns.memory(), cornersOf(columns.cellType()) - 1);
}

void CouplingSearch::add(const MeshBlock& block)
{
  if (!this->any())
  {
    return;
  }
  if (block.firstVertex == 0)
  {
    this->Found.reset();
    std::ranges::for_each(this->Sides, [](Side& side) { side.facets.clear(); });
  }
  std::ranges::copy(block.positions, this->Points.startBlock(block).begin());
  const int corners = cornersOf(this->Columns.cellType());
  std::vector<std::uint8_t> selected(cellsOf(this->Columns.cellType(), block));
  for (Side& side : this->Sides)
  {
    side.selection->atFacets({ block, 0, block.corners }, selected);
    for (std::size_t c = 0; c < selected.size(); ++c)
    {
      const std::int64_t* corner = block.corners.data() + c * static_cast<std::size_t>(corners);
      for (int k = 0; selected[c] != 0 && k < corners; ++k)
      {
        if ((selected[c] >> k & 1) == 0)
        {
          continue;
        }
        const CellFacet facet = facetOf(this->Columns.cellType(), corner, k);
        const double* points[3] = {};
        std::transform(facet.vertex, facet.vertex + corners - 1, points,
          [this](std::int64_t vertex) { return this->Points.at(vertex); });
        side.facets.add(facet.vertex, points);
      }
    }
  }
}

void CouplingSearch::end(const MeshParts* parts)
{
  if (!this->any() || this->Found)
  {
    return;
  }
  if (parts)
  {
    this->Columns.fail(this->Sides.front().key, "is not solved by several processes: use one");
  }
  this->Points.restart();
  std::ranges::for_each(this->Sides, [](Side& side) { side.facets.finish(); });
  std::vector<std::vector<VertexCouplings::Tie>> pairs;
  std::vector<std::int64_t> vertices;
  for (std::size_t k = 0; k < this->Periodic.size(); ++k)
  {
    for (const VertexCouplings::Tie& pair : pairs.emplace_back(this->pairsOf(k)))
    {
      vertices.insert(vertices.end(), { pair.vertex, pair.to });
    }
  }
  TiedClasses classes(std::move(vertices), this->ValueColumns);
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    for (const VertexCouplings::Tie& pair : pairs[k])
    {
      if (!classes.join(pair.vertex, pair.to, this->Periodic[k].jump) && this->IsStrict)
      {
        this->Columns.fail(this->Sides[2 * k].key,
          "ties the vertex at " + textOf(this->Sides[2 * k + 1].facets.point(pair.vertex)) +
            " to itself, or by another jump than it is tied already");
      }
    }
  }
  auto found = std::make_shared<VertexCouplings>();
  classes.fill(*found);
  this->addLinks(classes, found->links);
  for (std::size_t k = 0; k < this->Interfaces.size(); ++k)
  {
    found->contacts.push_back({ nameOfEntry("interface", k, groupNames(this->Interfaces[k].where)),
      this->Interfaces[k].coefficient });
  }
  this->Reserved.resize(
    static_cast<std::int64_t>(found->ties.capacity() * sizeof(VertexCouplings::Tie) +
                              found->jumps.capacity() * sizeof(double) +
                              found->links.capacity() * sizeof(VertexCouplings::Link)));
  std::ranges::for_each(this->Sides, [](Side& side) { side.facets.clear(); });
  this->Found = std::move(found);
}

/** Links of unknowns; those of several facets add up. */
void CouplingSearch::addLinks(TiedClasses& classes, std::vector<VertexCouplings::Link>& links) const
{
  for (std::size_t k = 0; k < this->Interfaces.size(); ++k)
  {
    for (const VertexCouplings::Link& link : this->linksOf(k))
    {
      const auto [from, to] = std::minmax({ classes.nodeOf(link.from), classes.nodeOf(link.to) });
      if (from != to)
      {
        links.push_back({ from, to, link.conductance, static_cast<int>(k) });
      }
    }
  }
  const auto ends = [](const VertexCouplings::Link& link)
  { return std::tuple(link.from, link.to, link.contact); };
  std::ranges::stable_sort(links, {}, ends);
  std::size_t last = 0;
  for (std::size_t l = 1; l < links.size(); ++l)
  {
    if (ends(links[l]) == ends(links[last]))
    {
      links[last].conductance += links[l].conductance;
    }
    else
    {
      links[++last] = links[l];
    }
  }
  links.resize(links.empty() ? 0 : last + 1);
}

/** The vertices of the second side with those of the first one that they are copies of. */
std::vector<VertexCouplings::Tie> CouplingSearch::pairsOf(std::size_t entry) const
{
  const Side& from = this->Sides[2 * entry];
  const Side& to = this->Sides[2 * entry + 1];
  if (from.facets.facets().empty() || to.facets.facets().empty())
  {
    return {}; // the selections complain, unless this is accepted
  }
  const Vector shift = shiftBetween(from.facets, to.facets);
  const double tolerance = toleranceOf(this->Periodic[entry].tolerance, from.facets, to.facets);
  const FacetCopies copies = findCopies(from.facets, to.facets, shift, tolerance);
  if (!copies.alone.empty())
  {
    this->failAlone(from, copies,
      ", moved by " + textOf(shift) +
        ", have no copy among those of the second side; the first is at ");
    return {};
  }
  if (copies.pairs.size() != to.facets.facets().size() && this->IsStrict)
  {
    this->Columns.fail(
      to.key, "the first side has " + groupedDigits(std::ssize(from.facets.facets())) +
                " facets, the second one " + groupedDigits(std::ssize(to.facets.facets())) +
                ": make the mesh periodic in the mesher");
  }
  std::vector<VertexCouplings::Tie> pairs;
  for (const FacetCopy& copy : copies.pairs)
  {
    for (std::size_t k = 0; k < from.facets.corners(); ++k)
    {
      pairs.push_back({ copy.corners[k], from.facets.facets()[copy.first][k] });
    }
  }
  const auto places = [](const VertexCouplings::Tie& pair)
  { return std::pair(pair.vertex, pair.to); };
  std::ranges::sort(pairs, {}, places);
  const auto repeated = std::ranges::unique(pairs, {}, places);
  pairs.erase(repeated.begin(), repeated.end());
  return pairs;
}

/** What flows through a facet between its sides, lumped at its corners. */
std::vector<VertexCouplings::Link> CouplingSearch::linksOf(std::size_t entry) const
{
  const Side& side = this->Sides[2 * this->Periodic.size() + entry];
  const double tolerance = toleranceOf(this->Interfaces[entry].tolerance, side.facets, side.facets);
  const FacetCopies copies = findCopies(side.facets, side.facets, {}, tolerance);
  if (!copies.alone.empty())
  {
    this->failAlone(side, copies,
      " have no copy of another body at their place, which an interface needs: the bodies are "
      "meshed "
      "differently there, or share their vertices, or are apart, or the place has only the facets "
      "of "
      "one of them; the first is at ");
  }
  // Two facets that are copies of each other are found once each; of more, not all are.
  std::set<std::pair<std::size_t, std::size_t>> found;
  std::vector<VertexCouplings::Link> links;
  const auto corners = static_cast<double>(side.facets.corners());
  for (const FacetCopy& copy : copies.pairs)
  {
    const bool isNew = found.insert(std::minmax({ copy.first, copy.second })).second;
    if (!isNew || this->Interfaces[entry].coefficient == 0.0)
    {
      continue;
    }
    const FacetList::Facet& facet = side.facets.facets()[copy.first];
    const double conductance =
      this->Interfaces[entry].coefficient * side.facets.area(facet) / corners;
    for (std::size_t k = 0; k < side.facets.corners(); ++k)
    {
      links.push_back({ facet[k], copy.corners[k], conductance });
    }
  }
  return links;
}

void CouplingSearch::failAlone(
  const Side& side, const FacetCopies& copies, const std::string& sentence) const
{
  if (!this->IsStrict)
  {
    return;
  }
  const FacetList& list = side.facets;
  this->Columns.fail(side.key, groupedDigits(std::ssize(copies.alone)) + " of " +
                                 groupedDigits(std::ssize(list.facets())) + " facets" + sentence +
                                 textOf(list.centre(list.facets()[copies.alone.front()])));
}

} // namespace smg
