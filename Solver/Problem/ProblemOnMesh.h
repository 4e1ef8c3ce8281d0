// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/DatumOnMesh.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

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
    DatumOnMesh value, weight;
  };

  /** The place of a density: the vertices, unless an entry names a column of the cells. */
  DataPlace placeOf(const Datum& density) const;
  void addRobin(const ProblemDescription& description);
  void addSoft(const ProblemDescription& description);
  /** All data. */
  std::vector<DatumOnMesh*> data();

  void setValues(const MeshBlock& block, VertexConditions& conditions);
  void addSoft(const MeshBlock& block, VertexConditions& conditions);
  void setConductivity(const CellRange& cells, CellBatch& batch);
  void setField(const CellRange& cells, CellBatch& batch);
  void setRobin(const CellRange& cells, FacetBatch& batch);
  /** Evaluates a density at the vertices of a block, or in cells. */
  void setDensity(const DatumOnMesh& datum, const MeshBlock& block, std::vector<double>& density);
  void setDensity(const DatumOnMesh& datum, const CellRange& cells, std::span<double> density);

  MeshColumns OfMesh;
  std::size_t Columns;
  Weights EdgeWeights;
  bool StartsAtPosition;
  DataPlace ScreeningPlace, SourcePlace;
  DatumOnMesh Conductivity, Screening, Source, Field, Initial, Dirichlet, Flux;
  DatumOnMesh Ambient;                   ///< of the Robin conditions
  std::vector<DatumOnMesh> Coefficients; ///< of each of them
  std::vector<Soft> Softs;
  std::vector<std::int32_t> Entry,
    Other;                    ///< applicable entries at vertices, in cells, or on facets
  std::vector<double> Values; ///< their values
};

} // namespace smg
