// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Groups.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string_view>
#include <utility>

namespace smg
{
namespace
{

/** Whether a text is what a pattern says, in which * stands for any characters. Takes the time of
 * both lengths multiplied, at most: a * is moved on only while no later one has been reached. */
bool matches(std::string_view text, std::string_view pattern)
{
  std::size_t t = 0, p = 0, retryText = 0, star = std::string_view::npos;
  while (t < text.size())
  {
    if (p < pattern.size() && pattern[p] == '*')
    {
      star = p++;
      retryText = t;
    }
    else if (p < pattern.size() && pattern[p] == text[t])
    {
      ++p;
      ++t;
    }
    else if (star != std::string_view::npos)
    {
      p = star + 1;
      t = ++retryText;
    }
    else
    {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

/** The number of characters to insert, remove or replace, in any case of letters (Levenshtein). */
std::size_t distance(std::string_view a, std::string_view b)
{
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, row[j] + 1, diagonal + 1 });
    }
  }
  return row.back();
}

} // namespace

const char* MeshGroups::columnOf(GroupOf kind)
{
  return kind == GroupOf::Vertices ? VertexGroupsName
         : kind == GroupOf::Facets ? FacetGroupsName
                                   : CellGroupsName;
}

ColumnSpec MeshGroups::columnSpec(GroupOf kind, int corners)
{
  return { columnOf(kind), scalarTypeOf<GroupSet>(), kind == GroupOf::Facets ? corners : 1 };
}

bool MeshGroups::isOfMesh(const ColumnSpec& column, bool ofVertices, int corners)
{
  const GroupOf kind = ofVertices                       ? GroupOf::Vertices
                       : column.name == FacetGroupsName ? GroupOf::Facets
                                                        : GroupOf::Cells;
  return column == MeshGroups::columnSpec(kind, corners);
}

std::vector<std::uint32_t> MeshGroups::find(const std::string& wanted, GroupOf kind) const
{
  const auto those = [this, kind](auto isWanted)
  {
    std::vector<std::uint32_t> found;
    for (std::size_t g = 0; g < this->groups.size(); ++g)
    {
      if (this->groups[g].of == kind && isWanted(this->groups[g]))
      {
        found.push_back(static_cast<std::uint32_t>(g));
      }
    }
    return found;
  };
  // A name may contain a *, too.
  auto found = those([&](const Group& group) { return group.name == wanted; });
  if (found.empty() && wanted.find('*') != std::string::npos)
  {
    found = those([&](const Group& group) { return matches(group.label(), wanted); });
  }
  if (found.empty())
  {
    found = those(
      [&](const Group& group) { return group.number && std::to_string(*group.number) == wanted; });
  }
  return found;
}

std::vector<std::uint8_t> MeshGroups::setsWith(std::span<const std::uint32_t> wanted) const
{
  std::vector<std::uint8_t> with;
  for (const std::vector<std::uint32_t>& set : this->sets)
  {
    with.push_back(std::ranges::any_of(set, [wanted](std::uint32_t group)
                     { return std::ranges::find(wanted, group) != wanted.end(); })
                     ? 1
                     : 0);
  }
  return with;
}

std::string MeshGroups::listFor(const std::string& wanted) const
{
  constexpr std::size_t Most = 10, LongestCompared = 64;
  std::vector<std::pair<std::size_t, std::string>> known; // by distance
  for (const Group& group : this->groups)
  {
    std::string label = group.label();
    const std::size_t changes = distance(std::string_view(label).substr(0, LongestCompared),
      std::string_view(wanted).substr(0, LongestCompared));
    known.emplace_back(changes, std::move(label));
  }
  std::ranges::sort(known, [](const auto& a, const auto& b)
    { return a.first != b.first ? a.first < b.first : a.second.compare(b.second) < 0; });
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < std::min(Most, known.size()); ++k)
  {
    labels.push_back('\'' + known[k].second + '\'');
  }
  const std::size_t others = known.size() - labels.size();
  if (others > 0)
  {
    labels.push_back(std::to_string(others) + " others");
  }
  return listed(labels, "and");
}

} // namespace smg
