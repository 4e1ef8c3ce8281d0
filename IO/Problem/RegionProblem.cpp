// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/RegionProblem.h"

#include "IO/Problem/WeightsName.h"

#include <algorithm>
#include <utility>

namespace smg
{

namespace
{

constexpr std::int64_t MostColumns = 64;

RegionValue parseValue(const JsonNode& value, int columns)
{
  if (!value.isString())
  {
    return { value.numbers(static_cast<std::size_t>(columns)), false };
  }
  if (value.string() != "position")
  {
    value.fail("must be \"position\" or an array of numbers");
  }
  if (columns != 3)
  {
    value.fail("can be \"position\" only if there are 3 columns");
  }
  return { {}, true };
}

RegionProblemData parseProblem(const JsonNode& node)
{
  node.requireObject({ "weights", "columns", "dirichlet", "source", "screening" });
  RegionProblemData data;
  data.weights = parseWeights(node).value_or(data.weights);
  if (node.has("columns"))
  {
    data.columns = static_cast<int>(node.member("columns").integer(1, MostColumns));
  }
  if (node.has("screening"))
  {
    const JsonNode screening = node.member("screening");
    data.screening = screening.number();
    if (data.screening < 0.0)
    {
      screening.fail("must not be negative");
    }
  }
  if (node.has("source"))
  {
    data.source = node.member("source").numbers(static_cast<std::size_t>(data.columns));
  }
  if (node.has("dirichlet"))
  {
    for (const JsonNode& element : node.member("dirichlet").elements())
    {
      element.requireObject({ "halfspace", "box", "sphere", "vertices", "value" });
      data.regions.push_back({ Region::parse(element), element.place() });
      data.values.push_back(parseValue(element.member("value"), data.columns));
    }
  }
  return data;
}

} // namespace

RegionProblem::RegionProblem(RegionProblemData data, const StreamInfo& mesh, std::string file)
  : Regions(std::move(data.regions), mesh, std::move(file))
  , Data(std::move(data))
{
  this->AnyPosition = std::any_of(this->Data.values.begin(), this->Data.values.end(),
    [](const RegionValue& value) { return value.position; });
}

void RegionProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const auto columns = static_cast<std::size_t>(this->Data.columns);
  if (this->AnyPosition)
  {
    conditions.value = block.positions;
  }
  this->Regions.visit(block,
    [&](std::size_t i, std::size_t k)
    {
      const RegionValue& given = this->Data.values[k];
      conditions.prescribed[i] = 1;
      std::copy_n(given.position ? block.positions.data() + 3 * i : given.value.data(), columns,
        conditions.value.data() + i * columns);
    });
  const auto vertices = static_cast<std::size_t>(block.vertices());
  for (std::size_t i = 0; i < vertices && !this->Data.source.empty(); ++i)
  {
    std::copy(
      this->Data.source.begin(), this->Data.source.end(), conditions.source.data() + i * columns);
  }
}

RegionProblemData readProblemFileData(const std::filesystem::path& path)
{
  const nlohmann::json json = readJsonFile(path.string());
  return parseProblem(JsonNode(json, path.string()));
}

std::unique_ptr<RegionProblem> readProblemFile(
  const std::filesystem::path& path, const StreamInfo& mesh)
{
  return std::make_unique<RegionProblem>(readProblemFileData(path), mesh, path.string());
}

} // namespace smg
