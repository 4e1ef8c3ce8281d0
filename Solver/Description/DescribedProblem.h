// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/DatumOnMesh.h"
#include "Solver/Description/ProblemDescription.h"
#include "Solver/Problem/Problem.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * The problem of a description on a mesh stream.
 *
 *     DescribedProblem problem(description, mesh.info());
 *     problem.prepare(*mesh.source(problem.vertexColumns(), problem.cellColumns()));
 *     solve(*mesh.source(problem.vertexColumns(), problem.cellColumns()), problem);
 *
 * Vertices are identified by the column OriginalId, or by their stream index if the mesh has no
 * such column. The values of columns and the selections are held in memory only at vertices that a
 * later cell may use. The stream may be read repeatedly, from its first block.
 */
class DescribedProblem : public Problem
{
public:
  /**
   * `mesh` is the mesh of the problem; `name` is the name of the description in error messages: its
   * file. Throws Error, which names the place in the description, if a value is out of range or the
   * mesh lacks a column.
   */
  DescribedProblem(const ProblemDescription& description, const StreamInfo& mesh,
    const std::string& name = "problem");
  DescribedProblem(const DescribedProblem&) = delete;
  DescribedProblem& operator=(const DescribedProblem&) = delete;

  /** The columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const { return this->OfMesh.vertexColumns(); }
  std::vector<std::string> cellColumns() const { return this->OfMesh.cellColumns(); }

  /**
   * Reads the stream once if the description selects parts of the mesh. Throws Error, which names
   * the place in the description, if such a part is empty or refers to a vertex that the mesh
   * lacks. May be omitted unless vertices are selected by a column of the cells or as nearest
   * vertices, which is determined here. An unnamed scratch file, with one bit per vertex for each
   * such column, is created in `scratch`; empty: the system's temporary folder.
   */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch = {});

  int columns() const override { return static_cast<int>(this->Columns); }
  Weights weights() const override { return this->EdgeWeights; }
  ConditionCounts conditionCounts() const override;
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasCells() const override;
  void cells(CellBatch& batch) override;
  bool hasFacets() const override { return this->Flux.isGiven() || this->Ambient.isGiven(); }
  void facets(FacetBatch& batch) override;

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
