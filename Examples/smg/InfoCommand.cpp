// SPDX-License-Identifier: BSD-3-Clause
#include "DrawMesh.h"
#include "HtmlReport/Text.h"
#include "ProgressBar.h"

#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "Solver/Core/Text.h"
#include "smg/Describe.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace
{

using nlohmann::ordered_json;

/** A line of the summary. */
void printLine(const char* name, const std::string& text)
{
  std::printf("  %-11s %s\n", name, text.c_str());
}

std::string textOf(const smg::MeshDescription::Number& number)
{
  return std::visit(
    []<class T>(T value) -> std::string
    {
      if constexpr (std::is_same_v<T, std::monostate>)
      {
        return "none";
      }
      else if constexpr (std::is_same_v<T, double>)
      {
        return html::number(value);
      }
      else
      {
        return std::to_string(value);
      }
    },
    number);
}

/** The values of a column: its tags with their counts, or the range of each component. */
std::string valuesOf(const smg::MeshDescription::Column& column)
{
  std::string text;
  for (const smg::MeshDescription::Tag& tag : column.tags)
  {
    text += (text.empty() ? ": " : ", ") + textOf(tag.value) + " (" + html::count(tag.count) + ')';
  }
  for (std::size_t k = 0; column.tags.empty() && k < column.minimum.size(); ++k)
  {
    text += (text.empty() ? ": [" : " x [") + textOf(column.minimum[k]) + ", " +
            textOf(column.maximum[k]) + ']';
  }
  return text +
         (column.not_finite > 0 ? ", " + html::count(column.not_finite) + " not finite" : "");
}

/** The columns; with a description also their values. */
void printColumns(const char* of, const std::vector<smg::ColumnSpec>& specs,
  const std::vector<smg::MeshDescription::Column>* described)
{
  for (std::size_t k = 0; k < specs.size(); ++k)
  {
    std::printf("  %s %s (%s x %d)%s\n", of, smg::oneLine(specs[k].name).c_str(),
      nameOf(specs[k].type).data(), specs[k].components,
      described ? valuesOf((*described)[k]).c_str() : "");
  }
}

/** The groups; with a description also how large they are. */
void printGroups(const smg::StreamInfo& info, const std::vector<smg::MeshDescription::Group>* sizes)
{
  const bool isSurface = info.cellType == smg::CellType::Triangle;
  for (std::size_t k = 0; k < info.groups.groups.size(); ++k)
  {
    const smg::Group& group = info.groups.groups[k];
    const std::size_t dimension = group.of == smg::GroupOf::Vertices
                                    ? 0
                                    : (isSurface ? 2U : 3U) - (group.of == smg::GroupOf::Facets);
    constexpr const char* Kinds[] = { "vertices", "edges", "faces", "cells" };
    constexpr const char* Measures[] = { "", ", length ", ", area ", ", volume " };
    const char* kind = group.of == smg::GroupOf::Cells ? Kinds[3] : Kinds[dimension];
    std::string line = "'" + smg::oneLine(group.label()) + "'";
    line += group.number && !group.name.empty() ? " (" + std::to_string(*group.number) + ")" : "";
    line += sizes ? ": " + html::count((*sizes)[k].count) + ' ' + kind : std::string(" of ") + kind;
    if (sizes && dimension > 0)
    {
      line += Measures[dimension] + html::number((*sizes)[k].measure);
    }
    printLine("group", line);
  }
}

/** With all digits of the positions: rounded ones would be those of other meshes. */
std::string boundsText(const smg::StreamInfo& info)
{
  const auto text = [&info](double bound) {
    return info.doublePositions ? smg::shortest(bound) : smg::shortest(static_cast<float>(bound));
  };
  std::string bounds;
  for (std::size_t k = 0; k < 3; ++k)
  {
    bounds +=
      (k > 0 ? " x [" : "[") + text(info.bounds[2 * k]) + ", " + text(info.bounds[2 * k + 1]) + ']';
  }
  return bounds;
}

void print(const std::filesystem::path& file, smg::OpenedMesh& mesh, const ordered_json& report,
  const smg::MeshDescription* described)
{
  const smg::VsmReader& reader = mesh.reader();
  const smg::StreamInfo& info = reader.info();
  const auto vertices = static_cast<double>(info.vertices);
  std::printf("%s\n", smg::oneLine(file.string()).c_str());
  std::printf("  vertices    %lld (%s)\n", static_cast<long long>(info.vertices),
    info.doublePositions ? "float64" : "float32");
  const bool isSurface = info.cellType == smg::CellType::Triangle;
  std::printf(
    "  cells       %s\n", (isSurface ? smg::counted(info.cells, "triangle", "triangles")
                                     : smg::counted(info.cells, "tetrahedron", "tetrahedra"))
                            .c_str());
  if (const std::int64_t isolated = reader.isolatedVertices(); isolated > 0)
  {
    std::printf("  isolated    %lld, vertices of no cell, beside the stream\n",
      static_cast<long long>(isolated));
  }
  std::printf("  bounds      %s\n", boundsText(info).c_str());
  std::printf("  width       %lld (%.3f %%), mean %.1f\n", static_cast<long long>(info.width),
    100.0 * static_cast<double>(info.width) / vertices, reader.meanWidth());
  std::printf("  span        %lld (%.3f %%)\n", static_cast<long long>(info.span),
    100.0 * static_cast<double>(info.span) / vertices);
  printColumns("vertex data", info.vertexColumns, described ? &described->vertex_columns : nullptr);
  printColumns("cell data  ", info.cellColumns, described ? &described->cell_columns : nullptr);
  printGroups(info, described ? &described->groups : nullptr);
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
    std::printf("  compression %s, %lld of %lld bytes (%.2f : 1)\n",
      report["codec"].get<std::string>().c_str(), static_cast<long long>(reader.storedBytes()),
      static_cast<long long>(reader.plainBytes()),
      static_cast<double>(reader.plainBytes()) / static_cast<double>(reader.storedBytes()));
  }
  const ordered_json& solve = report["expected_solve"];
  printLine("solve", "about " + html::bytes(solve["memory_bytes"].get<double>()) + " of memory, " +
                       html::bytes(solve["scratch_bytes"].get<double>()) + " of scratch files, " +
                       html::counted(solve["passes"].get<std::int64_t>(), "pass", "passes") + ", " +
                       html::seconds(solve["cpu_seconds"].get<double>()) + " of CPU");
}

/** The parts of a list that are not 0, each with its number. */
std::string countsOf(
  std::initializer_list<std::pair<std::int64_t, std::pair<const char*, const char*>>> counts)
{
  std::string text;
  for (const auto& [number, names] : counts)
  {
    if (number > 0)
    {
      text += (text.empty() ? "" : ", ") + html::counted(number, names.first, names.second);
    }
  }
  return text;
}

void printTopology(const smg::MeshDescription& mesh)
{
  const bool isSurface = mesh.cell_type == smg::CellType::Triangle;
  std::string bodies = html::count(mesh.bodies);
  if (mesh.bodies > 1)
  {
    bodies += ", the largest with " + html::counted(mesh.largest_body, "cell", "cells");
  }
  printLine("bodies", bodies);
  const std::string parts = isSurface ? html::counted(mesh.boundary_parts, "loop", "loops")
                                      : html::counted(mesh.boundary_parts, "surface", "surfaces");
  const std::string facets = isSurface ? html::counted(mesh.boundary_facets, "edge", "edges")
                                       : html::counted(mesh.boundary_facets, "face", "faces");
  printLine(
    "boundary", mesh.boundary_facets == 0
                  ? "none: closed"
                  : facets + " in " + parts +
                      (isSurface ? ", of length " + html::number(mesh.boundary_length) : ""));
  const std::string unusual =
    countsOf({ { isSurface ? 0 : mesh.nonmanifold_facets,
                 { "face of more than two tetrahedra", "faces of more than two tetrahedra" } },
      { mesh.nonmanifold_edges, { "non-manifold edge", "non-manifold edges" } },
      { mesh.nonmanifold_vertices, { "non-manifold vertex", "non-manifold vertices" } } });
  printLine("manifold", unusual.empty() ? "yes" : "no: " + unusual);
  const std::string turned = countsOf(
    { { mesh.turned_edges,
        { "edge with triangles against each other", "edges with triangles against each other" } },
      { mesh.inverted_cells, { "inverted tetrahedron", "inverted tetrahedra" } } });
  printLine("winding", (mesh.consistently_wound ? "consistent" : "not consistent") +
                         (turned.empty() ? "" : ": " + turned));
  if (const std::string flaws =
        countsOf({ { mesh.degenerate_cells, { "degenerate", "degenerate" } },
          { mesh.coincident_cells,
            { "of these with vertices at one place", "of these with vertices at one place" } },
          { mesh.duplicate_cells, { "duplicate", "duplicates" } } });
      !flaws.empty())
  {
    printLine("flawed", flaws);
  }
}

void printNotes(const std::vector<std::string>& notes)
{
  for (const std::string& note : notes)
  {
    std::printf("%s\n", smg::oneLine(note).c_str());
  }
}

void printDescription(const smg::MeshDescription& mesh)
{
  printTopology(mesh);
  const bool isSurface = mesh.cell_type == smg::CellType::Triangle;
  printLine("edges", html::number(mesh.edge_length.minimum) + " to " +
                       html::number(mesh.edge_length.maximum) + ", mean " +
                       html::number(mesh.edge_length.mean));
  printLine("area", html::number(mesh.area) + (isSurface ? "" : " of the boundary"));
  if (!std::isnan(mesh.volume))
  {
    const bool isTurned = mesh.turned_volume > 0.0 && mesh.volume < 0.0;
    printLine(
      "volume", html::number(mesh.volume) + (isSurface ? " enclosed" : "") +
                  (isTurned                    ? ": wound inwards"
                    : mesh.turned_volume > 0.0 ? ", of which -" + html::number(mesh.turned_volume) +
                                                   " by bodies wound inwards, or cavities"
                                               : ""));
  }
  const smg::MeshDescription::Quality& quality = mesh.quality;
  const std::string bad = countsOf({ { quality.slivers, { "sliver", "slivers" } },
    { quality.scaled_cells, { "cell scaled down by a solve", "cells scaled down by a solve" } } });
  printLine("quality", "mean ratio at least " + html::number(quality.minimum, 3) + ", mean " +
                         html::number(quality.mean, 3) + (bad.empty() ? "" : ", " + bad));
  if (mesh.resolution.offset >= 10.0)
  {
    printLine("offset", html::number(mesh.resolution.offset, 3) + " diagonals from the origin: " +
                          html::number(mesh.resolution.digits, 3) + " digits are left");
  }
  printNotes(mesh.notes);
}

struct InfoCommand : CommonOptions
{
  static constexpr std::int64_t DescriptionMemory = std::int64_t(1) << 30;

  std::filesystem::path file;
  bool check = false, full = false;

  void addOptions(CLI::App& command)
  {
    command.add_option("FILE", this->file, "The mesh")->required();
    command.add_flag("--full", this->full,
      "Read the mesh and describe it: bodies, boundary, what is not manifold, lengths, quality of "
      "the cells, ranges and tags of the columns");
    command.add_flag("--check", this->check,
      "Read an entire .vsm file and verify its checksums; an error names the first damaged block");
    this->addInputTo(command);
    this->addTo(command, "256", "; without it, 1024 MiB for --full");
    this->addThreadsTo(command);
  }

  std::optional<smg::MeshDescription> describe(const smg::OpenedMesh& mesh) const
  {
    if (!this->full)
    {
      return std::nullopt;
    }
    ProgressBar bar("describing", this->quiet);
    return smg::describe(mesh, { this->memoryBytes(DescriptionMemory), bar.function() });
  }

  int run() const
  {
    smg::UsedFiles files;
    files.readMesh(this->file);
    this->checkFiles(std::move(files));
    if (this->check && smg::kindOfInput(this->file) != smg::MeshFileKind::Vsm)
    {
      throw smg::Error(
        this->file.string() +
        ": only .vsm files have checksums: leave --check out; this one is read as a whole anyhow.");
    }
    std::unique_ptr<smg::OpenedMesh> mesh;
    std::int64_t checkedBlocks = 0;
    {
      ProgressBar bar("reading", this->quiet);
      // The figures refer to the order of the file.
      mesh = this->openInput(this->file, bar.function(), smg::StreamOrder::Keep);
      checkedBlocks = this->check ? smg::checkVsm(this->file, bar.function()) : 0;
    }
    const std::optional<smg::MeshDescription> description = this->describe(*mesh);
    const smg::MeshDescription* described = description ? &*description : nullptr;
    // A solve orders a file that is no stream.
    const bool reorders = smg::kindOfInput(this->file) == smg::MeshFileKind::Indexed;
    ordered_json report = ordered_json::parse(
      smg::meshInfo(*mesh, { this->file, mesh->conversion(), reorders, described }));
    if (this->check)
    {
      report["checked_blocks"] = checkedBlocks;
    }
    html::PageFacts facts{ this->file };
    if (this->reportsPage())
    {
      facts.surface = surfaceOf(mesh->reader(), *this);
    }
    this->writeReport(report.dump(2), facts);
    if (this->quiet)
    {
      return 0;
    }
    print(this->file, *mesh, report, described);
    if (described)
    {
      printDescription(*described);
    }
    if (const smg::ConversionReport* conversion = mesh->conversion())
    {
      printNotes(conversion->notes);
    }
    if (this->check)
    {
      std::printf("  checksums   those of all %lld blocks are right\n",
        static_cast<long long>(checkedBlocks));
    }
    return 0;
  }
};

} // namespace

void addInfoCommand(CLI::App& program, Action& action)
{
  addCommand<InfoCommand>(program, action, "info", "Print the properties of a mesh file");
}
