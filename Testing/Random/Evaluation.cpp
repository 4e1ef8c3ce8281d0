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

std::vector<bool> Evaluation::select(const json& place, Of of, bool& isEmpty) const
{
  const int size = cornersOf(this->On.type);
  const std::size_t count = of == Of::Vertices ? static_cast<std::size_t>(this->On.vertices())
                            : of == Of::Cells  ? static_cast<std::size_t>(this->On.cells())
                                               : this->All.size();
  std::vector<bool> selected(count, false);
  const char* const keys[] = { "halfspace", "box", "sphere", "vertices", "nearest", "boundary",
    "tag", "mask" };
  if (std::ranges::none_of(keys, [&](const char* key) { return place.contains(key); }))
  {
    selected.assign(count, true);
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
  const auto isIn = [&](std::int64_t v) { return vertices[static_cast<std::size_t>(v)]; };
  for (std::size_t k = 0; k < count; ++k)
  {
    const auto number = static_cast<std::int64_t>(k);
    selected[k] = of == Of::Vertices ? vertices[k]
                  : of == Of::Cells
                    ? std::all_of(this->On.cell(number), this->On.cell(number) + size, isIn)
                    : std::ranges::all_of(this->All[k].corners, isIn);
  }
  // The boundary and nearest vertices count by themselves.
  const bool byVertices = place.contains("boundary") || place.contains("nearest");
  isEmpty = isEmpty || std::ranges::count(byVertices ? vertices : selected, true) == 0;
  return selected;
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
