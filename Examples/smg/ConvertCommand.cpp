// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"
#include "ProgressBar.h"
#include "VtkBridge.h"

#include "IO/Conversion/Convert.h"

#include <cstdio>

namespace
{

void print(const smg::ConversionReport& report)
{
  const auto number = [](std::int64_t value) { return static_cast<long long>(value); };
  std::printf("%lld vertices, %lld cells, width %lld, span %lld, %.2f s\n", number(report.vertices),
    number(report.cells), number(report.width), number(report.span), report.seconds.total);
  const auto line = [&number](std::int64_t count, const char* what)
  {
    if (count > 0)
    {
      std::printf("  %lld %s\n", number(count), what);
    }
  };
  line(report.components, "components");
  line(report.isolated_vertices, "isolated vertices left out");
  line(report.dropped_cells, "cells of other kinds left out");
  line(report.triangulated_polygons, "polygons made triangles");
  line(report.degenerate_cells, "degenerate cells");
  line(report.duplicate_cells, "duplicate cells");
  line(report.boundary_edges, "boundary edges");
  line(report.nonmanifold_edges, "non-manifold edges");
  for (const std::string& note : report.notes)
  {
    std::printf("  %s\n", note.c_str());
  }
}

struct ConvertOptions : CommonOptions
{
  std::filesystem::path in, out;
  std::string order = "bfs";
  std::string codec = "zstd";

  void run() const
  {
    this->checkReport();
    smg::ConversionReport report;
    {
      ProgressBar bar("converting", this->quiet);
      loadVtkFor(this->in);
      smg::ConversionOptions options;
      options.order = smg::streamOrder(this->order);
      options.memoryLimit = this->memoryBytes(0);
      options.codec = this->codec == "zstd"  ? smg::Codec::Zstd
                      : this->codec == "lz4" ? smg::Codec::Lz4
                                             : smg::Codec::None;
      options.scratch = this->scratch;
      options.progress = bar.function();
      report = smg::convert(this->in, this->out, options);
    }
    this->writeReport(report.json());
    if (!this->quiet)
    {
      print(report);
    }
  }
};

} // namespace

void addConvertCommand(CLI::App& program, Action& action)
{
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command =
    program.add_subcommand("convert", "Bring a mesh into a stream order and write it");
  command->add_option("IN", options->in, "The mesh")->required();
  command
    ->add_option(
      "OUT", options->out, "The stream: .vsm, .sma, .smb, .sva or .svb; or .ply, .vtp, .vtu")
    ->required();
  command
    ->add_option("--order", options->order,
      "bfs (breadth-first), axis (along the longest axis) or keep (as it is)")
    ->check(oneOf({ "bfs", "axis", "keep", "spectral" }))
    ->capture_default_str();
  command->add_option("--codec", options->codec, "Compression of .vsm files: zstd, lz4 or none")
    ->check(oneOf({ "zstd", "lz4", "none" }))
    ->capture_default_str();
  options->addTo(*command);
  options->addThreadsTo(*command);
  command->callback([options, &action] { action = [options] { options->run(); }; });
}
