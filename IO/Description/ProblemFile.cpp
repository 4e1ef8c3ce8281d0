// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/ParseDescriptions.h"
#include "IO/Description/ParseWhere.h"
#include "Solver/Problem/ProblemData.h"
#include "smg/DescriptionFiles.h"

#include <algorithm>
#include <type_traits>

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

/** A value that satisfies the rules, for instance a number, the numbers of all columns, a tensor,
 * or the name of a column. */
DataValue parseValue(const JsonNode& node, const ValueRules& rules)
{
  const bool isSolution = rules.range == ValueRange::Any;
  if (node.isString())
  {
    if (!isSolution || node.string() != "position")
    {
      return node.columnName();
    }
    if (!rules.positions)
    {
      node.fail("can be \"position\" only if there are 3 columns");
    }
    return Position{};
  }
  const auto most = static_cast<std::size_t>(rules.components.back());
  // A solution has as many numbers as columns, and a coefficient one number, or all of a tensor.
  const bool isNumber =
    isSolution ? most == 1 && node.value().is_number() : most == 1 || !node.value().is_array();
  std::vector<double> numbers = isNumber ? std::vector{ node.number() } : node.numbers(most);
  const char* complaint =
    isSolution ? nullptr : rules.complaint(numbers.data(), static_cast<int>(numbers.size()));
  if (complaint)
  {
    node.fail(complaint);
  }
  return numbers;
}

/** A single value, or a list of entries with such values. */
Datum parseDatum(const JsonNode& node, const ValueRules& rules)
{
  if (!isList(node))
  {
    return parseValue(node, rules);
  }
  Datum datum;
  for (const JsonNode& entry : node.elements())
  {
    requireWhereAnd(entry, { "value" });
    datum.entries.push_back({ parseWhere(entry, true), parseValue(entry.member("value"), rules) });
  }
  return datum;
}

void parse(const JsonNode& node, const DatumRow& row, ProblemDescription& problem)
{
  problem.*row.member = parseDatum(node, row.rules(problem.columns));
}

void parse(const JsonNode& node, const ColumnRow& row, ProblemDescription& problem)
{
  problem.*row.member = node.columnName();
}

/** Appends to the conditions that there are. */
template <class Condition>
void parse(const JsonNode& node, const ConditionRow<Condition>& row, ProblemDescription& problem)
{
  const ValueRules rules = row.rules(problem.columns);
  for (const JsonNode& entry : node.elements())
  {
    if constexpr (std::is_same_v<Condition, PlacedValue>)
    {
      requireWhereAnd(entry, { row.valueKey });
      (problem.*row.member)
        .push_back({ parseWhere(entry, true), parseValue(entry.member(row.valueKey), rules) });
    }
    else
    {
      requireWhereAnd(entry, { row.coefficientKey, row.valueKey });
      (problem.*row.member)
        .push_back({ parseWhere(entry, true),
          parseDatum(entry.member(row.coefficientKey), coefficientRules(problem.columns)),
          parseValue(entry.member(row.valueKey), rules) });
    }
  }
}

/** A place, or the name of a group. */
Where parsePlace(const JsonNode& node)
{
  if (node.isString())
  {
    return InGroup{ { node.string() } };
  }
  requireWhereAnd(node, {});
  return parseWhere(node);
}

double parseTolerance(const JsonNode& entry)
{
  if (!entry.has("tolerance"))
  {
    return 0.0;
  }
  const double tolerance = entry.member("tolerance").number();
  if (!(tolerance > 0.0))
  {
    entry.member("tolerance").fail("must be positive");
  }
  return tolerance;
}

/** Appends to the pairs of sides that there are: [FROM, TO] or { "sides": [FROM, TO], ... }. */
void parsePeriodic(const JsonNode& node, ProblemDescription& problem)
{
  for (const JsonNode& entry : node.elements())
  {
    const bool isPair = entry.value().is_array();
    if (!isPair)
    {
      entry.requireObject({ "sides", "jump", "tolerance" });
    }
    const JsonNode sides = isPair ? entry : entry.member("sides");
    const std::vector<JsonNode> places = sides.elements();
    if (places.size() != 2)
    {
      sides.fail("must have two sides: the names of two groups, or two places");
    }
    ProblemDescription::Periodic periodic{ parsePlace(places[0]), parsePlace(places[1]) };
    if (!isPair && entry.has("jump"))
    {
      const JsonNode jump = entry.member("jump");
      periodic.jump = jump.value().is_number()
                        ? std::vector{ jump.number() }
                        : jump.numbers(static_cast<std::size_t>(problem.columns));
    }
    periodic.tolerance = isPair ? 0.0 : parseTolerance(entry);
    problem.periodic.push_back(std::move(periodic));
  }
}

/** Appends to the contacts that there are. */
void parseInterfaces(const JsonNode& node, ProblemDescription& problem)
{
  for (const JsonNode& entry : node.value().is_object() ? std::vector{ node } : node.elements())
  {
    requireWhereAnd(entry, { "coefficient", "tolerance" });
    const JsonNode coefficient = entry.member("coefficient");
    if (!(coefficient.number() >= 0.0))
    {
      coefficient.fail("must not be negative");
    }
    problem.interfaces.push_back(
      { parseWhere(entry), coefficient.number(), parseTolerance(entry) });
  }
}

/** A result besides the solution. */
struct Output
{
  const char* key;
  bool ProblemDescription::*member;
};

constexpr Output Outputs[] = {
  { "gradient", &ProblemDescription::gradientOutput },
  { "flux", &ProblemDescription::fluxOutput },
  { "gradient at vertices", &ProblemDescription::vertexGradientOutput },
};

void parseOutputs(const JsonNode& node, ProblemDescription& problem)
{
  for (const JsonNode& output : node.elements())
  {
    const std::string name = output.string();
    const auto known = std::ranges::find(Outputs, name, &Output::key);
    if (known == std::end(Outputs))
    {
      output.fail("must be \"gradient\", \"flux\" or \"gradient at vertices\"");
    }
    problem.*known->member = true;
  }
}

} // namespace

ProblemDescription parseProblem(const JsonNode& node, const ProblemDescription& defaults)
{
  ProblemDescription problem = defaults;
  node.requireObject(ProblemKeys);
  problem.weights = parseWeights(node).value_or(problem.weights);
  if (node.has("columns"))
  {
    problem.columns = static_cast<int>(node.member("columns").integer(1, MaxColumns));
  }
  forProblemData(
    [&](const auto& row)
    {
      if (node.has(row.key))
      {
        parse(node.member(row.key), row, problem);
      }
    });
  if (node.has("periodic"))
  {
    parsePeriodic(node.member("periodic"), problem);
  }
  if (node.has("interface"))
  {
    parseInterfaces(node.member("interface"), problem);
  }
  if (node.has("outputs"))
  {
    parseOutputs(node.member("outputs"), problem);
  }
  if (node.has("integrals"))
  {
    problem.integrals = parseGroups(node.member("integrals"));
  }
  return problem;
}

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

std::vector<Where> parsePlaces(const JsonNode& node)
{
  std::vector<Where> places;
  const std::vector<JsonNode> objects =
    node.value().is_array() ? node.elements() : std::vector{ node };
  if (objects.empty())
  {
    node.fail("must have at least one place: leave it out for none");
  }
  for (const JsonNode& object : objects)
  {
    requireWhereAnd(object, { "everywhere" });
    if (!object.has("everywhere"))
    {
      places.push_back(parseWhere(object, false, true));
      continue;
    }
    const bool hasOthers =
      std::ranges::any_of(WhereKeys, [&object](const char* key) { return object.has(key); });
    if (hasOthers || !object.member("everywhere").isTrue())
    {
      object.fail("everywhere can only be true, and stands alone: leave it out for another place");
    }
    places.emplace_back(Everywhere{});
  }
  return places;
}

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
