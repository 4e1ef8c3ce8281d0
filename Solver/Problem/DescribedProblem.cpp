// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedProblem.h"
#include "Solver/Core/Text.h"
#include "Solver/Problem/CouplingSearch.h"
#include "Solver/Problem/IntegratedParts.h"
#include "Solver/Problem/ProblemData.h"
#include "smg/Error.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

// A ProblemDescription on its mesh, as a Problem of the solver: every datum of the table
// ProblemData is a PiecewiseCoefficient at vertices, in cells or on facets, evaluated block by
// block. Values depend on the place in the mesh alone, not on blocks or batches; memory is kept for
// open vertices only.

namespace smg
{
namespace
{

bool prescribesPosition(const ProblemDescription& description)
{
  return std::ranges::any_of(
    description.dirichlet, [](const PlacedValue& entry) { return entry.value.isPosition(); });
}

/**
 * Where the iteration begins if the description does not say: at the undeformed mesh if a Dirichlet
 * value is the position; in each column in the middle of the prescribed and ambient numbers if it
 * is farther from 0 than they are from each other (temperatures in kelvin), which saves the
 * V-cycles that find a constant; else at 0, which is the mean of components without a condition.
 */
class StartValues
{
public:
  StartValues() = default;
  /** For a description whose numbers have been checked. */
  explicit StartValues(const ProblemDescription& description);

  /** Sets the values of the vertices of the block, which are 0. */
  void set(const MeshBlock& block, std::vector<double>& values) const;

private:
  bool IsPosition = false;
  std::vector<double> Start; ///< of each column
};

StartValues::StartValues(const ProblemDescription& description)
  : Start(static_cast<std::size_t>(description.columns), 0.0)
{
  if (description.initial.isGiven())
  {
    return;
  }
  this->IsPosition = prescribesPosition(description);
  std::vector<const DataValue*> all;
  for (const PlacedValue& entry : description.dirichlet)
  {
    all.push_back(&entry.value);
  }
  for (const ProblemDescription::Robin& robin : description.robin)
  {
    all.push_back(&robin.ambient);
  }
  const bool isKnown =
    std::ranges::all_of(all, [](const DataValue* value) { return value->numbers() != nullptr; });
  for (std::size_t k = 0; isKnown && !all.empty() && k < this->Start.size(); ++k)
  {
    const auto numberOf = [k](const DataValue* value) { return (*value->numbers())[k]; };
    const auto [least, most] = std::ranges::minmax(all, {}, numberOf);
    const double min = numberOf(least), max = numberOf(most);
    const double middle = min / 2 + max / 2;
    this->Start[k] = max - min < std::fabs(middle) ? middle : 0.0;
  }
}

void StartValues::set(const MeshBlock& block, std::vector<double>& values) const
{
  if (this->IsPosition)
  {
    values = block.positions;
    return;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = this->Start[i % this->Start.size()];
  }
}

/** A datum with its entries on the mesh. */
struct DatumOnMesh
{
  PiecewiseCoefficient value;
  std::vector<PiecewiseCoefficient> coefficients; ///< of conditions: one of each entry, or none
  std::vector<std::string> groups = {};           ///< of each entry: see ConditionCounts
};

/** Which of the entries hold on facets: on the boundary, or between two cells. */
using EntriesOnFacets = void (PiecewiseCoefficient::*)(
  const CellRange& cells, std::span<std::int32_t> entry) const;

std::string keyOf(const char* list, std::size_t k)
{
  return std::string(list) + '[' + std::to_string(k) + ']';
}

} // namespace

/** The data of a description, resolved on a mesh. */
struct DescribedProblem::OnMesh
{
  OnMesh(const ProblemDescription& description, const StreamInfo& mesh, const std::string& name);

  /** The place of a density: the vertices, unless an entry names a column of the cells. */
  DataPlace placeOf(const DatumRow& row, const ProblemDescription& description) const;
  void add(const DatumRow& row, const ProblemDescription& description);
  void add(const ColumnRow& row, const ProblemDescription& description);
  template <class Condition>
  void add(const ConditionRow<Condition>& row, const ProblemDescription& description);
  void endPreparing(MeshParts* parts)
  {
    // Couplings take of the limited memory, too.
    this->selections.endPreparing(parts);
    this->couplings.end(parts);
  }
  /** Adds a datum without entries. */
  DatumOnMesh& add(DataPlace place, const ValueRules& rules);

  const DatumOnMesh& operator[](std::size_t row) const { return this->data[row]; }
  const PiecewiseCoefficient& valueOf(std::size_t row) const { return this->data[row].value; }
  /** Calls visit(density, datum) with the densities that are given at such a place. */
  void forDensities(DataPlace place, auto visit) const;

  void setValues(const MeshBlock& block, VertexConditions& conditions);
  void addSoft(const MeshBlock& block, VertexConditions& conditions);
  void setConductivity(const CellRange& cells, CellBatch& batch);
  void setField(const CellRange& cells, CellBatch& batch);
  /** Sets the conditions on facets to entries that `entriesOn` finds. */
  void setFacets(FacetBatch& batch, EntriesOnFacets entriesOn);

  MeshColumns mesh;
  Selections selections;
  CouplingSearch couplings;
  std::size_t columns;
  Weights weights;
  std::vector<DatumOnMesh> data; ///< in the order of ProblemData
  StartValues start;
  bool isPosition = false; ///< a Dirichlet value
  std::vector<std::int32_t> entry,
    other;                    ///< applicable entries at vertices, in cells, or on facets
  std::vector<double> values; ///< their values
};

DescribedProblem::OnMesh::OnMesh(
  const ProblemDescription& description, const StreamInfo& info, const std::string& name)
  : mesh(info, name)
  , selections(this->mesh)
  , couplings(description, this->mesh, this->selections)
  , columns(static_cast<std::size_t>(description.columns))
  , weights(description.weights)
{
  constexpr int MaxColumns = ProblemDescription::MaxColumns;
  if (description.columns < 1 || description.columns > MaxColumns)
  {
    this->mesh.fail("columns", "must be from 1 to " + std::to_string(MaxColumns));
  }
  if (description.conductivity.isGiven() && this->weights == Weights::Uniform)
  {
    this->mesh.fail("conductivity", "goes with cotangent and clamped weights only");
  }
  forProblemData([&](const auto& row) { this->add(row, description); });
  // Only to be checked early: the results read the groups.
  const IntegratedParts integrated(description.integrals, this->mesh.groups(),
    [this](const std::string& key, const std::string& sentence)
    { this->mesh.fail(key, sentence); });
  if (!integrated.names.empty() && this->mesh.hasGroupColumn(GroupOf::Cells))
  {
    this->mesh.requireGroups(GroupOf::Cells);
  }
  this->start = StartValues(description);
  this->isPosition = prescribesPosition(description);
}

DataPlace DescribedProblem::OnMesh::placeOf(
  const DatumRow& row, const ProblemDescription& description) const
{
  const bool inCells =
    row.density && std::ranges::any_of((description.*row.member).entries,
                     [&](const PlacedValue& entry)
                     {
                       const std::string* const column = entry.value.column();
                       return isOfCells(entry.where, this->mesh) ||
                              (column && this->mesh.isOfCells(
                                           *column, ownerOf(entry.value, ColumnOwner::Vertices)));
                     });
  return inCells ? DataPlace::Cells : row.place;
}

DatumOnMesh& DescribedProblem::OnMesh::add(DataPlace place, const ValueRules& rules)
{
  return this->data.emplace_back(
    DatumOnMesh{ PiecewiseCoefficient(this->mesh, this->selections, place, rules), {} });
}

void DescribedProblem::OnMesh::add(const DatumRow& row, const ProblemDescription& description)
{
  DatumOnMesh& datum = this->add(this->placeOf(row, description), row.rules(description.columns));
  datum.value.add(description.*row.member, row.key);
  for (const PlacedValue& entry : (description.*row.member).entries)
  {
    datum.groups.push_back(groupNames(entry.where));
  }
}

void DescribedProblem::OnMesh::add(const ColumnRow& row, const ProblemDescription& description)
{
  DatumOnMesh& datum = this->add(row.place, row.rules(description.columns));
  if (const std::string& column = description.*row.member; !column.empty())
  {
    datum.value.add(Everywhere{}, column, row.key, row.key);
  }
}

/** The values decide which condition holds where; each condition has a coefficient of its own. */
template <class Condition>
void DescribedProblem::OnMesh::add(
  const ConditionRow<Condition>& row, const ProblemDescription& description)
{
  DatumOnMesh& datum = this->add(row.place, row.rules(description.columns));
  const std::vector<Condition>& conditions = description.*row.member;
  for (std::size_t k = 0; k < conditions.size(); ++k)
  {
    const std::string key = keyOf(row.key, k);
    datum.value.add(conditions[k].where, conditions[k].*row.value, key, key + '.' + row.valueKey);
    datum.groups.push_back(groupNames(conditions[k].where));
    if (row.coefficient)
    {
      datum.coefficients
        .emplace_back(
          this->mesh, this->selections, row.place, coefficientRules(description.columns))
        .add(conditions[k].*row.coefficient, key + '.' + row.coefficientKey);
    }
  }
}

void DescribedProblem::OnMesh::forDensities(DataPlace place, auto visit) const
{
  std::size_t at = 0;
  forProblemData(
    [&](const auto& row)
    {
      const PiecewiseCoefficient& datum = this->valueOf(at++);
      if constexpr (requires { row.density; })
      {
        if (row.density && datum.isGiven() && datum.place() == place)
        {
          visit(*row.density, datum);
        }
      }
    });
}

DescribedProblem::DescribedProblem(
  const ProblemDescription& description, const StreamInfo& mesh, const std::string& name)
  : Data(std::make_unique<OnMesh>(description, mesh, name))
{
  if (DescribedProblem::hasCells() || DescribedProblem::hasFacets())
  {
    this->Data->mesh.requireCellIds(); // for error messages of the solver
  }
}

DescribedProblem::~DescribedProblem() = default;

std::vector<std::string> DescribedProblem::vertexColumns() const
{
  return this->Data->mesh.vertexColumns();
}

std::vector<std::string> DescribedProblem::cellColumns() const
{
  return this->Data->mesh.cellColumns();
}

void DescribedProblem::prepare(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->preparePart(mesh, scratch, memoryLimit);
  this->Data->endPreparing(nullptr);
}

void DescribedProblem::acceptEmpty()
{
  this->Data->selections.acceptEmpty();
  this->Data->couplings.acceptEmpty();
}

/** Without parts of the mesh there is nothing to prepare. The reading also checks that no part is
 * empty. */
void DescribedProblem::preparePart(
  MeshSource& part, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->Data->selections.prepare(part, scratch, memoryLimit,
    [this](const MeshBlock& block) { this->Data->couplings.add(block); });
}

void DescribedProblem::endPreparing(MeshParts& parts)
{
  this->Data->endPreparing(&parts);
}

std::int64_t DescribedProblem::bytes() const
{
  return this->Data->mesh.memory().used();
}

std::shared_ptr<const VertexCouplings> DescribedProblem::couplings() const
{
  return this->Data->couplings.couplings();
}

int DescribedProblem::columns() const
{
  return static_cast<int>(this->Data->columns);
}

int DescribedProblem::vectorSize() const
{
  return this->Data->isPosition ? this->columns() : 1;
}

Weights DescribedProblem::weights() const
{
  return this->Data->weights;
}

ConditionCounts DescribedProblem::conditionCounts() const
{
  const OnMesh& data = *this->Data;
  ConditionCounts counts{ data.valueOf(rowOf("dirichlet")).entries(),
    data.valueOf(rowOf("flux")).entries(), data.valueOf(rowOf("robin")).entries(),
    data.valueOf(rowOf("conductivity")).entries() };
  for (const std::size_t row :
    { rowOf("dirichlet"), rowOf("flux"), rowOf("robin"), rowOf("conductivity") })
  {
    const std::vector<std::string>& groups = data[row].groups;
    counts.groups.insert(counts.groups.end(), groups.begin(), groups.end());
  }
  return counts;
}

bool DescribedProblem::hasCells() const
{
  bool any = this->Data->valueOf(rowOf("conductivity")).isGiven() ||
             this->Data->valueOf(rowOf("field")).isGiven();
  this->Data->forDensities(DataPlace::Cells, [&](const auto&, const auto&) { any = true; });
  return any;
}

bool DescribedProblem::hasFacets() const
{
  return this->Data->valueOf(rowOf("flux")).isGiven() ||
         this->Data->valueOf(rowOf("robin")).isGiven();
}

// Evaluation on a block of the mesh.

void DescribedProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  OnMesh& data = *this->Data;
  if (data.selections.needPreparing() || (data.couplings.any() && !data.couplings.couplings()))
  {
    throw Error(
      "Nearest vertices, the vertices of cells, the boundary and coupled vertices are found by a "
      "previous reading of the mesh: call DescribedProblem::prepare().");
  }
  data.selections.startBlock(block);
  for (DatumOnMesh& datum : data.data)
  {
    // All of them: cells() and facets() of this block follow.
    datum.value.startBlock(block);
    std::ranges::for_each(
      datum.coefficients, [&](PiecewiseCoefficient& c) { c.startBlock(block); });
  }
  data.setValues(block, conditions);
  const auto vertices = static_cast<std::size_t>(block.vertices());
  data.forDensities(DataPlace::Vertices,
    [&](const Density& density, const PiecewiseCoefficient& datum)
    {
      std::vector<double>& numbers = conditions.*density.atVertices;
      data.entry.assign(vertices, -1);
      datum.entriesAtVertices(data.entry);
      datum.valuesAtVertices(
        block, data.entry, numbers.data(), vertices == 0 ? 0 : numbers.size() / vertices);
    });
  data.addSoft(block, conditions);
}

void DescribedProblem::OnMesh::setValues(const MeshBlock& block, VertexConditions& conditions)
{
  const PiecewiseCoefficient& dirichlet = this->valueOf(rowOf("dirichlet"));
  const PiecewiseCoefficient& initial = this->valueOf(rowOf("initial"));
  this->start.set(block, conditions.value);
  dirichlet.entriesAtVertices(conditions.dirichlet);
  this->entry.assign(conditions.dirichlet.size(), -1);
  initial.entriesAtVertices(this->entry);
  // Initial values at prescribed vertices are not used: they may be anything, also NaN.
  for (std::size_t i = 0; i < this->entry.size(); ++i)
  {
    this->entry[i] = conditions.dirichlet[i] >= 0 ? -1 : this->entry[i];
  }
  initial.valuesAtVertices(block, this->entry, conditions.value.data(), this->columns);
  // A missing initial value is 0, as if none were given.
  std::ranges::replace_if(
    conditions.value, [](double value) { return std::isnan(value); }, 0.0);
  dirichlet.valuesAtVertices(block, conditions.dirichlet, conditions.value.data(), this->columns);
}

/** Soft constraints add up: each is evaluated by itself. */
void DescribedProblem::OnMesh::addSoft(const MeshBlock& block, VertexConditions& conditions)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  const DatumOnMesh& soft = (*this)[rowOf("soft")];
  std::vector<double> weight;
  for (std::int32_t e = 0; e < soft.value.entries(); ++e)
  {
    const PiecewiseCoefficient& weights = soft.coefficients[static_cast<std::size_t>(e)];
    this->entry.assign(vertices, -1);
    soft.value.entryAtVertices(e, this->entry);
    this->values.resize(vertices * this->columns);
    soft.value.valuesAtVertices(block, this->entry, this->values.data(), this->columns);
    this->other.assign(vertices, -1);
    weights.entriesAtVertices(this->other);
    for (std::size_t i = 0; i < vertices; ++i)
    {
      // A weight counts only where its constraint holds.
      this->other[i] = this->entry[i] >= 0 ? this->other[i] : -1;
    }
    // Where no weight is given, it is 0.
    weight.assign(vertices, 0.0);
    weights.valuesAtVertices(block, this->other, weight.data(), 1);
    for (std::size_t i = 0; i < vertices; ++i)
    {
      // weight * (u - value) is a screening and a source.
      conditions.screening[i] += weight[i];
      for (std::size_t k = i * this->columns; this->other[i] >= 0 && k < (i + 1) * this->columns;
           ++k)
      {
        conditions.source[k] += weight[i] * this->values[k];
      }
    }
  }
}

void DescribedProblem::cells(CellBatch& batch)
{
  OnMesh& data = *this->Data;
  const CellRange cells{ batch.block, batch.first, batch.corners };
  data.setConductivity(cells, batch);
  data.setField(cells, batch);
  data.forDensities(DataPlace::Cells,
    [&](const Density& density, const PiecewiseCoefficient& datum)
    {
      const std::span<double> numbers = batch.*density.inCells;
      data.entry.assign(batch.cells(), -1);
      datum.entriesAtCells(cells, data.entry);
      datum.valuesAtCells(cells, data.entry, numbers.data(), numbers.size() / batch.cells());
    });
}

/** A number scales the weights of the cell, a tensor takes new ones. */
void DescribedProblem::OnMesh::setConductivity(const CellRange& cells, CellBatch& batch)
{
  const PiecewiseCoefficient& conductivity = this->valueOf(rowOf("conductivity"));
  if (!conductivity.isGiven())
  {
    return;
  }
  this->entry.assign(batch.cells(), -1);
  conductivity.entriesAtCells(cells, this->entry);
  this->values.resize(6 * batch.cells());
  conductivity.valuesAtCells(cells, this->entry, this->values.data(), 6);
  const auto corners = cornersOf(batch.type);
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    batch.part[c] = this->entry[c];
    if (this->entry[c] < 0)
    {
      continue;
    }
    const double* numbers = this->values.data() + 6 * c;
    const int count = conductivity.components(this->entry[c]);
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

void DescribedProblem::OnMesh::setField(const CellRange& cells, CellBatch& batch)
{
  const PiecewiseCoefficient& field = this->valueOf(rowOf("field"));
  if (!field.isGiven())
  {
    return;
  }
  const std::size_t numbers = 3 * this->columns;
  // There is one entry, everywhere.
  this->entry.assign(batch.cells(), 0);
  field.valuesAtCells(cells, this->entry, batch.field.data(), numbers);
  if (field.components(0) == 3)
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

void DescribedProblem::facets(FacetBatch& batch)
{
  this->Data->setFacets(batch, &PiecewiseCoefficient::entriesAtFacets);
}

bool DescribedProblem::hasInnerFacets() const
{
  return DescribedProblem::hasFacets() && this->Data->mesh.hasGroupColumn(GroupOf::Facets);
}

void DescribedProblem::innerFacets(FacetBatch& batch)
{
  this->Data->setFacets(batch, &PiecewiseCoefficient::entriesAtInnerFacets);
}

void DescribedProblem::OnMesh::setFacets(FacetBatch& batch, EntriesOnFacets entriesOn)
{
  const CellRange cells{ batch.block, batch.first, batch.corners };
  const PiecewiseCoefficient& flux = this->valueOf(rowOf("flux"));
  (flux.*entriesOn)(cells, batch.flux);
  flux.valuesAtFacets(cells, batch.flux, batch.fluxValue.data(), this->columns);
  const PiecewiseCoefficient& ambient = this->valueOf(rowOf("robin"));
  const std::vector<PiecewiseCoefficient>& coefficients = (*this)[rowOf("robin")].coefficients;
  (ambient.*entriesOn)(cells, batch.robin);
  ambient.valuesAtFacets(cells, batch.robin, batch.ambient.data(), this->columns);
  for (std::size_t k = 0; k < coefficients.size(); ++k)
  {
    this->entry.assign(batch.robin.size(), -1);
    coefficients[k].entriesAtFacets(cells, this->entry);
    for (std::size_t facet = 0; facet < batch.robin.size(); ++facet)
    {
      // Each condition has its own coefficient: take the one of the condition that applies here.
      const bool holds = batch.robin[facet] == static_cast<std::int32_t>(k);
      this->entry[facet] = holds ? this->entry[facet] : -1;
    }
    coefficients[k].valuesAtFacets(cells, this->entry, batch.coefficient.data(), 1);
  }
}

} // namespace smg
