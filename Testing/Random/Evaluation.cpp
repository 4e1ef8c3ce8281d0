// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Evaluation.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>

namespace smg::testing
{

using Eigen::Vector3d;
using Eigen::VectorXd;
using nlohmann::json;

const CaseColumn* find(const std::vector<CaseColumn>& columns, const std::string& name)
{
  const auto found =
    std::ranges::find_if(columns, [&](const CaseColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

VectorXd rowOf(const CaseColumn& column, std::int64_t row)
{
  return VectorXd::Map(column.values.data() + row * column.components, column.components);
}

std::vector<json> entriesOf(const json& datum)
{
  if (datum.is_array() && !datum.empty() && datum[0].is_object())
  {
    return { datum.begin(), datum.end() };
  }
  return { json{ { "value", datum } } };
}

Evaluation::Evaluation(const Case& given)
  : On(given)
  , Flags(given.flags())
{
  const int size = cornersOf(given.type);
  std::map<std::vector<std::int64_t>, int> count;
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    std::set<std::int64_t> distinct(given.cell(c), given.cell(c) + size);
    const bool counts = static_cast<int>(distinct.size()) == size &&
                        !(this->Flags[static_cast<std::size_t>(c)] & DuplicateCell);
    for (int k = 0; k < size; ++k)
    {
      std::vector<std::int64_t> corners(given.cell(c), given.cell(c) + size);
      corners.erase(corners.begin() + k);
      std::ranges::sort(corners);
      this->All.push_back({ c, corners });
      count[corners] += counts ? 1 : 0;
      this->Counts.push_back(counts);
    }
  }
  for (std::size_t f = 0; f < this->All.size(); ++f)
  {
    if (this->Counts[f] && count[this->All[f].corners] == 1)
    {
      this->Boundary.push_back(f);
    }
    if (this->Counts[f] && count[this->All[f].corners] > 1)
    {
      this->Inner.push_back(f);
    }
  }
}

std::vector<bool> Evaluation::verticesOf(const json& place) const
{
  std::vector<bool> selected(static_cast<std::size_t>(this->On.vertices()), false);
  const auto set = [&](const std::function<bool(const Vector3d&)>& contains)
  {
    for (std::size_t v = 0; v < selected.size(); ++v)
    {
      selected[v] = contains(this->point(static_cast<std::int64_t>(v)));
    }
  };
  if (place.contains("halfspace"))
  {
    const std::vector<double> n = place.at("halfspace");
    set([&](const Vector3d& p) { return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] >= n[3]; });
  }
  else if (place.contains("box"))
  {
    const std::vector<double> b = place.at("box");
    set(
      [&](const Vector3d& p)
      {
        return p[0] >= b[0] && p[1] >= b[1] && p[2] >= b[2] && p[0] <= b[3] && p[1] <= b[4] &&
               p[2] <= b[5];
      });
  }
  else if (place.contains("sphere"))
  {
    const std::vector<double> s = place.at("sphere");
    set([&](const Vector3d& p) { return (p - Vector3d(s[0], s[1], s[2])).norm() <= s[3]; });
  }
  else if (place.contains("vertices"))
  {
    for (const std::size_t v : place.at("vertices"))
    {
      if (v < selected.size())
      {
        selected[v] = true;
      }
    }
  }
  else if (place.contains("nearest"))
  {
    for (const std::vector<double> q : place.at("nearest"))
    {
      std::size_t best = 0;
      const auto distance = [&](std::size_t v) {
        return (this->point(static_cast<std::int64_t>(v)) - Vector3d(q[0], q[1], q[2]))
          .squaredNorm();
      };
      for (std::size_t v = 1; v < selected.size(); ++v)
      {
        best = distance(v) < distance(best) ? v : best;
      }
      selected[best] = true;
    }
  }
  else if (place.contains("boundary"))
  {
    for (const std::size_t f : this->Boundary)
    {
      for (const std::int64_t v : this->All[f].corners)
      {
        selected[static_cast<std::size_t>(v)] = true;
      }
    }
  }
  else
  {
    const CaseColumn& column =
      *find(this->On.vertexColumns, place.contains("tag") ? place.at("tag")[0].get<std::string>()
                                                          : place.at("mask").get<std::string>());
    for (std::size_t v = 0; v < selected.size(); ++v)
    {
      selected[v] = holds(place, column, static_cast<std::int64_t>(v));
    }
  }
  return selected;
}

std::size_t Evaluation::count(Of of) const
{
  return of == Of::Vertices ? static_cast<std::size_t>(this->On.vertices())
         : of == Of::Cells  ? static_cast<std::size_t>(this->On.cells())
                            : this->All.size();
}

std::vector<bool> Evaluation::within(const std::vector<bool>& vertices, Of of) const
{
  const int size = cornersOf(this->On.type);
  std::vector<bool> selected(this->count(of), false);
  const auto isIn = [&](std::int64_t v) { return vertices[static_cast<std::size_t>(v)]; };
  for (std::size_t k = 0; k < selected.size(); ++k)
  {
    const auto number = static_cast<std::int64_t>(k);
    selected[k] = of == Of::Vertices ? vertices[k]
                  : of == Of::Cells
                    ? std::all_of(this->On.cell(number), this->On.cell(number) + size, isIn)
                    : std::ranges::all_of(this->All[k].corners, isIn);
  }
  return selected;
}

namespace
{

bool isCombined(const json& place)
{
  return place.contains("all") || place.contains("any") || place.contains("not");
}

std::vector<json> partsOf(const json& place)
{
  return place.contains("not")
           ? std::vector<json>{ place.at("not") }
           : place.at(place.contains("all") ? "all" : "any").get<std::vector<json>>();
}

/** Whether the boundary or nearest vertices are in a place. */
bool isLate(const json& place)
{
  return isCombined(place) ? std::ranges::any_of(partsOf(place), isLate)
                           : place.contains("boundary") || place.contains("nearest");
}

} // namespace

std::vector<bool> Evaluation::select(const json& place, Of of, bool& isEmpty, bool isPart) const
{
  const int size = cornersOf(this->On.type);
  if (place.contains("group"))
  {
    return this->selectGroups(place.at("group"), of, isEmpty);
  }
  if (isCombined(place))
  {
    return this->combine(place, of, isEmpty, isPart);
  }
  std::vector<bool> selected(this->count(of), false);
  const char* const keys[] = { "halfspace", "box", "sphere", "vertices", "nearest", "boundary",
    "tag", "mask" };
  if (std::ranges::none_of(keys, [&](const char* key) { return place.contains(key); }))
  {
    selected.assign(selected.size(), true);
    return selected;
  }
  const CaseColumn* cells = place.contains("mask")  ? this->cellColumn(place.at("mask"))
                            : place.contains("tag") ? this->cellColumn(place.at("tag")[0])
                                                    : nullptr;
  if (cells)
  {
    bool any = false;
    for (std::int64_t c = 0; c < this->On.cells(); ++c)
    {
      if (holds(place, *cells, c))
      {
        any = true;
        for (int k = 0; k < size; ++k)
        {
          selected[static_cast<std::size_t>(of == Of::Vertices ? this->On.cell(c)[k]
                                            : of == Of::Cells  ? c
                                                               : c * size + k)] = true;
        }
      }
    }
    isEmpty = isEmpty || !any;
    return selected;
  }
  const std::vector<bool> vertices = this->verticesOf(place);
  selected = this->within(vertices, of);
  // The boundary and nearest vertices count by themselves, except for the cells of a whole place.
  const bool byVertices = isLate(place) && (of == Of::Facets || isPart);
  isEmpty = isEmpty || std::ranges::count(byVertices ? vertices : selected, true) == 0;
  return selected;
}

std::vector<bool> Evaluation::combine(const json& place, Of of, bool& isEmpty, bool isPart) const
{
  const bool isAll = place.contains("all");
  std::vector<bool> selected(this->count(of), isAll);
  for (const json& part : partsOf(place))
  {
    const std::vector<bool> more = this->select(part, of, isEmpty, true);
    for (std::size_t k = 0; k < selected.size(); ++k)
    {
      selected[k] = isAll ? selected[k] && more[k] : selected[k] || more[k];
    }
  }
  if (place.contains("not"))
  {
    selected.flip();
  }
  const bool isUnknown = isLate(place) && (of == Of::Facets || (of == Of::Cells && isPart));
  isEmpty = isEmpty || (!isUnknown && std::ranges::count(selected, true) == 0);
  return selected;
}

/** A name or, if there is none, a number; a * at the end or the beginning stands for anything. */
std::set<std::size_t> Evaluation::named(const json& name, GroupOf kind) const
{
  const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
  const auto those = [&](auto isWanted)
  {
    std::set<std::size_t> found;
    for (std::size_t g = 0; g < this->On.groups.groups.size(); ++g)
    {
      const Group& group = this->On.groups.groups[g];
      if (group.of == kind && isWanted(group))
      {
        found.insert(g);
      }
    }
    return found;
  };
  if (text.ends_with('*'))
  {
    return those(
      [&](const Group& group) { return group.name.starts_with(text.substr(0, text.size() - 1)); });
  }
  if (text.starts_with('*'))
  {
    return those([&](const Group& group) { return group.name.ends_with(text.substr(1)); });
  }
  const std::set<std::size_t> found = those([&](const Group& group) { return group.name == text; });
  return !found.empty() ? found
                        : those([&](const Group& group)
                            { return group.number && std::to_string(*group.number) == text; });
}

bool Evaluation::isIn(const std::set<std::size_t>& groups, GroupOf kind, std::size_t row) const
{
  const CaseColumn* sets =
    find(kind == GroupOf::Vertices ? this->On.vertexColumns : this->On.cellColumns,
      MeshGroups::columnOf(kind));
  return sets &&
         std::ranges::any_of(this->On.groups.sets[static_cast<std::size_t>(sets->values[row])],
           [&](std::uint32_t group) { return groups.contains(group); });
}

/** Of each name, the groups of the first kind that has it. */
std::map<GroupOf, std::set<std::size_t>> Evaluation::groupsAt(
  const json& names, Of of, bool& isEmpty) const
{
  std::vector<GroupOf> kinds{ GroupOf::Facets, GroupOf::Vertices, GroupOf::Cells };
  if (of == Of::Cells)
  {
    kinds = { GroupOf::Cells, GroupOf::Vertices };
  }
  std::map<GroupOf, std::set<std::size_t>> found;
  for (const json& name : names.is_array() ? names : json::array({ names }))
  {
    const auto kind =
      std::ranges::find_if(kinds, [&](GroupOf k) { return !this->named(name, k).empty(); });
    if (kind == kinds.end())
    {
      isEmpty = true;
      continue;
    }
    found[*kind].merge(this->named(name, *kind));
  }
  return found;
}

std::vector<bool> Evaluation::selectGroups(const json& names, Of of, bool& isEmpty) const
{
  const auto size = static_cast<std::size_t>(cornersOf(this->On.type));
  std::vector<bool> selected(this->count(of), false);
  for (const auto& [kind, groups] : this->groupsAt(names, of, isEmpty))
  {
    std::vector<bool> part(selected.size(), false);
    bool any = false;
    if (kind == GroupOf::Vertices)
    {
      std::vector<bool> vertices(this->count(Of::Vertices));
      for (std::size_t v = 0; v < vertices.size(); ++v)
      {
        vertices[v] = this->isIn(groups, kind, v);
      }
      part = this->within(vertices, of);
      any = std::ranges::count(part, true) > 0;
    }
    for (std::size_t f = 0; kind != GroupOf::Vertices && f < this->All.size(); ++f)
    {
      if (!this->isIn(groups, kind, kind == GroupOf::Facets ? f : f / size))
      {
        continue;
      }
      any = true;
      for (const std::int64_t v : this->All[f].corners)
      {
        part[of == Of::Vertices ? static_cast<std::size_t>(v)
             : of == Of::Cells  ? f / size
                                : f] = true;
      }
    }
    isEmpty = isEmpty || !any;
    for (std::size_t k = 0; k < selected.size(); ++k)
    {
      selected[k] = selected[k] || part[k];
    }
  }
  return selected;
}

std::vector<bool> Evaluation::cellsOf(std::size_t group) const
{
  std::vector<bool> cells(this->count(Of::Cells));
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    cells[c] = this->isIn({ group }, GroupOf::Cells, c);
  }
  return cells;
}

bool Evaluation::isOfCells(const json& place) const
{
  if (isCombined(place))
  {
    return std::ranges::any_of(
      partsOf(place), [this](const json& part) { return this->isOfCells(part); });
  }
  if (place.contains("group"))
  {
    const json& names = place.at("group");
    return std::ranges::any_of(names.is_array() ? names : json::array({ names }),
      [this](const json& name)
      {
        const auto is = [&](GroupOf kind) { return !this->named(name, kind).empty(); };
        // No density is on facets, which are refused where cells are needed.
        return is(GroupOf::Cells) || (is(GroupOf::Facets) && !is(GroupOf::Vertices));
      });
  }
  return (place.contains("mask") && this->cellColumn(place.at("mask"))) ||
         (place.contains("tag") && this->cellColumn(place.at("tag")[0]));
}

/** Facets of groups, also among those that other places select as well. */
std::vector<bool> Evaluation::inside(const json& place) const
{
  std::vector<bool> held(this->All.size(), false);
  bool isEmpty = false;
  if (place.contains("group"))
  {
    const auto groups = this->groupsAt(place.at("group"), Of::Facets, isEmpty);
    const auto facets = groups.find(GroupOf::Facets);
    for (std::size_t f = 0; facets != groups.end() && f < held.size(); ++f)
    {
      held[f] = this->isIn(facets->second, GroupOf::Facets, f);
    }
  }
  else if (place.contains("all") || place.contains("any"))
  {
    for (const json& part : partsOf(place))
    {
      const std::vector<bool> more = this->inside(part);
      for (std::size_t f = 0; f < held.size(); ++f)
      {
        held[f] = held[f] || more[f];
      }
    }
    const std::vector<bool> selected = this->select(place, Of::Facets, isEmpty);
    for (std::size_t f = 0; f < held.size(); ++f)
    {
      held[f] = held[f] && selected[f];
    }
  }
  return held;
}

std::vector<int> Evaluation::lastInside(const std::vector<json>& entries) const
{
  std::vector<int> result(this->All.size(), -1);
  for (std::size_t e = 0; e < entries.size(); ++e)
  {
    const std::vector<bool> held = this->inside(entries[e]);
    for (std::size_t f = 0; f < held.size(); ++f)
    {
      result[f] = held[f] ? static_cast<int>(e) : result[f];
    }
  }
  return result;
}

std::vector<int> Evaluation::last(const std::vector<json>& entries, Of of, bool& isEmpty) const
{
  std::vector<int> result;
  for (std::size_t e = 0; e < entries.size(); ++e)
  {
    const std::vector<bool> selected = this->select(entries[e], of, isEmpty);
    result.resize(selected.size(), -1);
    for (std::size_t k = 0; k < selected.size(); ++k)
    {
      result[k] = selected[k] ? static_cast<int>(e) : result[k];
    }
  }
  return result;
}

std::vector<std::size_t> Evaluation::walls(const json& places) const
{
  std::vector<bool> isWall(this->All.size(), places.empty());
  for (const json& place : places)
  {
    bool isEmpty = false;
    const std::vector<bool> selected = this->select(place, Of::Facets, isEmpty);
    for (std::size_t f = 0; f < selected.size(); ++f)
    {
      isWall[f] = isWall[f] || selected[f];
    }
  }
  std::vector<std::size_t> walls;
  std::ranges::copy_if(
    this->Boundary, std::back_inserter(walls), [&](std::size_t f) { return isWall[f]; });
  const std::vector<int> inside = this->lastInside({ places.begin(), places.end() });
  std::ranges::copy_if(
    this->Inner, std::back_inserter(walls), [&](std::size_t f) { return inside[f] >= 0; });
  return walls;
}

VectorXd Evaluation::atVertex(const json& value, std::int64_t v) const
{
  if (value.is_string())
  {
    if (value == "position")
    {
      return this->point(v);
    }
    return rowOf(*find(this->On.vertexColumns, value), v);
  }
  const std::vector<double> numbers =
    value.is_array() ? value.get<std::vector<double>>() : std::vector{ value.get<double>() };
  return VectorXd::Map(numbers.data(), std::ssize(numbers));
}

VectorXd Evaluation::inCell(const json& value, std::int64_t c) const
{
  if (const CaseColumn* column = this->cellColumn(value))
  {
    return rowOf(*column, c);
  }
  const int size = cornersOf(this->On.type);
  VectorXd sum = this->atVertex(value, this->On.cell(c)[0]);
  for (int k = 1; k < size; ++k)
  {
    sum += this->atVertex(value, this->On.cell(c)[k]);
  }
  return sum / size;
}

} // namespace smg::testing
