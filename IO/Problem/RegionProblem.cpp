// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/RegionProblem.h"

#include "IO/Problem/WeightsName.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <cmath>
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

void parseConductivity(const JsonNode& node, RegionProblemData& data)
{
  if (data.weights == Weights::Uniform)
  {
    node.fail("can be given with cotangent weights only");
  }
  if (node.isString() && !node.string().empty())
  {
    data.conductivityColumn = node.string();
    return;
  }
  data.conductivity = node.number();
  if (data.conductivity <= 0.0)
  {
    node.fail("must be a positive number or the name of a cell column");
  }
}

RegionProblemData parseProblem(const JsonNode& node)
{
  node.requireObject({ "weights", "columns", "dirichlet", "source", "screening", "conductivity" });
  RegionProblemData data;
  data.weights = parseWeights(node, true).value_or(data.weights);
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
  if (node.has("conductivity"))
  {
    parseConductivity(node.member("conductivity"), data);
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
  : File(std::move(file))
  , Regions(std::move(data.regions), mesh, this->File)
  , Data(std::move(data))
{
  const std::string& name = this->Data.conductivityColumn;
  if (!name.empty() && std::ranges::none_of(mesh.cellColumns, [&name](const ColumnSpec& spec)
                         { return spec.name == name && spec.components == 1; }))
  {
    throw Error(this->File + ": conductivity: the mesh has no cell column '" + name +
                "' of one number a cell.");
  }
  this->AnyPosition = std::any_of(this->Data.values.begin(), this->Data.values.end(),
    [](const RegionValue& value) { return value.position; });
}

bool RegionProblem::hasCells() const
{
  return this->Data.conductivity != 1.0 || !this->Data.conductivityColumn.empty();
}

std::vector<std::string> RegionProblem::cellColumns() const
{
  const std::string& name = this->Data.conductivityColumn;
  return name.empty() ? std::vector<std::string>{} : std::vector{ name };
}

/** The column of the conductivity; none if all cells have the same. */
const Column* RegionProblem::conductivityOf(const MeshBlock& block) const
{
  const std::string& name = this->Data.conductivityColumn;
  const auto found = std::ranges::find_if(
    block.cellColumns, [&name](const Column& column) { return column.spec.name == name; });
  if (found == block.cellColumns.end() && !name.empty())
  {
    throw Error(this->File + ": conductivity: the mesh source does not deliver the cell column '" +
                name + "'.");
  }
  return name.empty() ? nullptr : &*found;
}

void RegionProblem::cells(CellBatch& batch)
{
  const Column* column = this->conductivityOf(batch.block);
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    const double factor = column ? column->value(batch.first + c) : this->Data.conductivity;
    if (!(factor > 0.0 && std::isfinite(factor)))
    {
      const auto number = batch.block.firstCell + static_cast<std::int64_t>(batch.first + c);
      throw Error(
        this->File + ": conductivity: it must be a positive number in each cell, but is " +
        std::to_string(factor) + " in cell " + std::to_string(number) + " of the stream.");
    }
    for (double& weight : batch.weightsOf(c))
    {
      weight *= factor;
    }
  }
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
      conditions.dirichlet[i] = 0;
      std::copy_n(given.position ? block.positions.data() + 3 * i : given.value.data(), columns,
        conditions.value.data() + i * columns);
    });
  std::ranges::fill(conditions.screening, this->Data.screening);
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
