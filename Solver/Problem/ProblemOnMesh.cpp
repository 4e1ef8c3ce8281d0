// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ProblemOnMesh.h"

#include "Solver/Mesh/StreamCheck.h"
#include "smg/Error.h"

#include <algorithm>

namespace smg
{

namespace
{

constexpr int MostColumns = ProblemDescription::MostColumns;

std::string keyOf(const char* list, std::size_t k)
{
  return std::string(list) + '[' + std::to_string(k) + ']';
}

ValueRules valueRules(int columns)
{
  return { .components = { columns }, .positions = columns == 3 };
}

/** A solution, whose values may be missing, is an initial value of another solve. */
ValueRules initialRules(int columns)
{
  ValueRules rules = valueRules(columns);
  rules.missing = true;
  return rules;
}

const ValueRules CoefficientRules{ .components = { 1 }, .range = ValueRange::NotNegative };
const ValueRules ConductivityRules{ .components = { 1, 3, 6 },
  .range = ValueRange::PositiveDefinite,
  .preferred = ColumnOwner::Cells };

ValueRules fieldRules(int columns)
{
  return { .components = columns == 1 ? std::vector{ 3 } : std::vector{ 3, 3 * columns },
    .preferred = ColumnOwner::Cells };
}

/** The selecting column; null for other places. */
const std::string* columnOf(const Where& where)
{
  if (const auto* tag = std::get_if<ColumnTag>(&where))
  {
    return &tag->column;
  }
  const auto* mask = std::get_if<ColumnMask>(&where);
  return mask ? &mask->column : nullptr;
}

} // namespace

ProblemOnMesh::ProblemOnMesh(
  const ProblemDescription& description, const StreamInfo& mesh, const std::string& name)
  : OfMesh(mesh, name)
  , Columns(static_cast<std::size_t>(description.columns))
  , EdgeWeights(description.weights)
  , ScreeningPlace(this->placeOf(description.screening))
  , SourcePlace(this->placeOf(description.source))
  , Conductivity(this->OfMesh, DataPlace::Cells, ConductivityRules)
  , Screening(this->OfMesh, this->ScreeningPlace, CoefficientRules)
  , Source(this->OfMesh, this->SourcePlace, valueRules(description.columns))
  , Field(this->OfMesh, DataPlace::Cells, fieldRules(description.columns))
  , Initial(this->OfMesh, DataPlace::Vertices, initialRules(description.columns))
  , Dirichlet(this->OfMesh, DataPlace::Vertices, valueRules(description.columns))
  , Flux(this->OfMesh, DataPlace::Facets, valueRules(description.columns))
  , Ambient(this->OfMesh, DataPlace::Facets, valueRules(description.columns))
{
  if (description.columns < 1 || description.columns > MostColumns)
  {
    this->OfMesh.fail("columns", "must be from 1 to " + std::to_string(MostColumns));
  }
  if (description.conductivity.isGiven() && this->EdgeWeights == Weights::Uniform)
  {
    this->OfMesh.fail("conductivity", "goes with cotangent and clamped weights only");
  }
  this->Conductivity.add(description.conductivity, "conductivity");
  this->Screening.add(description.screening, "screening");
  this->Source.add(description.source, "source");
  if (!description.field.empty())
  {
    this->Field.add(Everywhere{}, description.field, "field", "field");
  }
  this->Initial.add(description.initial, "initial");
  for (std::size_t k = 0; k < description.dirichlet.size(); ++k)
  {
    const auto& [where, value] = description.dirichlet[k];
    this->Dirichlet.add(where, value, keyOf("dirichlet", k), keyOf("dirichlet", k) + ".value");
  }
  for (std::size_t k = 0; k < description.flux.size(); ++k)
  {
    const auto& [where, value] = description.flux[k];
    this->Flux.add(where, value, keyOf("flux", k), keyOf("flux", k) + ".value");
  }
  this->addRobin(description);
  this->addSoft(description);
  this->StartsAtPosition = !this->Initial.isGiven() &&
                           std::ranges::any_of(description.dirichlet,
                             [](const PlacedValue& entry) { return entry.value.isPosition(); });
  if (ProblemOnMesh::hasCells() || ProblemOnMesh::hasFacets())
  {
    this->OfMesh.requireCellIds(); // for error messages of the solver
  }
}

DataPlace ProblemOnMesh::placeOf(const Datum& density) const
{
  const auto isOfCells = [this](const std::string* column)
  { return column && this->OfMesh.isOfCells(*column, ColumnOwner::Vertices); };
  const bool inCells = std::ranges::any_of(density.entries, [&](const PlacedValue& entry)
    { return isOfCells(columnOf(entry.where)) || isOfCells(entry.value.column()); });
  return inCells ? DataPlace::Cells : DataPlace::Vertices;
}

void ProblemOnMesh::addRobin(const ProblemDescription& description)
{
  for (std::size_t k = 0; k < description.robin.size(); ++k)
  {
    const ProblemDescription::Robin& robin = description.robin[k];
    const std::string key = keyOf("robin", k);
    this->Ambient.add(robin.where, robin.ambient, key, key + ".ambient");
    this->Coefficients.emplace_back(this->OfMesh, DataPlace::Facets, CoefficientRules);
    this->Coefficients.back().add(robin.coefficient, key + ".coefficient");
  }
}

void ProblemOnMesh::addSoft(const ProblemDescription& description)
{
  for (std::size_t k = 0; k < description.soft.size(); ++k)
  {
    const ProblemDescription::Soft& soft = description.soft[k];
    const std::string key = keyOf("soft", k);
    this->Softs.push_back({ { this->OfMesh, DataPlace::Vertices, valueRules(description.columns) },
      { this->OfMesh, DataPlace::Vertices, CoefficientRules } });
    this->Softs.back().value.add(soft.where, soft.value, key, key + ".value");
    this->Softs.back().weight.add(soft.weight, key + ".weight");
  }
}

std::vector<DatumOnMesh*> ProblemOnMesh::data()
{
  std::vector<DatumOnMesh*> data{ &this->Conductivity, &this->Screening, &this->Source,
    &this->Field, &this->Initial, &this->Dirichlet, &this->Flux, &this->Ambient };
  for (DatumOnMesh& coefficient : this->Coefficients)
  {
    data.push_back(&coefficient);
  }
  for (Soft& soft : this->Softs)
  {
    data.push_back(&soft.value);
    data.push_back(&soft.weight);
  }
  return data;
}

void ProblemOnMesh::prepare(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->preparePart(mesh, scratch, memoryLimit);
  this->endPreparing(nullptr);
}

void ProblemOnMesh::preparePart(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OfMesh.memory().setLimit(memoryLimit);
  const std::vector<DatumOnMesh*> data = this->data();
  const bool selects =
    std::ranges::any_of(data, [](const DatumOnMesh* datum) { return datum->selects(); });
  if (selects)
  {
    forCheckedBlocks(
      mesh,
      [&](const MeshBlock& block)
      {
        for (DatumOnMesh* datum : data)
        {
          datum->prepare(block, scratch);
        }
      },
      true);
  }
}

void ProblemOnMesh::endPreparing(MeshParts* parts)
{
  for (DatumOnMesh* datum : this->data())
  {
    datum->endPreparing(parts);
  }
  this->OfMesh.memory().setLimit(INT64_MAX); // that of a solve counts from now on
}

ConditionCounts ProblemOnMesh::conditionCounts() const
{
  return { this->Dirichlet.entries(), this->Flux.entries(), this->Ambient.entries() };
}

bool ProblemOnMesh::hasCells() const
{
  return this->Conductivity.isGiven() || this->Field.isGiven() ||
         (this->Screening.isGiven() && this->ScreeningPlace == DataPlace::Cells) ||
         (this->Source.isGiven() && this->SourcePlace == DataPlace::Cells);
}

} // namespace smg
