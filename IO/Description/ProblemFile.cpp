// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/ParseWhere.h"
#include "Solver/Problem/Coefficient.h"
#include "smg/DescriptionFiles.h"

namespace smg
{

namespace
{

constexpr std::int64_t MaxColumns = ProblemDescription::MaxColumns;

/** Whether the value is a list of entries, each with a value. */
bool isList(const JsonNode& node)
{
  return node.value().is_array() && !node.value().empty() && node.value()[0].is_object();
}

/** A single value parsed by `parse(node)`, or a list of entries with such values. */
Datum parseDatum(const JsonNode& node, auto parse)
{
  if (!isList(node))
  {
    return parse(node);
  }
  Datum datum;
  for (const JsonNode& entry : node.elements())
  {
    requireWhereAnd(entry, { "value" });
    datum.entries.push_back({ parseWhere(entry, true), parse(entry.member("value")) });
  }
  return datum;
}

DataValue parseNumbers(const JsonNode& node, std::vector<double> numbers, ValueRange range)
{
  const ValueRules rules{ .components = {}, .range = range };
  if (const char* complaint = rules.complaint(numbers.data(), static_cast<int>(numbers.size())))
  {
    node.fail(complaint);
  }
  return numbers;
}

DataValue parseConductivity(const JsonNode& node)
{
  if (node.isString())
  {
    return node.columnName();
  }
  return parseNumbers(node,
    node.value().is_array() ? node.numbers(6) : std::vector{ node.number() },
    ValueRange::PositiveDefinite);
}

DataValue parseCoefficient(const JsonNode& node)
{
  if (node.isString())
  {
    return node.columnName();
  }
  return parseNumbers(node, { node.number() }, ValueRange::NotNegative);
}

/** Reads values of this many numbers. */
struct ValueParser
{
  int columns;

  DataValue operator()(const JsonNode& node) const
  {
    if (this->columns == 1 && node.value().is_number())
    {
      return std::vector{ node.number() };
    }
    if (!node.isString())
    {
      return node.numbers(static_cast<std::size_t>(this->columns));
    }
    if (node.string() != "position")
    {
      return node.columnName();
    }
    if (this->columns != 3)
    {
      node.fail("can be \"position\" only if there are 3 columns");
    }
    return Position{};
  }
};

void parseConditions(const JsonNode& node, ValueParser parseValue, ProblemDescription& problem)
{
  const auto forEach = [&node](const char* key, auto parse)
  {
    for (const JsonNode& entry :
      node.has(key) ? node.member(key).elements() : std::vector<JsonNode>())
    {
      parse(entry);
    }
  };
  const auto placedValue = [&](const JsonNode& entry) -> PlacedValue
  {
    requireWhereAnd(entry, { "value" });
    return { parseWhere(entry, true), parseValue(entry.member("value")) };
  };
  forEach(
    "dirichlet", [&](const JsonNode& entry) { problem.dirichlet.push_back(placedValue(entry)); });
  forEach("flux", [&](const JsonNode& entry) { problem.flux.push_back(placedValue(entry)); });
  forEach("robin",
    [&](const JsonNode& entry)
    {
      requireWhereAnd(entry, { "coefficient", "ambient" });
      problem.robin.push_back(
        { parseWhere(entry, true), parseDatum(entry.member("coefficient"), parseCoefficient),
          parseValue(entry.member("ambient")) });
    });
  forEach("soft",
    [&](const JsonNode& entry)
    {
      requireWhereAnd(entry, { "weight", "value" });
      problem.soft.push_back({ parseWhere(entry, true),
        parseDatum(entry.member("weight"), parseCoefficient), parseValue(entry.member("value")) });
    });
}

void parseOutputs(const JsonNode& node, ProblemDescription& problem)
{
  for (const JsonNode& output : node.elements())
  {
    const std::string name = output.string();
    if (name != "gradient" && name != "flux")
    {
      output.fail("must be \"gradient\" or \"flux\"");
    }
    (name == "gradient" ? problem.gradientOutput : problem.fluxOutput) = true;
  }
}

ProblemDescription parseProblem(const JsonNode& node, ProblemDescription problem)
{
  node.requireObject(ProblemKeys);
  problem.weights = parseWeights(node).value_or(problem.weights);
  if (node.has("columns"))
  {
    problem.columns = static_cast<int>(node.member("columns").integer(1, MaxColumns));
  }
  const ValueParser parseValue{ problem.columns };
  if (node.has("conductivity"))
  {
    problem.conductivity = parseDatum(node.member("conductivity"), parseConductivity);
  }
  if (node.has("screening"))
  {
    problem.screening = parseDatum(node.member("screening"), parseCoefficient);
  }
  if (node.has("source"))
  {
    problem.source = parseDatum(node.member("source"), parseValue);
  }
  if (node.has("field"))
  {
    problem.field = node.member("field").columnName();
  }
  if (node.has("initial"))
  {
    problem.initial = parseDatum(node.member("initial"), parseValue);
  }
  parseConditions(node, parseValue, problem);
  if (node.has("outputs"))
  {
    parseOutputs(node.member("outputs"), problem);
  }
  return problem;
}

} // namespace

ProblemDescription readProblemFile(
  const std::filesystem::path& path, const ProblemDescription& defaults)
{
  const nlohmann::json json = readJsonFile(path.string());
  return parseProblem(JsonNode(json, path.string()), defaults);
}

ProblemDescription readProblemText(
  const std::string& text, const std::string& name, const ProblemDescription& defaults)
{
  const nlohmann::json json = readJsonText(text, name);
  return parseProblem(JsonNode(json, name), defaults);
}

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
