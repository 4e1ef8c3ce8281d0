// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"
#include "DrawMesh.h"
#include "ProgressBar.h"

#include "IO/Conversion/JobEstimate.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "Solver/Core/Text.h"
#include "smg/Convert.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include <cstdio>

namespace
{

void print(const smg::ConversionReport& report)
{
  const auto number = [](std::int64_t value) { return static_cast<long long>(value); };
  std::printf("%lld vertices, %s, ", number(report.vertices),
    smg::counted(report.cells, "cell", "cells").c_str());
  if (report.width >= 0)
  {
    std::printf("width %lld, span %lld, ", number(report.width), number(report.span));
  }
  std::printf("%.2f s\n", report.seconds.total);
  const auto line = [&number](std::int64_t count, const char* one, const char* several)
  {
    if (count > 0)
    {
      std::printf("  %lld %s\n", number(count), count == 1 ? one : several);
    }
  };
  line(report.components, "component", "components");
  line(report.isolated_vertices, "isolated vertex, which is not part of the stream",
    "isolated vertices, which are not part of the stream");
  line(report.dropped_cells, "cell of another type omitted", "cells of other types omitted");
  line(report.triangulated_polygons, "polygon or strip split into triangles",
    "polygons and strips split into triangles");
  line(report.split_cells, "hexahedron, wedge or pyramid split into tetrahedra",
    "hexahedra, wedges and pyramids split into tetrahedra");
  line(report.higher_order_cells, "higher-order cell, of which only the corners are used",
    "higher-order cells, of which only the corners are used");
  line(report.merged_points, "point merged with others", "points merged with others");
  line(report.degenerate_cells, "degenerate cell", "degenerate cells");
  line(report.duplicate_cells, "duplicate cell", "duplicate cells");
  line(report.boundary_edges, "boundary edge", "boundary edges");
  line(report.nonmanifold_edges, "non-manifold edge", "non-manifold edges");
  line(report.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices");
  line(report.inverted_cells, "inverted tetrahedron", "inverted tetrahedra");
  for (const std::string& note : report.notes)
  {
    std::printf("  %s\n", smg::oneLine(note).c_str());
  }
}

struct ConvertCommand : CommonOptions
{
  std::filesystem::path in, out;
  std::string order = "bfs";
  std::string codec = "zstd";
  std::filesystem::path problem;
  bool orient = false;
  bool restoreOrder = false;
  bool dryRun = false;

  smg::ConversionOptions conversion() const
  {
    smg::ConversionOptions options = this->inputOptions();
    options.order = smg::streamOrder(this->order);
    options.codec = this->codec == "zstd"  ? smg::Codec::Zstd
                    : this->codec == "lz4" ? smg::Codec::Lz4
                                           : smg::Codec::None;
    options.orient = this->orient;
    if (!this->problem.empty())
    {
      options.coupled = smg::coupledGroups(smg::readProblemFile(this->problem));
    }
    options.restoreOrder = this->restoreOrder;
    options.text = this->writesText;
    options.checkpoint = this->checkpoint;
    return options;
  }

  /** Rejects what certainly does not fit on the disks, if IN says its counts. */
  void checkRoom(smg::ConversionOptions options) const
  {
    if (smg::kindOfInput(this->in) != smg::MeshFileKind::Unknown)
    {
      options.scratch = this->scratchPlace();
      const smg::JobEstimate estimate(this->in, this->out, options);
      if (estimate.counted)
      {
        estimate.checkRoom(this->out, options.scratch, this->checkpointBytes());
      }
    }
  }

  void addOptions(CLI::App& command)
  {
    command.add_option("IN", this->in, "The mesh")->required();
    command
      .add_option("OUT", this->out,
        "The mesh in stream order: " + smg::suffixList(smg::FormatUse::Write, "or"))
      ->required();
    command
      .add_option("--order", this->order,
        "bfs (breadth-first), spectral (the smallest width), axis (along the longest side) or keep "
        "(the order of the file)")
      ->check(oneOf({ "bfs", "axis", "keep", "spectral" }))
      ->capture_default_str();
    command
      .add_option("--problem", this->problem,
        "A problem file: the order bfs keeps vertices near each other that its periodic sides and "
        "interfaces couple, so that solving it takes little memory")
      ->type_name("FILE.json");
    command.add_option("--codec", this->codec, "Compression of .vsm files: zstd, lz4 or none")
      ->check(oneOf({ "zstd", "lz4", "none" }))
      ->capture_default_str();
    this->addInputTo(command);
    command.add_flag("--orient", this->orient,
      "Turn triangles so that those of a body are wound alike, and outwards if it is closed");
    command
      .add_flag("--restore-order", this->restoreOrder,
        "Write vertices and cells in the order of the original file of the .vsm file IN, to a " +
          smg::suffixList(smg::FormatUse::Restore, "or") + " file")
      ->excludes("--order", "--weld", "--orient", "--cells", "--codec", "--time-step",
        "--partition", "--problem");
    this->addTextTo(command);
    command.add_flag("--dry-run", this->dryRun,
      "Only estimate the size of the mesh and the cost of the conversion");
    this->addCheckpointTo(command);
    this->addTo(command);
    this->addThreadsTo(command);
  }

  int run() const
  {
    requireOneProcess();
    smg::checkOutputPlace(this->out);
    smg::checkForm(this->out, this->writesText);
    smg::UsedFiles files;
    files.readMesh(this->in);
    files.read(this->problem, "the problem file");
    files.writeMesh(this->out);
    this->checkFiles(std::move(files));
    this->checkCheckpoint({ this->out, this->report });
    smg::ConversionOptions options = this->conversion();
    if (this->dryRun)
    {
      options.scratch = this->scratchPlace();
      const smg::JobEstimate estimate(this->in, this->out, options);
      this->writeReport(estimate.json(), { this->in });
      this->printEstimate(estimate);
      return 0;
    }
    this->checkRoom(options);
    this->announceCheckpoint("stage");
    smg::ConversionReport report;
    try
    {
      ProgressBar bar("converting", this->quiet, this->in);
      options.progress = bar.function();
      report = smg::convert(this->in, this->out, options);
    }
    catch (const smg::Cancelled&)
    {
      this->endCancelled();
    }
    html::PageFacts facts{ this->in };
    if (this->reportsPage() && smg::kindOfOutput(this->out) == smg::MeshFileKind::Vsm)
    {
      facts.surface = surfaceOf(this->out, *this);
    }
    this->writeReport(report.json(), facts);
    if (!this->quiet)
    {
      print(report);
    }
    return 0;
  }
};

} // namespace

void addConvertCommand(CLI::App& program, Action& action)
{
  addCommand<ConvertCommand>(program, action, "convert", "Convert a mesh to a stream order");
}
