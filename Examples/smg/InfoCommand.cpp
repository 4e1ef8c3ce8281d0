// SPDX-License-Identifier: BSD-3-Clause
#include "DrawMesh.h"
#include "ProgressBar.h"

#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace
{

const char* nameOfCodec(smg::Codec codec)
{
  constexpr const char* names[] = { "none", "lz4", "zstd" };
  return names[static_cast<int>(codec)];
}

nlohmann::ordered_json describe(const std::vector<smg::ColumnSpec>& specs)
{
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const smg::ColumnSpec& spec : specs)
  {
    columns.push_back({ { "name", spec.name }, { "type", std::string(nameOf(spec.type)) },
      { "components", spec.components } });
  }
  return columns;
}

nlohmann::ordered_json describe(const std::filesystem::path& file, smg::OpenedMesh& mesh)
{
  const smg::VsmReader& reader = mesh.reader();
  const smg::StreamInfo& info = reader.info();
  nlohmann::ordered_json json;
  json["file"] = file.string();
  json["cell_type"] = info.cellType == smg::CellType::Triangle ? "triangle" : "tetrahedron";
  json["vertices"] = info.vertices;
  json["cells"] = info.cells;
  json["isolated_vertices"] = reader.isolatedVertices();
  json["bounds"] = info.bounds;
  json["positions"] = info.doublePositions ? "float64" : "float32";
  json["width"] = info.width;
  json["span"] = info.span;
  json["mean_width"] = reader.meanWidth();
  json["columns"] = { { "vertices", describe(info.vertexColumns) },
    { "cells", describe(info.cellColumns) } };
  if (const auto& conversion = mesh.conversion())
  {
    json["time_steps"] = conversion->time_steps;
    json["partitions"] = conversion->partitions;
  }
  else
  {
    json["blocks"] = { { "vertices", reader.vertexBlocks() }, { "cells", reader.cellBlocks() } };
    json["codec"] = nameOfCodec(reader.codec());
    json["bytes"] = reader.storedBytes();
    json["plain_bytes"] = reader.plainBytes();
    json["compression"] =
      static_cast<double>(reader.plainBytes()) / static_cast<double>(reader.storedBytes());
  }
  return json;
}

void printColumns(const char* of, const std::vector<smg::ColumnSpec>& specs)
{
  for (const smg::ColumnSpec& spec : specs)
  {
    std::printf(
      "  %s %s (%s x %d)\n", of, spec.name.c_str(), nameOf(spec.type).data(), spec.components);
  }
}

void print(const std::filesystem::path& file, smg::OpenedMesh& mesh)
{
  const smg::VsmReader& reader = mesh.reader();
  const smg::StreamInfo& info = reader.info();
  const auto vertices = static_cast<double>(info.vertices);
  std::printf("%s\n", file.c_str());
  std::printf("  vertices    %lld (%s)\n", static_cast<long long>(info.vertices),
    info.doublePositions ? "float64" : "float32");
  std::printf("  cells       %lld %s\n", static_cast<long long>(info.cells),
    info.cellType == smg::CellType::Triangle ? "triangles" : "tetrahedra");
  if (const std::int64_t isolated = reader.isolatedVertices(); isolated > 0)
  {
    std::printf("  isolated    %lld, vertices of no cell, beside the stream\n",
      static_cast<long long>(isolated));
  }
  std::printf("  bounds      [%g, %g] x [%g, %g] x [%g, %g]\n", info.bounds[0], info.bounds[1],
    info.bounds[2], info.bounds[3], info.bounds[4], info.bounds[5]);
  std::printf("  width       %lld (%.3f %%), mean %.1f\n", static_cast<long long>(info.width),
    100.0 * static_cast<double>(info.width) / vertices, reader.meanWidth());
  std::printf("  span        %lld (%.3f %%)\n", static_cast<long long>(info.span),
    100.0 * static_cast<double>(info.span) / vertices);
  printColumns("vertex data", info.vertexColumns);
  printColumns("cell data  ", info.cellColumns);
  if (const auto& conversion = mesh.conversion())
  {
    if (conversion->partitions > 0)
    {
      std::printf("  time steps  %lld\n  partitions  %lld\n",
        static_cast<long long>(conversion->time_steps),
        static_cast<long long>(conversion->partitions));
    }
  }
  else
  {
    std::printf("  blocks      %lld of vertices, %lld of cells\n",
      static_cast<long long>(reader.vertexBlocks()), static_cast<long long>(reader.cellBlocks()));
    std::printf("  compression %s, %lld of %lld bytes (%.2f : 1)\n", nameOfCodec(reader.codec()),
      static_cast<long long>(reader.storedBytes()), static_cast<long long>(reader.plainBytes()),
      static_cast<double>(reader.plainBytes()) / static_cast<double>(reader.storedBytes()));
  }
}

struct InfoCommand : CommonOptions
{
  std::filesystem::path file;
  bool check = false;

  void addOptions(CLI::App& command)
  {
    command.add_option("FILE", this->file, "The mesh")->required();
    command.add_flag("--check", this->check,
      "Read an entire .vsm file and verify its checksums; an error names the first damaged block");
    this->addInputTo(command);
    this->addTo(command);
    this->addThreadsTo(command);
  }

  int run() const
  {
    this->checkReport({ this->file });
    if (this->check && smg::kindOfInput(this->file) != smg::MeshFileKind::Vsm)
    {
      throw smg::Error(
        this->file.string() +
        ": only .vsm files have checksums: leave --check out; this one is read as a whole anyhow.");
    }
    ProgressBar bar("reading", this->quiet);
    // The figures refer to the order of the file.
    const std::unique_ptr<smg::OpenedMesh> mesh =
      this->openInput(this->file, bar.function(), smg::StreamOrder::Keep);
    nlohmann::ordered_json report = describe(this->file, *mesh);
    if (this->check)
    {
      report["checked_blocks"] = smg::checkVsm(this->file, bar.function());
    }
    html::PageFacts facts{ this->file };
    if (this->reportsPage())
    {
      facts.surface = surfaceOf(mesh->reader(), this->memoryBytes(DrawingMemory));
    }
    this->writeReport(
      report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace), facts);
    if (!this->quiet)
    {
      print(this->file, *mesh);
    }
    if (!this->quiet && this->check)
    {
      std::printf("  checksums   those of all %lld blocks are right\n",
        report["checked_blocks"].get<long long>());
    }
    return 0;
  }
};

} // namespace

void addInfoCommand(CLI::App& program, Action& action)
{
  addCommand<InfoCommand>(program, action, "info", "Print the properties of a mesh file");
}
