// SPDX-License-Identifier: BSD-3-Clause
#include "Python/C/Field.h"

#include "IO/Arrays/ArgumentColumns.h"
#include "IO/Arrays/MergedValues.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Mesh/Columns.h"
#include "Python/C/Call.h"
#include "Python/C/JobText.h"
#include "Python/C/Options.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/WriteMesh.h"

#include <utility>

smg::StreamInfo smg_field::info() const
{
  return smg::withoutArguments(this->job->resultOn(this->stored().info()), this->added.get());
}

std::vector<std::string> smg_field::resultColumns() const
{
  const smg::StreamInfo& mesh = this->stored().info();
  const smg::AddedValues added = this->job->addedTo(mesh);
  std::vector<std::string> columns;
  for (const smg::ColumnSpec& column : added.ofVertices)
  {
    columns.push_back(column.name);
  }
  if (added.movesVertices)
  {
    columns.insert(columns.end(), { smg::PositionSpec.name, smg::NormalsName });
  }
  return columns;
}

void smg_field::pass(const smg::MeshJob::Reader& read, const smg::ProgressFunction& progress)
{
  smg::Report report = this->solution->report();
  // The job may need columns that its result does not have.
  const auto readResult = [&](smg::MeshSource& result, const smg::ProgressFunction& reading)
  {
    smg::WithoutArguments without(result, this->added.get());
    read(without, reading);
  };
  this->job->passResult(this->stored(), *this->solution, readResult, report, progress);
  if (const smg::ConversionReport* const conversion = this->shared->mesh().conversion())
  {
    report.seconds.convert = conversion->seconds.total;
    report.seconds.total += conversion->seconds.total;
  }
  this->Complete = std::move(report);
}

const smg::Report& smg_field::report(const smg::ProgressFunction& progress)
{
  if (!this->Complete)
  {
    this->pass([](smg::MeshSource& result, const smg::ProgressFunction& reading)
      { smg::visitBlocks(result, reading, 0.0, 1.0, [](const smg::MeshBlock&) {}); },
      progress);
  }
  return *this->Complete;
}

const std::filesystem::path& smg_field::file(const smg::ProgressFunction& progress)
{
  if (this->File.empty())
  {
    const smg::ConversionOptions& options = this->shared->options();
    auto scratch = std::make_shared<smg::ScratchFolder>(options.scratch, options.scratchLimit);
    const std::filesystem::path path = *scratch / "result.vsm";
    this->pass(
      [&](smg::MeshSource& result, const smg::ProgressFunction& writing)
      {
        smg::WriteMeshOptions write;
        write.codec = smg::Codec::Lz4;
        write.scratch = scratch->path();
        write.isolatedFrom = this->stored().file();
        write.isolatedFingerprint = this->stored().fileFingerprint();
        write.completeIsolated = smg::isolatedOf(this->added);
        write.threads = options.threads;
        write.progress = writing;
        smg::writeMesh(result, path, write);
      },
      progress);
    this->Scratch = std::move(scratch);
    this->File = path;
  }
  return this->File;
}

namespace smg
{

CompleteIsolated isolatedOf(const std::shared_ptr<const AddedColumns>& added)
{
  return added ? [added](std::int64_t first, IsolatedVertices& vertices)
  { added->completeIsolated(first, vertices); }
               : CompleteIsolated();
}

ResultFile resultFile(const SharedMesh& mesh, const std::shared_ptr<const AddedColumns>& added,
  const MeshJob* job, const char* path, const WritingOptions& writing, CompleteIsolated merged)
{
  ResultFile::Options options;
  options.in = mesh.name();
  options.state = mesh.state();
  options.out = path;
  options.scratch = writing.limits.scratch;
  options.welds = mesh.options().weld.has_value();
  options.threads = writing.limits.threads;
  options.text = writing.text;
  // Only a job can move the vertices of the file itself.
  options.adds = added || !job || mesh.isResult();
  options.isolated = isolatedOf(added);
  options.merged = std::move(merged);
  if (!mesh.name().empty())
  {
    checkIsNotInput(mesh.name(), options.out);
  }
  ResultFile file = job ? ResultFile(*job, std::move(options)) : ResultFile(std::move(options));
  return file;
}

namespace
{

void run(const smg_mesh& mesh, const char* job, const char* description,
  const ProgressFunction& progress, smg_field*& field)
{
  auto made = std::make_unique<smg_field>();
  made->shared = mesh.shared;
  made->added = mesh.added;
  made->job = jobOf(job, description, limitsOf(mesh.shared->options()));
  mesh.shared->requireRows(optionsText(description, job), partOf(progress, 0.0, 0.05));
  made->job->prepareOn(made->stored());
  made->solution = made->job->solveOn(made->stored(), partOf(progress, 0.05, 1.0));
  field = made.release();
}

smg_mesh* meshOf(smg_field& field, const ProgressFunction& progress)
{
  ConversionOptions options;
  apply(limitsOf(field.shared->options()), options);
  auto opened = openMesh(field.file(partOf(progress, 0.0, 0.9)), options);
  auto mesh = std::make_unique<smg_mesh>();
  mesh->shared = std::make_shared<SharedMesh>(std::move(opened), *field.shared,
    field.resultColumns(), partOf(progress, 0.9, 1.0), field.scratch());
  return mesh.release();
}

std::string save(
  smg_field& field, const char* path, const char* text, const ProgressFunction& progress)
{
  const WritingOptions options = writingOptions(text, limitsOf(field.shared->options()));
  const bool keepsMerged = field.shared->options().weld && kindOfOutput(path) == MeshFileKind::Vsm;
  CompleteIsolated merged =
    keepsMerged ? mergedValues(field.stored(), field.shared->order(partOf(progress, 0.0, 0.0)),
                    *field.solution, field.job->solutionColumns(field.stored().info()),
                    partOf(progress, 0.0, 0.0))
                : CompleteIsolated();
  ResultFile out =
    resultFile(*field.shared, field.added, field.job.get(), path, options, std::move(merged));
  const ConversionReport* const conversion = field.shared->mesh().conversion();
  out.chooseOrder(field.stored(), conversion, partOf(progress, 0.0, 0.0));
  std::vector<std::string> notes;
  const std::int64_t memory = MeshJob::writerMemory(
    options.limits.memory > 0 ? options.limits.memory : field.job->memoryLimit());
  field.pass([&](MeshSource& result, const ProgressFunction& writing)
    { notes = out.write(field.stored(), result, memory, writing); },
    progress);
  Report report = field.report({});
  for (const std::string& note : notes)
  {
    report.warn(note);
  }
  if (conversion)
  {
    const std::vector<std::string> more = out.notesOn(*conversion, *field.job);
    report.notes.insert(report.notes.end(), more.begin(), more.end());
  }
  field.solution->removeCheckpoint();
  return report.json();
}

} // namespace
} // namespace smg

smg_status smg_run(smg_mesh* mesh, const char* job, const char* description, smg_progress progress,
  void* user, smg_field** field)
{
  return smg::guarded(
    [&]
    {
      smg::required(field, "field") = nullptr;
      smg::run(smg::required(mesh, "mesh"), &smg::required(job, "job"), description,
        smg::progressOf(progress, user), *field);
    });
}

smg_status smg_open_field(smg_field* field, smg_progress progress, void* user, smg_mesh** mesh)
{
  return smg::guarded(
    [&]
    {
      smg::required(mesh, "mesh") = nullptr;
      *mesh = smg::meshOf(smg::required(field, "field"), smg::progressOf(progress, user));
    });
}

smg_status smg_report(
  smg_field* field, int full, smg_progress progress, void* user, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg::required(json, "json") = nullptr;
      smg_field& given = smg::required(field, "field");
      given.text = full != 0 ? given.report(smg::progressOf(progress, user)).json()
                             : given.solution->report().json();
      *json = given.text.c_str();
    });
}

smg_status smg_shape(const smg_field* field, int64_t* vertices, int64_t* columns)
{
  return smg::guarded(
    [&]
    {
      const smg_field& given = smg::required(field, "field");
      smg::required(vertices, "vertices") = given.shared->vertices();
      smg::required(columns, "columns") =
        given.job->solutionColumns(given.stored().info()).front().components;
    });
}

smg_status smg_save(smg_field* field, const char* path, const char* options, smg_progress progress,
  void* user, const char** report)
{
  return smg::guarded(
    [&]
    {
      smg_field& given = smg::required(field, "field");
      given.text =
        smg::save(given, &smg::required(path, "path"), options, smg::progressOf(progress, user));
      if (report)
      {
        *report = given.text.c_str();
      }
    });
}

void smg_close_field(smg_field* field)
{
  delete field;
}
