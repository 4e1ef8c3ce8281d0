// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescriptionFiles.h"

#include "IO/Description/ParseWhere.h"

namespace smg
{

namespace
{

std::vector<Where> parsePlaces(const JsonNode& node)
{
  std::vector<Where> places;
  const std::vector<JsonNode> objects =
    node.value().is_array() ? node.elements() : std::vector{ node };
  for (const JsonNode& object : objects)
  {
    object.requireObject(WhereKeys);
    places.push_back(parseWhere(object));
  }
  return places;
}

} // namespace

std::vector<Where> readPlacesFile(const std::filesystem::path& path)
{
  const nlohmann::json json = readJsonFile(path.string());
  return parsePlaces(JsonNode(json, path.string()));
}

std::vector<Where> readPlacesText(const std::string& text, const std::string& name)
{
  const nlohmann::json json = readJsonText(text, name);
  return parsePlaces(JsonNode(json, name));
}

} // namespace smg
