// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"
#include "ProgressBar.h"
#include "VtkBridge.h"

#include "IO/Conversion/AddedColumn.h"
#include "IO/Conversion/MeshFile.h"
#include "IO/Conversion/OpenMesh.h"
#include "IO/Conversion/PartialProgress.h"
#include "IO/Conversion/WriteVsm.h"
#include "IO/Conversion/WriteVtkXml.h"
#include "IO/Problem/RegionProblem.h"
#include "Solver/Core/Error.h"
#include "Solver/Solve.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace
{

constexpr const char* SolutionName = "Solution";

std::vector<std::string> namesWithoutSolution(const std::vector<smg::ColumnSpec>& specs)
{
  std::vector<std::string> names;
  for (const smg::ColumnSpec& spec : specs)
  {
    if (spec.name != SolutionName)
    {
      names.push_back(spec.name);
    }
  }
  return names;
}

struct SolveCommandOptions : CommonOptions
{
  std::filesystem::path in, out, problem;
  smg::SolveOptions solve;

  void run() const;

private:
  void checkOutput() const;
  std::unique_ptr<smg::OpenedMesh> open(smg::ProgressFunction progress) const;
  std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& reader, smg::ProgressFunction progress) const;
  void write(const smg::VsmReader& reader, smg::Solution& solution,
    const smg::ProgressFunction& progress) const;
  void print(const smg::Report& report) const;
};

/** What can be known to fail is refused before the work, not after it. */
void SolveCommandOptions::checkOutput() const
{
  const smg::MeshFileKind kind = smg::kindOfOutput(this->out);
  if (kind != smg::MeshFileKind::Vsm && kind != smg::MeshFileKind::VtkXml)
  {
    throw smg::Error(this->out.string() +
                     ": a solution is written as .vsm, .vtp or .vtu: choose a name that ends "
                     "so.");
  }
  const std::filesystem::path folder = this->out.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
  {
    throw smg::Error(this->out.string() + ": there is no folder " + folder.string() + '.');
  }
}

std::unique_ptr<smg::OpenedMesh> SolveCommandOptions::open(smg::ProgressFunction progress) const
{
  loadVtkFor(this->in);
  smg::ConversionOptions options;
  options.memoryLimit = this->memoryBytes(0);
  options.codec = smg::Codec::Lz4;
  options.scratch = this->scratch;
  options.progress = std::move(progress);
  return smg::openMesh(this->in, options);
}

std::unique_ptr<smg::Solution> SolveCommandOptions::solveOn(
  const smg::VsmReader& reader, smg::ProgressFunction progress) const
{
  const smg::StreamInfo& info = reader.info();
  if (smg::kindOfOutput(this->out) == smg::MeshFileKind::VtkXml)
  {
    smg::checkVtkXmlPath(this->out, info.cellType);
  }
  const std::unique_ptr<smg::RegionProblem> problem = smg::readProblemFile(this->problem, info);
  problem->check(*reader.source(problem->vertexColumns(), {}));

  const std::unique_ptr<smg::MeshSource> source = reader.source(problem->vertexColumns(), {});
  smg::SolveOptions options = this->solve;
  options.memoryLimit = this->memoryBytes(options.memoryLimit);
  options.threads = this->threads;
  options.scratch = this->scratch;
  options.progress = std::move(progress);
  return smg::solve(*source, *problem, options);
}

/** Writes the mesh with all its columns and the solution, block by block. */
void SolveCommandOptions::write(const smg::VsmReader& reader, smg::Solution& solution,
  const smg::ProgressFunction& progress) const
{
  const smg::ColumnSpec spec{ SolutionName, smg::ScalarType::Float64, solution.columns() };
  smg::AddedColumn source(reader.source(namesWithoutSolution(reader.info().vertexColumns),
                            namesWithoutSolution(reader.info().cellColumns)),
    smg::AddedColumn::Vertices, spec,
    [&solution](const smg::MeshBlock& block, smg::Column& column)
    { solution.read(block.firstVertex, block.vertices(), column.as<double>()); });
  if (smg::kindOfOutput(this->out) == smg::MeshFileKind::Vsm)
  {
    smg::writeVsm(source, this->out, smg::Codec::Zstd, progress);
  }
  else
  {
    smg::writeVtkXml(source, this->out, progress);
  }
}

void SolveCommandOptions::print(const smg::Report& report) const
{
  const double residual = report.residual();
  if (!report.converged)
  {
    std::fprintf(stderr,
      "smg: warning: not converged: the relative residual is %.3g after %d V-cycles, the tolerance "
      "%.3g\n",
      residual, report.cycles, this->solve.tolerance);
  }
  if (this->quiet)
  {
    return;
  }
  std::printf("%lld vertices, %lld cells, %zu levels, %d V-cycles in %d passes, relative residual "
              "%.3g\n",
    static_cast<long long>(report.vertices), static_cast<long long>(report.cells),
    report.levels.size(), report.cycles, report.passes, residual);
  std::printf("%.2f s (%.2f s of CPU), %.1f MiB of accounted memory, %.1f MiB resident\n",
    report.seconds.total, report.cpu_seconds,
    static_cast<double>(report.pool_bytes_peak) / (1 << 20),
    static_cast<double>(report.rss_bytes_peak) / (1 << 20));
  for (const std::string& note : report.notes)
  {
    std::printf("%s\n", note.c_str());
  }
}

void SolveCommandOptions::run() const
{
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSince = [](std::chrono::steady_clock::time_point then)
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count(); };
  this->checkOutput();
  this->checkReport();
  smg::Report report;
  {
    ProgressBar bar("solving", this->quiet);
    const std::unique_ptr<smg::OpenedMesh> mesh = this->open(smg::partOf(bar.function(), 0.0, 0.2));
    const double convertSeconds = mesh->conversion() ? secondsSince(start) : 0.0;
    const double begin = mesh->conversion() ? 0.2 : 0.0;
    const std::unique_ptr<smg::Solution> solution =
      this->solveOn(mesh->reader(), smg::partOf(bar.function(), begin, 0.9));
    this->write(mesh->reader(), *solution, smg::partOf(bar.function(), 0.9, 1.0));
    report = solution->report();
    report.seconds.convert = convertSeconds;
    report.seconds.total = secondsSince(start);
  }
  this->writeReport(report.json());
  this->print(report);
}

/** CLI::Range includes its ends and takes nan. */
std::string checkTolerance(const std::string& text)
{
  char* end = nullptr;
  const double tolerance = std::strtod(text.c_str(), &end);
  const bool isNumber = !text.empty() && *end == '\0';
  return isNumber && tolerance > 0.0 && tolerance < 1.0
           ? std::string()
           : '\'' + text + "' is no number between 0 and 1, both excluded";
}

} // namespace

void addSolveCommand(CLI::App& program, Action& action)
{
  auto options = std::make_shared<SolveCommandOptions>();
  smg::SolveOptions& solve = options->solve;
  CLI::App* command = program.add_subcommand("solve", "Solve a Poisson problem on a mesh");
  command->add_option("IN", options->in, "The mesh, best as a .vsm file")->required();
  command->add_option("OUT", options->out, "The mesh with its solution: .vsm, .vtp or .vtu")
    ->required();
  command->add_option("--problem", options->problem, "The problem, a JSON file")
    ->required()
    ->type_name("FILE");
  command->add_option("--operators", solve.operators, "Operator set")
    ->check(oneOf({ "extended" }))
    ->capture_default_str();
  command->add_option("--sweeps", solve.sweeps, "Gauss-Seidel sweeps before and after a correction")
    ->check(CLI::Range(1, 20))
    ->capture_default_str();
  command
    ->add_option("--tolerance", solve.tolerance, "Relative residual to stop at, between 0 and 1")
    ->check(checkTolerance)
    ->capture_default_str();
  command->add_option("--max-cycles", solve.maxCycles, "Most V-cycles")
    ->check(CLI::Range(1, 1000000))
    ->capture_default_str();
  command->add_flag(
    "--in-core", solve.inCore, "Keep everything in memory and use no scratch files");
  // For experiments and tests: they change the speed, not the result.
  command->add_option("--block-nodes", solve.blockNodes)->group("");
  command->add_option("--core-nodes", solve.coreNodes)->group("");
  options->addTo(*command);
  command->callback([options, &action] { action = [options] { options->run(); }; });
}
