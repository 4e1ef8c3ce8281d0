// SPDX-License-Identifier: BSD-3-Clause
#include "smg/SolvedMesh.h"

#include "IO/Mesh/Columns.h"
#include "IO/Results/SourcePrefetch.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "smg/DescribedProblem.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

bool isOfSolve(const std::string& name)
{
  return name == SolutionName || name == GradientName || name == FluxName;
}

void append(
  const char* name, int components, std::span<const double> values, std::vector<Column>& columns)
{
  Column column{ { name, ScalarType::Float64, components }, {} };
  const std::span<const std::byte> bytes = std::as_bytes(values);
  column.bytes.assign(bytes.begin(), bytes.end());
  columns.push_back(std::move(column));
}

/** The stream with all columns. */
std::unique_ptr<MeshSource> wholeSource(const StoredMesh& mesh)
{
  return mesh.source(columnNames(mesh.info().vertexColumns), columnNames(mesh.info().cellColumns));
}

/** The gradients at the vertices, which follow from cells that come later: from a reading of the
 * mesh before the one that passes them on, in a scratch file. */
class VertexGradientFile final : public Solution
{
public:
  VertexGradientFile(
    const StoredMesh& mesh, Problem& problem, Solution& solution, const ResultOptions& options)
    : Memory(options.memoryLimit)
    , Folder(options.scratch)
    , File({ this->Memory, &this->Folder, this->Traffic }, 3 * problem.columns())
  {
    const auto source = std::make_unique<SourcePrefetch>(wholeSource(mesh), options.threads);
    ProblemResults results(
      source->info(), problem, solution, { .gradient = true, .memoryLimit = options.memoryLimit });
    results.appendVertexGradients(this->File);
    for (MeshBlock block; source->next(block);)
    {
      results.add(block);
    }
    Report unused;
    results.finish(unused);
  }

  std::int64_t vertices() const override { return this->File.vertices(); }
  int columns() const override { return this->File.lanes(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->File.read(first, count, values.data());
  }
  const Report& report() const override { return this->Empty; }

  /** Those of the vertices of a block. */
  std::vector<double> of(const MeshBlock& block)
  {
    std::vector<double> values(static_cast<std::size_t>(block.vertices() * this->columns()));
    this->read(block.firstVertex, block.vertices(), values);
    return values;
  }

private:
  Report Empty;
  Pool Memory;
  ScratchFolder Folder;
  IoStatistics Traffic;
  VertexFile File;
};

} // namespace

struct SolvedMesh::Implementation
{
  Implementation(
    const StoredMesh& mesh, Problem& problem, Solution& solution, const ResultOptions& options)
    : source(std::make_unique<SourcePrefetch>(wholeSource(mesh), options.threads))
    , results(source->info(), problem, solution, options)
    , wanted(options)
    , info(source->info())
    , file(mesh.file())
    , mesh(mesh)
    , problem(problem)
    , solution(solution)
  {
    if (solution.vertices() != this->info.vertices)
    {
      throw Error((this->file.empty() ? "the mesh" : this->file.string()) + " has " +
                  std::to_string(this->info.vertices) + " vertices, the solution " +
                  std::to_string(solution.vertices()) + ": it is that of another mesh.");
    }
    if (!this->file.empty() && findColumn(this->info.vertexColumns, OriginalIdSpec) >= 0)
    {
      this->numbers.emplace(this->file, nullptr, mesh.fileFingerprint());
    }
    const int columns = problem.columns();
    for (std::vector<ColumnSpec>* specs : { &this->info.vertexColumns, &this->info.cellColumns })
    {
      std::erase_if(*specs, [](const ColumnSpec& spec) { return isOfSolve(spec.name); });
    }
    constexpr double NoSolution = std::numeric_limits<double>::quiet_NaN();
    this->info.vertexColumns.push_back({ SolutionName, ScalarType::Float64, columns, NoSolution });
    if (options.gradientAtVertices)
    {
      this->info.vertexColumns.push_back(
        { GradientName, ScalarType::Float64, 3 * columns, NoSolution });
    }
    if (options.gradient)
    {
      this->info.cellColumns.push_back({ GradientName, ScalarType::Float64, 3 * columns });
    }
    if (options.flux)
    {
      this->info.cellColumns.push_back({ FluxName, ScalarType::Float64, 3 * columns });
    }
  }

  std::unique_ptr<MeshSource> source;
  ProblemResults results;
  ResultOptions wanted;
  StreamInfo info;
  std::filesystem::path file; ///< empty: the mesh is in none
  /** Opened before the result is written, so that no error follows it; none: there are no original
   * numbers in a file. */
  std::optional<VsmReader> numbers;
  std::vector<std::int64_t> numbersInMemory; ///< of a mesh in none, as far as it has been read
  bool ended = false;                        ///< the stream has been read to its end
  const StoredMesh& mesh;
  Problem& problem;
  Solution& solution;
  std::unique_ptr<VertexGradientFile> vertexGradients; ///< from the first block on, if wanted
};

SolvedMesh::SolvedMesh(
  const StoredMesh& mesh, Problem& problem, Solution& solution, const ResultOptions& options)
  : Self(std::make_unique<Implementation>(mesh, problem, solution, options))
{
}

SolvedMesh::~SolvedMesh() = default;

const StreamInfo& SolvedMesh::info() const
{
  return this->Self->info;
}

bool SolvedMesh::next(MeshBlock& block)
{
  if (this->Self->wanted.gradientAtVertices && !this->Self->vertexGradients)
  {
    this->Self->vertexGradients = std::make_unique<VertexGradientFile>(
      this->Self->mesh, this->Self->problem, this->Self->solution, this->Self->wanted);
  }
  if (!this->Self->source->next(block))
  {
    this->Self->ended = true;
    return false;
  }
  const std::ptrdiff_t ids = findColumn(block.vertexColumns, OriginalIdSpec);
  if (this->Self->file.empty() && ids >= 0)
  {
    const auto numbers = block.vertexColumns[static_cast<std::size_t>(ids)].as<std::int64_t>();
    std::ranges::copy(numbers, std::back_inserter(this->Self->numbersInMemory));
  }
  // The problem may use the columns of an earlier solve.
  this->Self->results.add(block);
  for (std::vector<Column>* columns : { &block.vertexColumns, &block.cellColumns })
  {
    std::erase_if(*columns, [](const Column& column) { return isOfSolve(column.spec.name); });
  }
  const int columns = this->Self->problem.columns();
  append(SolutionName, columns, this->Self->results.values(), block.vertexColumns);
  if (this->Self->vertexGradients)
  {
    append(GradientName, 3 * columns, this->Self->vertexGradients->of(block), block.vertexColumns);
  }
  if (this->Self->wanted.gradient)
  {
    append(GradientName, 3 * columns, this->Self->results.gradient(), block.cellColumns);
  }
  if (this->Self->wanted.flux)
  {
    append(FluxName, 3 * columns, this->Self->results.flux(), block.cellColumns);
  }
  return true;
}

std::unique_ptr<Solution> SolvedMesh::takeVertexGradients()
{
  return std::move(this->Self->vertexGradients);
}

void SolvedMesh::finish(Report& report)
{
  if (!this->Self->ended)
  {
    throw Error("the results of a solution are known when its mesh has been read to the end");
  }
  this->Self->results.finish(report);
  if (this->Self->numbers)
  {
    Column id;
    renumberExtremes(report,
      [&](std::int64_t vertex)
      {
        this->Self->numbers->readVertexColumn(OriginalIdName, vertex, 1, id);
        return id.as<std::int64_t>()[0];
      });
  }
  else if (!this->Self->numbersInMemory.empty())
  {
    renumberExtremes(report, [this](std::int64_t vertex)
      { return this->Self->numbersInMemory.at(static_cast<std::size_t>(vertex)); });
  }
}

Report write(const StoredMesh& mesh, const ProblemDescription& description, Solution& solution,
  const std::filesystem::path& path, const ResultOptions& results)
{
  DescribedProblem problem(description, mesh.info());
  problem.prepare(
    *mesh.source(problem.vertexColumns(), problem.cellColumns()), {}, results.memoryLimit);
  ResultOptions wanted = results;
  wanted.gradient = wanted.gradient || description.gradientOutput;
  wanted.flux = wanted.flux || description.fluxOutput;
  wanted.gradientAtVertices = wanted.gradientAtVertices || description.vertexGradientOutput;
  wanted.integrals.insert(
    wanted.integrals.end(), description.integrals.begin(), description.integrals.end());
  SolvedMesh solved(mesh, problem, solution, wanted);
  const auto notes = writeMesh(solved, path,
    { .isolatedFrom = mesh.file(),
      .isolatedFingerprint = mesh.fileFingerprint(),
      .threads = results.threads });
  Report report = solution.report();
  solved.finish(report);
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
  solution.removeCheckpoint();
  return report;
}

} // namespace smg
