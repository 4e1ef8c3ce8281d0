// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/RegionProblem.h"

#include "IO/Formats/StreamConversion.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <span>

namespace smg
{

namespace
{

constexpr std::int64_t MostColumns = 64;

bool isIdColumn(const ColumnSpec& spec)
{
  return spec == ColumnSpec{ OriginalIdName, ScalarType::Int64, 1 };
}

std::span<const double, 3> pointOf(const MeshBlock& block, std::size_t i)
{
  return std::span<const double, 3>(block.positions.data() + 3 * i, 3);
}

DirichletRegion parseDirichlet(const JsonNode& node, int columns)
{
  node.requireObject({ "halfspace", "box", "sphere", "vertices", "value" });
  DirichletRegion dirichlet{ Region::parse(node), {}, false, node.place() };
  const JsonNode value = node.member("value");
  if (!value.isString())
  {
    dirichlet.value = value.numbers(static_cast<std::size_t>(columns));
    return dirichlet;
  }
  if (value.string() != "position")
  {
    value.fail("must be \"position\" or an array of numbers");
  }
  if (columns != 3)
  {
    value.fail("can be \"position\" only if there are 3 columns");
  }
  dirichlet.position = true;
  return dirichlet;
}

RegionProblemData parseProblem(const JsonNode& node)
{
  node.requireObject({ "weights", "columns", "dirichlet", "source", "screening" });
  RegionProblemData data;
  if (node.has("weights"))
  {
    const JsonNode weights = node.member("weights");
    const std::string name = weights.string();
    if (name != "cotangent" && name != "uniform")
    {
      weights.fail("must be \"cotangent\" or \"uniform\"");
    }
    data.weights = name == "uniform" ? Weights::Uniform : Weights::Cotangent;
  }
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
      data.dirichlet.push_back(parseDirichlet(element, data.columns));
    }
  }
  return data;
}

} // namespace

RegionProblem::RegionProblem(RegionProblemData data, const StreamInfo& mesh, std::string file)
  : Data(std::move(data))
  , File(std::move(file))
{
  this->HasIds = std::any_of(mesh.vertexColumns.begin(), mesh.vertexColumns.end(), isIdColumn);
  this->AnyPosition = std::any_of(this->Data.dirichlet.begin(), this->Data.dirichlet.end(),
    [](const DirichletRegion& dirichlet) { return dirichlet.position; });
}

std::vector<std::string> RegionProblem::vertexColumns() const
{
  const bool named = std::any_of(this->Data.dirichlet.begin(), this->Data.dirichlet.end(),
    [](const DirichletRegion& dirichlet) { return dirichlet.region.vertices() != nullptr; });
  return this->HasIds && named ? std::vector<std::string>{ OriginalIdName }
                               : std::vector<std::string>{};
}

const Column* RegionProblem::idColumn(const MeshBlock& block) const
{
  const auto found = std::find_if(block.vertexColumns.begin(), block.vertexColumns.end(),
    [](const Column& column) { return isIdColumn(column.spec); });
  if (found == block.vertexColumns.end() && !this->vertexColumns().empty())
  {
    throw Error(this->File + ": the mesh is read without its column " + OriginalIdName +
                ", which the regions of vertices need.");
  }
  return found == block.vertexColumns.end() ? nullptr : &*found;
}

std::int64_t RegionProblem::idOf(const MeshBlock& block, const Column* ids, std::size_t i) const
{
  return ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
}

void RegionProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  const auto columns = static_cast<std::size_t>(this->Data.columns);
  const Column* ids = this->idColumn(block);
  if (this->AnyPosition)
  {
    conditions.value = block.positions;
  }
  for (std::size_t i = 0; i < vertices; ++i)
  {
    const std::int64_t id = this->idOf(block, ids, i);
    double* value = conditions.value.data() + i * columns;
    // The last region that holds the vertex is the one that counts.
    for (std::size_t k = this->Data.dirichlet.size(); k-- > 0;)
    {
      const DirichletRegion& dirichlet = this->Data.dirichlet[k];
      if (dirichlet.region.contains(pointOf(block, i), id))
      {
        conditions.prescribed[i] = 1;
        const double* from =
          dirichlet.position ? block.positions.data() + 3 * i : dirichlet.value.data();
        std::copy_n(from, columns, value);
        break;
      }
    }
    if (!this->Data.source.empty())
    {
      std::copy(
        this->Data.source.begin(), this->Data.source.end(), conditions.source.data() + i * columns);
    }
  }
}

void RegionProblem::check(MeshSource& mesh) const
{
  struct Found
  {
    std::int64_t vertices = 0;
    std::vector<bool> ids; ///< which of the region's vertices the mesh has
  };
  std::vector<Found> found(this->Data.dirichlet.size());
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const Region::Vertices* named = this->Data.dirichlet[k].region.vertices();
    found[k].ids.resize(named ? named->ids.size() : 0);
  }
  for (MeshBlock block; !found.empty() && mesh.next(block);)
  {
    const Column* ids = this->idColumn(block);
    for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
    {
      const std::int64_t id = this->idOf(block, ids, i);
      for (std::size_t k = 0; k < found.size(); ++k)
      {
        const Region& region = this->Data.dirichlet[k].region;
        if (region.contains(pointOf(block, i), id))
        {
          ++found[k].vertices;
          if (const Region::Vertices* named = region.vertices())
          {
            const auto place = std::lower_bound(named->ids.begin(), named->ids.end(), id);
            found[k].ids[static_cast<std::size_t>(place - named->ids.begin())] = true;
          }
        }
      }
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const DirichletRegion& dirichlet = this->Data.dirichlet[k];
    const std::string place = this->File + ": " + dirichlet.name;
    const auto missing = std::find(found[k].ids.begin(), found[k].ids.end(), false);
    if (missing != found[k].ids.end())
    {
      const std::int64_t id =
        dirichlet.region.vertices()->ids[static_cast<std::size_t>(missing - found[k].ids.begin())];
      throw Error(place + ".vertices: the mesh has no vertex with the original number " +
                  std::to_string(id) + ", or it belongs to no cell.");
    }
    if (found[k].vertices == 0)
    {
      throw Error(place + ": no vertex of the mesh is in this region.");
    }
  }
}

std::unique_ptr<RegionProblem> readProblemFile(
  const std::filesystem::path& path, const StreamInfo& mesh)
{
  const nlohmann::json json = readJsonFile(path.string());
  return std::make_unique<RegionProblem>(
    parseProblem(JsonNode(json, path.string())), mesh, path.string());
}

} // namespace smg
