// SPDX-License-Identifier: BSD-3-Clause
#include "DrawMesh.h"
#include "ProgressBar.h"

#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Preview/StreamPreview.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"
#include "smg/Preview.h"
#include "smg/WriteMesh.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace
{

struct PreviewCommand : CommonOptions
{
  std::filesystem::path in, out;
  std::int64_t points = smg::DefaultPreviewPoints;
  bool dryRun = false;

  void addOptions(CLI::App& command);
  int run() const;

private:
  void checkOutputName() const;
  int estimate() const;
};

/** Rejects formats that cannot store the map from the preview to the mesh. */
void PreviewCommand::checkOutputName() const
{
  if (smg::kindOfOutput(this->out) == smg::MeshFileKind::Stream)
  {
    throw smg::Error(
      this->out.string() + ": this format cannot hold the columns of a preview: write it as " +
      smg::suffixList(smg::FormatUse::WriteColumns, smg::CellType::Triangle, "or") + '.');
  }
  smg::checkOutput(this->out, smg::CellType::Triangle);
  smg::checkForm(this->out, this->writesText);
}

/** Prints what the preview is expected to cost. */
int PreviewCommand::estimate() const
{
  smg::ConversionOptions conversion = this->inputOptions();
  conversion.scratch = this->scratchPlace();
  const smg::JobEstimate costs = smg::previewEstimate(
    { this->in, conversion }, this->points, this->out, this->writesText, conversion);
  this->writeReport(costs.json(), { this->in });
  this->printEstimate(costs);
  return 0;
}

int PreviewCommand::run() const
{
  requireOneProcess();
  const auto start = std::chrono::steady_clock::now();
  this->checkOutputName();
  smg::UsedFiles files;
  files.readMesh(this->in);
  files.writeMesh(this->out);
  this->checkFiles(std::move(files));
  if (this->dryRun)
  {
    return this->estimate();
  }
  nlohmann::ordered_json report;
  std::vector<std::string> notes;
  {
    ProgressBar bar("reading", this->quiet);
    const std::unique_ptr<smg::OpenedMesh> mesh =
      this->openInput(this->in, smg::partOf(bar.function(), 0.0, 0.5));
    const double begin = mesh->conversion() ? 0.5 : 0.0;
    smg::PreviewSource preview(
      mesh->reader(), this->points, smg::partOf(bar.function(), begin, 0.95), this->in.string());
    smg::WriteMeshOptions options;
    options.scratch = this->scratch;
    options.text = this->writesText;
    options.progress = smg::partOf(bar.function(), 0.95, 1.0);
    notes = smg::writeMesh(preview, this->out, options);
    notes.insert(notes.begin(), preview.notes().begin(), preview.notes().end());
    addNotes(*mesh, notes);
    report["vertices"] = mesh->reader().info().vertices;
    report["cells"] = mesh->reader().info().cells;
    report["points"] = preview.info().vertices;
    report["triangles"] = preview.info().cells;
  }
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report["seconds"] = { { "total", seconds } };
  report["notes"] = notes;
  html::PageFacts facts{ this->in };
  if (this->reportsPage())
  {
    facts.surface = surfaceOf(this->out, *this);
  }
  this->writeReport(report.dump(2), facts);
  if (!this->quiet)
  {
    std::printf("%s and %s of %lld vertices, %.2f s\n",
      smg::counted(report["points"].get<long long>(), "point", "points").c_str(),
      smg::counted(report["triangles"].get<long long>(), "triangle", "triangles").c_str(),
      report["vertices"].get<long long>(), seconds);
    for (const std::string& note : notes)
    {
      std::printf("  %s\n", smg::oneLine(note).c_str());
    }
  }
  return 0;
}

void PreviewCommand::addOptions(CLI::App& command)
{
  command.add_option("IN", this->in, "The mesh")->required();
  command
    .add_option("OUT", this->out,
      "The preview: " +
        smg::suffixList(smg::FormatUse::WriteColumns, smg::CellType::Triangle, "or") +
        ", with the columns of the vertices of IN; StreamIndex "
        "and OriginalId are their indices in the stream and in the original file")
    ->required();
  command.add_option("--points", this->points, "Maximum number of points of the preview")
    ->check(CLI::Range(smg::MinPreviewPoints, smg::MaxPreviewPoints))
    ->capture_default_str()
    ->type_name("N");
  command.add_flag("--dry-run", this->dryRun, "Only estimate the size of the mesh and the costs");
  this->addTextTo(command);
  this->addInputTo(command);
  this->addTo(command, "256", "; to convert IN: a .vsm file is not converted");
}

} // namespace

void addPreviewCommand(CLI::App& program, Action& action)
{
  addCommand<PreviewCommand>(
    program, action, "preview", "Create a coarse surface whose points are vertices of the mesh");
}
