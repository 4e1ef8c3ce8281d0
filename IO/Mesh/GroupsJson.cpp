// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/GroupsJson.h"

#include "IO/Files/InputFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace smg
{
namespace
{

constexpr std::array GroupKinds{ GroupOf::Vertices, GroupOf::Facets, GroupOf::Cells };

GroupOf groupKindOf(const std::string& name)
{
  const auto found =
    std::ranges::find_if(GroupKinds, [&name](GroupOf kind) { return name == nameOf(kind); });
  if (found == GroupKinds.end())
  {
    throw MeshError("has a group of '" + name + "', not of vertices, facets or cells");
  }
  return *found;
}

} // namespace

nlohmann::json jsonOf(const MeshGroups& groups)
{
  nlohmann::json list = nlohmann::json::array(), sets = nlohmann::json::array();
  for (const Group& group : groups.groups)
  {
    nlohmann::json entry = { { "of", nameOf(group.of) } };
    if (!group.name.empty())
    {
      entry["name"] = group.name;
    }
    if (group.number)
    {
      entry["number"] = *group.number;
    }
    list.push_back(std::move(entry));
  }
  for (std::size_t set = 1; set < groups.sets.size(); ++set)
  {
    sets.push_back(groups.sets[set]);
  }
  return { { "groups", std::move(list) }, { "sets", std::move(sets) } };
}

MeshGroups groupsOf(const nlohmann::json& json)
{
  MeshGroups result;
  try
  {
    for (const nlohmann::json& entry : json.at("groups"))
    {
      Group group;
      group.of = groupKindOf(entry.at("of"));
      group.name = entry.value("name", std::string());
      if (entry.contains("number"))
      {
        group.number = entry.at("number").get<std::int64_t>();
      }
      result.groups.push_back(std::move(group));
    }
    constexpr std::size_t MostSets = std::numeric_limits<GroupSet>::max();
    if (json.at("sets").size() > MostSets)
    {
      throw MeshError("has " + std::to_string(json.at("sets").size()) +
                      " sets of groups, but may have " + std::to_string(MostSets));
    }
    for (const nlohmann::json& set : json.at("sets"))
    {
      result.sets.push_back(set.get<std::vector<std::uint32_t>>());
      if (std::ranges::any_of(result.sets.back(),
            [&result](std::uint32_t group) { return group >= result.groups.size(); }))
      {
        throw MeshError("has a set of groups that it does not have");
      }
    }
  }
  catch (const nlohmann::json::exception& error)
  {
    throw MeshError(std::string("has groups that cannot be read (") + error.what() + ")");
  }
  return result;
}

std::string textOf(const MeshGroups& groups)
{
  return jsonOf(groups).dump();
}

MeshGroups groupsOfText(const std::string& text)
{
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded())
  {
    throw MeshError("has groups that are no JSON");
  }
  return groupsOf(json);
}

} // namespace smg
