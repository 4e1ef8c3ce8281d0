// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/ParseWhere.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <limits>

namespace smg
{

namespace
{

Where placeOf(const JsonNode& object, bool everywhere, bool listsEverywhere, int depth);

std::array<double, 3> pointOf(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(3);
  return { n[0], n[1], n[2] };
}

Region halfSpaceOf(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(4);
  return Region::HalfSpace{ { n[0], n[1], n[2] }, n[3] };
}

Region boxOf(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(6);
  return Region::Box{ { n[0], n[1], n[2] }, { n[3], n[4], n[5] } };
}

Region sphereOf(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(4);
  return Region::Sphere{ { n[0], n[1], n[2] }, n[3] };
}

Region verticesOf(const JsonNode& node)
{
  return Region::Vertices{ node.integers(0, std::numeric_limits<std::int64_t>::max()) };
}

/** The member of WhereKeys that the object has; null for none, if that is allowed. */
const char* keyOf(const JsonNode& object, bool none, bool listsEverywhere)
{
  const auto given = [&object](const char* key) { return object.has(key); };
  const auto count = std::ranges::count_if(WhereKeys, given);
  if (count > 1 || (count == 0 && !none))
  {
    std::vector<std::string> keys(WhereKeys.begin(), WhereKeys.end());
    if (listsEverywhere)
    {
      keys.emplace_back("everywhere");
    }
    object.fail(
      (none ? "must have at most one of " : "must have exactly one of ") + listed(keys, "and"));
  }
  return count == 0 ? nullptr : *std::ranges::find_if(WhereKeys, given);
}

Region regionOf(const JsonNode& object, std::string_view key)
{
  const JsonNode node = object.member(key.data());
  Region region = key == "halfspace" ? halfSpaceOf(node)
                  : key == "box"     ? boxOf(node)
                  : key == "sphere"  ? sphereOf(node)
                                     : verticesOf(node);
  if (const std::string complaint = region.complaint(); !complaint.empty())
  {
    node.fail(complaint);
  }
  return region;
}

ColumnTag tagOf(const JsonNode& node)
{
  const std::vector<JsonNode> parts = node.elements();
  if (parts.size() != 2)
  {
    node.fail("must be [\"name of a column\", value]");
  }
  return { parts[0].columnName(), parts[1].number() };
}

NearestVertices nearestOf(const JsonNode& node)
{
  NearestVertices nearest;
  for (const JsonNode& point : node.elements())
  {
    nearest.points.push_back(pointOf(point));
  }
  if (nearest.points.empty())
  {
    node.fail("must have at least one point [x, y, z]");
  }
  return nearest;
}

} // namespace

std::vector<std::string> parseGroups(const JsonNode& node)
{
  std::vector<std::string> names;
  for (const JsonNode& name :
    node.value().is_array() ? node.elements() : std::vector<JsonNode>{ node })
  {
    const bool isNumber = name.value().is_number_integer();
    names.push_back(isNumber ? std::to_string(name.value().get<std::int64_t>()) : name.string());
    if (names.back().empty())
    {
      name.fail("must be the name of a group, or its number");
    }
  }
  if (names.empty())
  {
    node.fail("must name at least one group");
  }
  return names;
}

namespace
{

/** Places within places are few: a file of brackets alone must not take the stack. */
constexpr int MostNested = 32;

Combination combinationOf(const JsonNode& node, std::string_view key, int depth)
{
  if (depth > MostNested)
  {
    node.fail("has more than " + std::to_string(MostNested) + " places within each other");
  }
  const bool isNot = key == "not";
  Combination combined{ isNot          ? Combination::Kind::Not
                        : key == "all" ? Combination::Kind::All
                                       : Combination::Kind::Any,
    {} };
  for (const JsonNode& part : isNot ? std::vector<JsonNode>{ node } : node.elements())
  {
    part.requireObject(WhereKeys);
    combined.parts.push_back(placeOf(part, false, false, depth + 1));
  }
  if (combined.parts.empty())
  {
    node.fail("must have at least one place");
  }
  return combined;
}

} // namespace

Where parseWhere(const JsonNode& object, bool everywhere, bool listsEverywhere)
{
  return placeOf(object, everywhere, listsEverywhere, 0);
}

namespace
{

Where placeOf(const JsonNode& object, bool everywhere, bool listsEverywhere, int depth)
{
  const char* given = keyOf(object, everywhere, listsEverywhere);
  if (!given)
  {
    return Everywhere{};
  }
  const std::string_view key = given;
  const JsonNode node = object.member(given);
  if (key == "tag")
  {
    return tagOf(node);
  }
  if (key == "mask")
  {
    return ColumnMask{ node.columnName() };
  }
  if (key == "nearest")
  {
    return nearestOf(node);
  }
  if (key == "boundary")
  {
    if (!node.isTrue())
    {
      node.fail("can only be true: leave it out for another place");
    }
    return OnBoundary{};
  }
  if (key == "group")
  {
    return InGroup{ parseGroups(node) };
  }
  if (key == "all" || key == "any" || key == "not")
  {
    return combinationOf(node, key, depth);
  }
  return regionOf(object, key);
}

} // namespace

void requireWhereAnd(const JsonNode& object, std::initializer_list<const char*> keys)
{
  std::vector<const char*> all(WhereKeys.begin(), WhereKeys.end());
  all.insert(all.end(), keys);
  object.requireObject(all);
}

std::optional<Weights> weightsOfName(std::string_view name)
{
  if (name == "cotangent" || name == "raw-cotangent")
  {
    return Weights::Cotangent;
  }
  if (name == "clamped")
  {
    return Weights::Clamped;
  }
  return name == "uniform" ? std::optional(Weights::Uniform) : std::nullopt;
}

std::optional<Weights> parseWeights(const JsonNode& object)
{
  if (!object.has("weights"))
  {
    return std::nullopt;
  }
  const JsonNode node = object.member("weights");
  const std::optional<Weights> weights = weightsOfName(node.string());
  if (!weights)
  {
    node.fail("must be \"cotangent\", \"clamped\" or \"uniform\"");
  }
  return weights;
}

} // namespace smg
