// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedProblem.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Problem/PiecewiseCoefficient.h"
#include "Solver/Problem/StartValues.h"
#include "smg/Error.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

// A ProblemDescription on its mesh, as a Problem of the solver: every datum is a
// PiecewiseCoefficient at vertices, in cells or on facets, evaluated block by block. Values depend
// on the place in the mesh alone, not on blocks or batches; memory is kept for open vertices only.

namespace smg
{

/** The implementation of DescribedProblem: the data of a description, resolved on a mesh. */
class ProblemOnMesh : public Problem
{
public:
  /** Like DescribedProblem. */
  ProblemOnMesh(
    const ProblemDescription& description, const StreamInfo& mesh, const std::string& name);
  ProblemOnMesh(const ProblemOnMesh&) = delete;
  ProblemOnMesh& operator=(const ProblemOnMesh&) = delete;

  /** The columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const { return this->OfMesh.vertexColumns(); }
  std::vector<std::string> cellColumns() const { return this->OfMesh.cellColumns(); }

  /** Like DescribedProblem::prepare(). */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit);
  /** Like DescribedProblem::preparePart() and endPreparing(). */
  void preparePart(
    MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit);
  void endPreparing(MeshParts* parts);

  int columns() const override { return static_cast<int>(this->Columns); }
  Weights weights() const override { return this->EdgeWeights; }
  ConditionCounts conditionCounts() const override;
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasCells() const override;
  void cells(CellBatch& batch) override;
  bool hasFacets() const override { return this->Flux.isGiven() || this->Ambient.isGiven(); }
  void facets(FacetBatch& batch) override;
  std::int64_t bytes() const override { return this->OfMesh.memory().used(); }

private:
  struct Soft
  {
    PiecewiseCoefficient value, weight;
  };

  /** The place of a density: the vertices, unless an entry names a column of the cells. */
  DataPlace placeOf(const Datum& density) const;
  void addRobin(const ProblemDescription& description);
  void addSoft(const ProblemDescription& description);
  /** All data. */
  std::vector<PiecewiseCoefficient*> data();

  void setValues(const MeshBlock& block, VertexConditions& conditions);
  void addSoft(const MeshBlock& block, VertexConditions& conditions);
  void setConductivity(const CellRange& cells, CellBatch& batch);
  void setField(const CellRange& cells, CellBatch& batch);
  void setRobin(const CellRange& cells, FacetBatch& batch);
  /** Evaluates a density at the vertices of a block, or in cells. */
  void setDensity(
    const PiecewiseCoefficient& datum, const MeshBlock& block, std::vector<double>& density);
  void setDensity(
    const PiecewiseCoefficient& datum, const CellRange& cells, std::span<double> density);

  MeshColumns OfMesh;
  std::size_t Columns;
  Weights EdgeWeights;
  StartValues Start;
  DataPlace ScreeningPlace, SourcePlace;
  PiecewiseCoefficient Conductivity, Screening, Source, Field, Initial, Dirichlet, Flux;
  PiecewiseCoefficient Ambient;                   ///< of the Robin conditions
  std::vector<PiecewiseCoefficient> Coefficients; ///< of each of them
  std::vector<Soft> Softs;
  std::vector<std::int32_t> Entry,
    Other;                    ///< applicable entries at vertices, in cells, or on facets
  std::vector<double> Values; ///< their values
};

// DescribedProblem only forwards, which keeps the private classes out of the public header.
DescribedProblem::DescribedProblem(
  const ProblemDescription& description, const StreamInfo& mesh, const std::string& name)
  : OnMesh(std::make_unique<ProblemOnMesh>(description, mesh, name))
{
}

DescribedProblem::~DescribedProblem() = default;

std::vector<std::string> DescribedProblem::vertexColumns() const
{
  return this->OnMesh->vertexColumns();
}

std::vector<std::string> DescribedProblem::cellColumns() const
{
  return this->OnMesh->cellColumns();
}

void DescribedProblem::prepare(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OnMesh->prepare(mesh, scratch, memoryLimit);
}

void DescribedProblem::preparePart(
  MeshSource& part, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OnMesh->preparePart(part, scratch, memoryLimit);
}

std::int64_t DescribedProblem::bytes() const
{
  return this->OnMesh->bytes();
}

void DescribedProblem::endPreparing(MeshParts& parts)
{
  this->OnMesh->endPreparing(&parts);
}

int DescribedProblem::columns() const
{
  return this->OnMesh->columns();
}

Weights DescribedProblem::weights() const
{
  return this->OnMesh->weights();
}

ConditionCounts DescribedProblem::conditionCounts() const
{
  return this->OnMesh->conditionCounts();
}

void DescribedProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  this->OnMesh->conditions(block, conditions);
}

bool DescribedProblem::hasCells() const
{
  return this->OnMesh->hasCells();
}

void DescribedProblem::cells(CellBatch& batch)
{
  this->OnMesh->cells(batch);
}

bool DescribedProblem::hasFacets() const
{
  return this->OnMesh->hasFacets();
}

void DescribedProblem::facets(FacetBatch& batch)
{
  this->OnMesh->facets(batch);
}

namespace
{

constexpr int MaxColumns = ProblemDescription::MaxColumns;

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
  // 3 components: one vector for all columns.
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
  if (description.columns < 1 || description.columns > MaxColumns)
  {
    this->OfMesh.fail("columns", "must be from 1 to " + std::to_string(MaxColumns));
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
  this->Start = StartValues(description);
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
    // The ambient values decide which condition holds where; each condition has a coefficient of
    // its own.
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
    // Soft constraints add up, so each is a datum of its own, not an entry of one.
    this->Softs.push_back({ { this->OfMesh, DataPlace::Vertices, valueRules(description.columns) },
      { this->OfMesh, DataPlace::Vertices, CoefficientRules } });
    this->Softs.back().value.add(soft.where, soft.value, key, key + ".value");
    this->Softs.back().weight.add(soft.weight, key + ".weight");
  }
}

std::vector<PiecewiseCoefficient*> ProblemOnMesh::data()
{
  std::vector<PiecewiseCoefficient*> data{ &this->Conductivity, &this->Screening, &this->Source,
    &this->Field, &this->Initial, &this->Dirichlet, &this->Flux, &this->Ambient };
  for (PiecewiseCoefficient& coefficient : this->Coefficients)
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
  const std::vector<PiecewiseCoefficient*> data = this->data();
  const bool selects =
    std::ranges::any_of(data, [](const PiecewiseCoefficient* datum) { return datum->selects(); });
  if (selects)
  {
    // Without parts of the mesh there is nothing to prepare. The reading also checks that no part
    // is empty.
    forCheckedBlocks(
      mesh,
      [&](const MeshBlock& block)
      {
        for (PiecewiseCoefficient* datum : data)
        {
          datum->prepare(block, scratch);
        }
      },
      true);
  }
}

void ProblemOnMesh::endPreparing(MeshParts* parts)
{
  for (PiecewiseCoefficient* datum : this->data())
  {
    datum->endPreparing(parts);
  }
  // A solve counts this memory within its own limit, see Problem::bytes().
  this->OfMesh.memory().setLimit(INT64_MAX);
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

// Evaluation of a described problem on a block of its mesh.

void ProblemOnMesh::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  for (PiecewiseCoefficient* datum : this->data())
  {
    if (datum->needsPreparing())
    {
      throw Error(
        "Nearest vertices, the vertices of cells and the boundary are found by a previous reading "
        "of the mesh: call DescribedProblem::prepare().");
    }
    // For all data: cells() and facets() of this block follow.
    datum->startBlock(block);
  }
  this->setValues(block, conditions);
  if (this->SourcePlace == DataPlace::Vertices)
  {
    this->setDensity(this->Source, block, conditions.source);
  }
  if (this->ScreeningPlace == DataPlace::Vertices)
  {
    this->setDensity(this->Screening, block, conditions.screening);
  }
  this->addSoft(block, conditions);
}

void ProblemOnMesh::setValues(const MeshBlock& block, VertexConditions& conditions)
{
  this->Start.set(block, conditions.value);
  this->Dirichlet.entriesAtVertices(conditions.dirichlet);
  this->Entry.assign(conditions.dirichlet.size(), -1);
  this->Initial.entriesAtVertices(this->Entry);
  // Initial values at prescribed vertices are not used: they may be anything, also NaN.
  for (std::size_t i = 0; i < this->Entry.size(); ++i)
  {
    this->Entry[i] = conditions.dirichlet[i] >= 0 ? -1 : this->Entry[i];
  }
  this->Initial.valuesAtVertices(block, this->Entry, conditions.value.data(), this->Columns);
  // A missing initial value is 0, as if none were given.
  std::ranges::replace_if(
    conditions.value, [](double value) { return std::isnan(value); }, 0.0);
  this->Dirichlet.valuesAtVertices(
    block, conditions.dirichlet, conditions.value.data(), this->Columns);
}

void ProblemOnMesh::setDensity(
  const PiecewiseCoefficient& datum, const MeshBlock& block, std::vector<double>& density)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  this->Entry.assign(vertices, -1);
  datum.entriesAtVertices(this->Entry);
  datum.valuesAtVertices(
    block, this->Entry, density.data(), vertices == 0 ? 0 : density.size() / vertices);
}

void ProblemOnMesh::setDensity(
  const PiecewiseCoefficient& datum, const CellRange& cells, std::span<double> density)
{
  datum.entriesAtCells(cells, this->Entry);
  datum.valuesAtCells(cells, this->Entry, density.data(), density.size() / this->Entry.size());
}

void ProblemOnMesh::addSoft(const MeshBlock& block, VertexConditions& conditions)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  std::vector<double> weight;
  for (const Soft& soft : this->Softs)
  {
    this->Entry.assign(vertices, -1);
    soft.value.entriesAtVertices(this->Entry);
    this->Values.resize(vertices * this->Columns);
    soft.value.valuesAtVertices(block, this->Entry, this->Values.data(), this->Columns);
    this->Other.assign(vertices, -1);
    soft.weight.entriesAtVertices(this->Other);
    for (std::size_t i = 0; i < vertices; ++i)
    {
      // A weight counts only where its constraint holds.
      this->Other[i] = this->Entry[i] >= 0 ? this->Other[i] : -1;
    }
    // Where no weight is given, it is 0.
    weight.assign(vertices, 0.0);
    soft.weight.valuesAtVertices(block, this->Other, weight.data(), 1);
    for (std::size_t i = 0; i < vertices; ++i)
    {
      // weight * (u - value) is a screening and a source.
      conditions.screening[i] += weight[i];
      for (std::size_t k = i * this->Columns; this->Other[i] >= 0 && k < (i + 1) * this->Columns;
           ++k)
      {
        conditions.source[k] += weight[i] * this->Values[k];
      }
    }
  }
}

void ProblemOnMesh::cells(CellBatch& batch)
{
  const CellRange cells{ batch.block, batch.first, batch.corners };
  this->setConductivity(cells, batch);
  this->setField(cells, batch);
  if (this->SourcePlace == DataPlace::Cells)
  {
    this->Entry.assign(batch.cells(), -1);
    this->setDensity(this->Source, cells, batch.source);
  }
  if (this->ScreeningPlace == DataPlace::Cells)
  {
    this->Entry.assign(batch.cells(), -1);
    this->setDensity(this->Screening, cells, batch.screening);
  }
}

/** A number scales the weights of the cell, a tensor takes new ones. */
void ProblemOnMesh::setConductivity(const CellRange& cells, CellBatch& batch)
{
  if (!this->Conductivity.isGiven())
  {
    return;
  }
  this->Entry.assign(batch.cells(), -1);
  this->Conductivity.entriesAtCells(cells, this->Entry);
  this->Values.resize(6 * batch.cells());
  this->Conductivity.valuesAtCells(cells, this->Entry, this->Values.data(), 6);
  const auto corners = cornersOf(batch.type);
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    if (this->Entry[c] < 0)
    {
      continue;
    }
    const double* numbers = this->Values.data() + 6 * c;
    const int count = this->Conductivity.components(this->Entry[c]);
    const std::span<double> weights = batch.weightsOf(c);
    if (count == 1)
    {
      // As conductivityWeights() of a multiple of the identity, without computing the weights
      // again.
      std::ranges::for_each(weights, [&](double& weight) { weight *= numbers[0]; });
    }
    else
    {
      const std::array<double, 6> tensor = tensorOf(numbers, count);
      std::array<const double*, 4> points{};
      for (int k = 0; k < corners; ++k)
      {
        points[static_cast<std::size_t>(k)] = batch.point(c, k);
      }
      const CellWeights own = conductivityWeights(batch.type, points.data(), tensor.data());
      std::copy_n(own.weight, weights.size(), weights.begin());
    }
    if (!batch.conductivity.empty())
    {
      std::ranges::copy(
        tensorOf(numbers, count), batch.conductivity.begin() + static_cast<std::ptrdiff_t>(6 * c));
    }
  }
}

void ProblemOnMesh::setField(const CellRange& cells, CellBatch& batch)
{
  if (!this->Field.isGiven())
  {
    return;
  }
  const std::size_t numbers = 3 * this->Columns;
  // There is one entry, everywhere.
  this->Entry.assign(batch.cells(), 0);
  this->Field.valuesAtCells(cells, this->Entry, batch.field.data(), numbers);
  if (this->Field.components(0) == 3)
  {
    // One vector for all columns.
    for (std::size_t c = 0; c < batch.cells(); ++c)
    {
      double* vectors = batch.field.data() + c * numbers;
      for (std::size_t k = 3; k < numbers; ++k)
      {
        vectors[k] = vectors[k - 3];
      }
    }
  }
}

void ProblemOnMesh::facets(FacetBatch& batch)
{
  const CellRange cells{ batch.block, batch.first, batch.corners };
  this->Flux.entriesAtFacets(cells, batch.flux);
  this->Flux.valuesAtFacets(cells, batch.flux, batch.fluxValue.data(), this->Columns);
  this->setRobin(cells, batch);
}

void ProblemOnMesh::setRobin(const CellRange& cells, FacetBatch& batch)
{
  this->Ambient.entriesAtFacets(cells, batch.robin);
  this->Ambient.valuesAtFacets(cells, batch.robin, batch.ambient.data(), this->Columns);
  for (std::size_t k = 0; k < this->Coefficients.size(); ++k)
  {
    this->Entry.assign(batch.robin.size(), -1);
    this->Coefficients[k].entriesAtFacets(cells, this->Entry);
    for (std::size_t facet = 0; facet < batch.robin.size(); ++facet)
    {
      // Each condition has its own coefficient: take the one of the condition that applies here.
      const bool holds = batch.robin[facet] == static_cast<std::int32_t>(k);
      this->Entry[facet] = holds ? this->Entry[facet] : -1;
    }
    this->Coefficients[k].valuesAtFacets(cells, this->Entry, batch.coefficient.data(), 1);
  }
}

} // namespace smg
