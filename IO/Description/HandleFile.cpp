// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescriptionFiles.h"

#include "IO/Description/ParseDescriptions.h"
#include "IO/Description/ParseWhere.h"

#include <algorithm>
#include <array>

namespace smg
{

namespace
{

constexpr std::int64_t MaxCycles = 1000000;
/** The keys of motions of a handle as a whole, and of motions vertex by vertex. */
constexpr std::array MotionKeys{ "translate", "rotate", "scale" };
constexpr std::array ValueKeys{ "target", "rotation", "logScale" };

bool hasOneOf(const JsonNode& object, const std::array<const char*, 3>& keys)
{
  return std::ranges::any_of(keys, [&object](const char* key) { return object.has(key); });
}

std::array<double, 3> parseVector(const JsonNode& node)
{
  const std::vector<double> numbers = node.numbers(3);
  return { numbers[0], numbers[1], numbers[2] };
}

void parseRotation(const JsonNode& node, HandleMotion::Parameters& motion)
{
  node.requireObject({ "axis", "degrees", "center" });
  const JsonNode axis = node.member("axis");
  motion.axis = parseVector(axis);
  if (motion.axis == std::array<double, 3>{})
  {
    axis.fail("must have a direction: its numbers must not all be 0");
  }
  const JsonNode degrees = node.member("degrees");
  motion.degrees = degrees.number();
  if (!HandleMotion::isAngle(motion.degrees))
  {
    degrees.fail(HandleMotion::DegreesRule);
  }
}

/** The centre of rotation and scale of a handle. */
std::array<double, 3> parseCenter(const JsonNode& handle, const Where& where)
{
  const bool inRotation = handle.has("rotate") && handle.member("rotate").has("center");
  if (inRotation && handle.has("center"))
  {
    handle.member("center").fail("stands here and in rotate: leave one out");
  }
  if (inRotation || handle.has("center"))
  {
    return parseVector((inRotation ? handle.member("rotate") : handle).member("center"));
  }
  const auto* region = std::get_if<Region>(&where);
  const std::optional<std::array<double, 3>> middle = region ? region->center() : std::nullopt;
  if (!middle)
  {
    handle.fail("turns or grows about no point: add \"center\": [x, y, z]");
  }
  return *middle;
}

HandleMotion parseMotion(const JsonNode& handle, const Where& where)
{
  HandleMotion::Parameters motion;
  if (handle.has("translate"))
  {
    motion.translation = parseVector(handle.member("translate"));
  }
  if (handle.has("rotate"))
  {
    parseRotation(handle.member("rotate"), motion);
  }
  if (handle.has("scale"))
  {
    const JsonNode scale = handle.member("scale");
    motion.scale = scale.number();
    if (!HandleMotion::isScale(motion.scale))
    {
      scale.fail(HandleMotion::ScaleRule);
    }
  }
  if (handle.has("rotate") || handle.has("scale"))
  {
    motion.center = parseCenter(handle, where);
  }
  else if (handle.has("center"))
  {
    handle.member("center").fail("needs something that is done about it: rotate or scale");
  }
  return HandleMotion(motion);
}

DataValue parseValue(const JsonNode& node, bool position)
{
  if (!node.isString())
  {
    return node.numbers(3);
  }
  if (position && node.string() == "position")
  {
    return Position{};
  }
  return node.columnName();
}

/** Whether a target is a list of positions. */
bool isListOfPositions(const JsonNode& target)
{
  return target.value().is_array() && !target.value().empty() && target.value()[0].is_array();
}

HandleDescription::Values parseValues(const JsonNode& handle)
{
  HandleDescription::Values values;
  const JsonNode target = handle.member("target");
  if (isListOfPositions(target))
  {
    for (const JsonNode& position : target.elements())
    {
      values.targets.push_back(parseVector(position));
    }
  }
  else
  {
    values.target = parseValue(target, true);
  }
  if (handle.has("rotation"))
  {
    values.rotation = parseValue(handle.member("rotation"), false);
  }
  if (handle.has("logScale"))
  {
    const JsonNode logScale = handle.member("logScale");
    if (logScale.isString())
    {
      values.logScale = logScale.columnName();
    }
    else
    {
      values.logScale = logScale.number();
    }
  }
  return values;
}

HandleDescription parseHandle(const JsonNode& handle)
{
  handle.requireObject({ "region", "fixed", "translate", "rotate", "scale", "center", "target",
    "rotation", "logScale" });
  const JsonNode place = handle.member("region");
  place.requireObject(WhereKeys);
  const Where where = parseWhere(place);

  const bool moves = hasOneOf(handle, MotionKeys);
  const bool hasValues = hasOneOf(handle, ValueKeys);
  if (handle.has("fixed"))
  {
    const JsonNode fixed = handle.member("fixed");
    if (!fixed.isTrue())
    {
      fixed.fail("can only be true: leave it out for a handle that moves");
    }
    if (moves || hasValues)
    {
      fixed.fail(std::string("goes with no ") +
                 (moves ? "translate, rotate or scale" : "target, rotation or logScale") +
                 ": leave it or these out");
    }
  }
  else if (!moves && !hasValues)
  {
    handle.fail("must be fixed, or have at least one of translate, rotate and scale, or a target");
  }
  if (!hasValues)
  {
    return { where, parseMotion(handle, where) };
  }
  if (moves || handle.has("center"))
  {
    handle.fail("goes by its target: leave out translate, rotate, scale and center");
  }
  return { where, parseValues(handle) };
}

} // namespace

DeformationDescription parseDeformation(const JsonNode& node)
{
  node.requireObject({ "handles", "weights", "cycles", "tolerance" });
  DeformationDescription data;
  const JsonNode handles = node.member("handles");
  for (const JsonNode& handle : handles.elements())
  {
    data.handles.push_back(parseHandle(handle));
  }
  if (data.handles.empty())
  {
    handles.fail("must have at least one handle");
  }
  data.weights = parseWeights(node);
  if (node.has("cycles"))
  {
    data.cycles = static_cast<int>(node.member("cycles").integer(1, MaxCycles));
  }
  if (node.has("tolerance"))
  {
    const JsonNode tolerance = node.member("tolerance");
    data.tolerance = tolerance.number();
    if (*data.tolerance <= 0.0 || *data.tolerance >= 1.0)
    {
      tolerance.fail("must be between 0 and 1, both excluded");
    }
    if (data.cycles)
    {
      tolerance.fail("does not go with cycles: leave one out");
    }
  }
  return data;
}

DeformationDescription readHandleFile(const std::filesystem::path& path)
{
  return readHandleText(jsonFileText(path.string()), path.string());
}

DeformationDescription readHandleText(const std::string& text, const std::string& name)
{
  const nlohmann::json json = readJsonText(text, name);
  return parseDeformation(JsonNode(json, name));
}

} // namespace smg
