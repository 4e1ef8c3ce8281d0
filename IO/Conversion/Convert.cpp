// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"
#include "IO/Conversion/Conversion.h"
#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/ConversionStages.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Formats/WriteFiles.h"
#include "IO/Import/Polygons.h"
#include "IO/Import/RawMesh.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Import/UnmatchedFaces.h"
#include "IO/Import/VertexGroups.h"
#include "IO/Import/Weld.h"
#include "IO/Mesh/Columns.h"
#include "IO/Order/Assembly/CellFlagger.h"
#include "IO/Order/Assembly/LayoutSource.h"
#include "IO/Order/Coupling.h"
#include "IO/Order/LayOut.h"
#include "IO/Order/Search/FileOrder.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Text.h"
#include "Solver/Core/Timer.h"
#include "Solver/Jobs/Fairing/OrientedMesh.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

void freeName(std::vector<RawColumn>& columns, const ColumnSpec& numbers, Numbering numbering,
  std::vector<std::string>& notes)
{
  const std::string& name = numbers.name;
  const auto isNamed = [&columns](const std::string& candidate)
  {
    return std::ranges::any_of(
      columns, [&candidate](const RawColumn& column) { return column.spec.name == candidate; });
  };
  for (RawColumn& column : columns)
  {
    if (column.spec.name == name && (numbering == Numbering::OfRows || column.spec != numbers))
    {
      int number = 1;
      while (isNamed(name + ('_' + std::to_string(number))))
      {
        ++number;
      }
      column.spec.name += '_' + std::to_string(number);
      notes.push_back("The column " + inQuotes(name) + " of the input is called " +
                      inQuotes(column.spec.name) + ", since " + inQuotes(name) +
                      " says the places in the input itself.");
    }
  }
}

/** Renames a column of the mesh that has the name of the original indices but another type (as in
 * formats without such integers), with a sentence in `notes`. */
void freeNumberNames(RawMesh& mesh, Numbering numbering, std::vector<std::string>& notes)
{
  freeName(mesh.vertexColumns, OriginalIdSpec, numbering, notes);
  freeName(mesh.elementColumns, OriginalCellIdSpec, numbering, notes);
}

/** Whether the mesh already has columns of original indices. */
bool isNumbered(const RawMesh& mesh)
{
  const auto has = [](const std::vector<RawColumn>& columns, const ColumnSpec& numbers)
  {
    return std::ranges::any_of(
      columns, [&numbers](const RawColumn& column) { return column.spec == numbers; });
  };
  return has(mesh.vertexColumns, OriginalIdSpec) || has(mesh.elementColumns, OriginalCellIdSpec);
}

constexpr std::int64_t Unknown = std::numeric_limits<std::int64_t>::max();

/**
 * Rejects meshes that certainly do not fit on the disk, if the file states the size of the mesh.
 */
void checkSaidRoom(const Conversion& conversion)
{
  if (conversion.inputKind() == MeshFileKind::Unknown || conversion.importer())
  {
    return;
  }
  const bool throughVsm = kindOfOutput(conversion.out()) != MeshFileKind::Vsm;
  const ConversionEstimate estimate =
    estimateConversion(conversion.in(), conversion.options(), throughVsm);
  if (estimate.counted)
  {
    checkScratchRoom(conversion.scratch(), estimate.scratch_bytes);
  }
}

/** What is known of a parsed mesh: cells instead of elements. */
StreamInfo infoOf(const RawMesh& mesh)
{
  StreamInfo info;
  info.cellType = mesh.cellType;
  info.vertices = mesh.vertices;
  info.cells = mesh.cells;
  info.doublePositions = mesh.doublePositions;
  for (const RawColumn& column : mesh.vertexColumns)
  {
    info.vertexColumns.push_back(column.spec);
  }
  for (const RawColumn& column : mesh.elementColumns)
  {
    info.cellColumns.push_back(column.spec);
  }
  return info;
}

RawMesh readInput(Conversion& conversion)
{
  Workspace& space = conversion.workspace();
  space.beginPart(0.15, Unknown);
  if (conversion.importer())
  {
    return conversion.importer()(space, conversion.progress());
  }
  if (!conversion.isStream())
  {
    RawMesh mesh = importMesh(conversion.in(), space,
      { conversion.options().cells, conversion.progress(), conversion.part() });
    conversion.checkInput();
    return mesh;
  }
  return readStream(*conversion.openStream().source(), conversion.in().string(), space);
}

void noteImport(const ImportCounts& file, ConversionReport& report)
{
  report.dropped_cells = file.droppedCells;
  report.triangulated_polygons = file.triangulatedPolygons;
  report.split_cells = file.splitCells;
  report.higher_order_cells = file.higherOrderCells;
  report.merged_points = file.mergedPoints;
  report.time_steps = file.timeSteps;
  report.partitions = file.partitions;
  for (const std::string& name : file.droppedColumns)
  {
    report.notes.push_back(
      "The column " + inQuotes(name) + " was left out, since its name is reserved or used twice.");
  }
  report.notes.insert(report.notes.end(), file.notes.begin(), file.notes.end());
}

void noteLayout(const LayOutCounts& counts, const StreamLayout& layout, ConversionReport& report)
{
  report.components = counts.mesh.components;
  report.boundary_edges = counts.mesh.boundaryEdges;
  report.nonmanifold_edges = counts.mesh.nonManifoldEdges;
  report.nonmanifold_vertices = counts.mesh.nonManifoldVertices;
  report.pages = counts.pages.pages;
  report.page_loads = counts.pages.loads;
  report.degenerate_cells = layout.degenerateCells;
  report.duplicate_cells = layout.duplicateCells;
  report.notes.insert(report.notes.end(), counts.notes.begin(), counts.notes.end());
  if (layout.facetsElsewhere > 0)
  {
    report.notes.push_back(counted(layout.facetsElsewhere, "element", "elements") +
                           " of groups lie on no facet of the mesh, and are left out.");
  }
}

/** Merges points within this distance; returns how many. Throws Error if that are all of them. */
std::int64_t weld(Conversion& conversion, RawMesh& mesh, double distance)
{
  Workspace& space = conversion.workspace();
  VertexFilter joined(space, mesh.vertices);
  const std::int64_t merged = weldPoints(mesh, distance, space, &joined);
  if (merged > 0 && merged == mesh.vertices - 1 && distance > 0.0)
  {
    throw Error(conversion.in().string() +
                ": all points are so near one another that they would be merged with one. Is the "
                "distance (option --weld) in the unit of the mesh?");
  }
  if (merged > 0 && mesh.cellType == CellType::Tetrahedron)
  {
    if (const std::int64_t faces = unmatchedFaces(mesh, joined, space); faces > 0)
    {
      conversion.report().notes.push_back(
        "The welded bodies do not match: " + counted(faces, "triangle", "triangles") +
        " of their surfaces at merged points lie upon others with other corners, and stay on the "
        "boundary. There the bodies are connected at the merged points alone, so that too little "
        "flows between them: mesh them as one (BooleanFragments or Coherence in Gmsh), or with "
        "the same triangles on both sides.");
    }
  }
  return merged;
}

void importInput(Conversion& conversion, RawMesh& mesh)
{
  Workspace& space = conversion.workspace();
  ConversionReport& report = conversion.report();
  mesh = readInput(conversion);
  checkOutput(conversion.out(), mesh.cellType);
  checkScratchRoom(conversion.scratch(), scratchBytes(infoOf(mesh), conversion.options()),
    space.traffic().bytesWritten);
  cutPolygons(mesh, space);
  const std::optional<double>& distance = conversion.options().weld;
  const std::int64_t merged = distance ? weld(conversion, mesh, *distance) : 0;
  // Merged points no longer belong to a cell.
  report.isolated_vertices -= merged;
  addVertexGroups(mesh, space);
  freeNumberNames(mesh, conversion.options().numbering, report.notes);
  report.keeps_numbers = isNumbered(mesh);
  report.seconds.import = conversion.lap();
}

void layOutInput(Conversion& conversion, RawMesh& mesh, StreamLayout& layout)
{
  linkCoupled(mesh, conversion.options().coupled, conversion.workspace());
  ConversionReport& report = conversion.report();
  LayOutCounts counts;
  layout = layOut(mesh, conversion.options().order, conversion.workspace(), counts, 0.75);
  report.isolated_vertices += counts.mesh.isolatedVertices;
  noteImport(mesh.counts, report);
  noteLayout(counts, layout, report);
  report.inverted_cells = mesh.cellType == CellType::Tetrahedron ? layout.invertedCells : -1;
  report.seconds.order = conversion.lap();
}

/** Opens the input again where it has been imported by an earlier program. */
void openAgain(Conversion& conversion)
{
  if (conversion.isStream())
  {
    const std::int64_t isolated = conversion.report().isolated_vertices;
    conversion.openStream();
    conversion.report().isolated_vertices = isolated;
  }
}

void noteWinding(
  const Orientation& winding, const StreamInfo& mesh, std::vector<std::string>& notes)
{
  if (winding.turned() > 0)
  {
    notes.push_back(counted(winding.turned(), "triangle was turned.", "triangles were turned."));
    for (const auto* columns : { &mesh.vertexColumns, &mesh.cellColumns })
    {
      if (std::ranges::any_of(*columns, isNormals))
      {
        notes.push_back(std::string("The column ") + NormalsName + " of the " +
                        (columns == &mesh.vertexColumns ? "vertices" : "cells") +
                        " stays as it was: where triangles were turned, it points to their back.");
      }
    }
  }
  if (winding.unorientable() > 0)
  {
    notes.push_back(counted(winding.unorientable(), "body has", "bodies have") +
                    " no two sides, and stayed as wound.");
  }
  if (winding.cavities() > 0.0)
  {
    char volume[32];
    std::snprintf(volume, sizeof(volume), "%.4g", winding.cavities());
    notes.push_back("Bodies that are wound against larger ones that they lie in count as cavities, "
                    "and are wound inwards: they enclose " +
                    std::string(volume) + '.');
  }
  if (winding.ambiguous() > 0)
  {
    notes.push_back(counted(winding.ambiguous(), "closed body lies", "closed bodies lie") +
                    " in others without being wound alike: taken as solid, and wound outwards, "
                    "though it may be a cavity.");
  }
  if (winding.branched() > 0)
  {
    notes.push_back(
      counted(winding.branched(), "part of the surface ends", "parts of the surface end") +
      " at edges of more than two triangles: which side is outside is not known there, and "
      "triangles are wound as most of their part are.");
  }
}

/** The stream that `open` opens, oriented if that is asked for: for that it is read before. */
std::unique_ptr<MeshSource> wound(Conversion& conversion, std::optional<Orientation>& winding,
  const std::function<std::unique_ptr<MeshSource>()>& open)
{
  std::unique_ptr<MeshSource> source = open();
  if (!conversion.options().orient || source->info().cellType != CellType::Triangle)
  {
    return source;
  }
  Workspace& space = conversion.workspace();
  winding.emplace(space.pool(), space.folder());
  Progress reported(conversion.progress());
  winding->find(
    [&](const Orientation::Visit& visit)
    {
      if (!source)
      {
        source = open();
      }
      for (MeshBlock block; source->next(block);)
      {
        visit(block);
        reported.update(0.0); // asks whether to go on
      }
      source.reset();
    });
  source = open();
  noteWinding(*winding, source->info(), conversion.report().notes);
  return numberedByFirstUse(oriented(std::move(source), *winding));
}

/** Sorts a mesh into a stream order with scratch files and writes it. Throws like convert(). */
void convertMesh(Conversion& conversion)
{
  Workspace& space = conversion.workspace();
  RawMesh mesh(space);
  StreamLayout layout(space);
  ConversionStages stages(conversion);
  const ConversionStages::Stage done = stages.load(mesh, layout);
  if (done < ConversionStages::Imported)
  {
    checkSaidRoom(conversion);
    importInput(conversion, mesh);
    stages.save(ConversionStages::Imported, mesh, layout);
  }
  else
  {
    openAgain(conversion);
    checkOutput(conversion.out(), mesh.cellType);
  }
  if (done < ConversionStages::LaidOut)
  {
    layOutInput(conversion, mesh, layout);
    stages.save(ConversionStages::LaidOut, mesh, layout);
  }
  std::optional<Orientation> winding;
  const std::unique_ptr<MeshSource> source =
    wound(conversion, winding, [&] { return std::make_unique<LayoutSource>(mesh, layout, space); });
  space.beginPart(1.0, Unknown);
  conversion.write(*source,
    [&](VsmWriter& writer)
    {
      takeIsolatedVertices(mesh, layout, space,
        [&writer](const IsolatedVertices& vertices)
        { writer.isolated(vertices.ids, vertices.positions, vertices.columns); });
      // Those of a stream are already stored separately, by their indices in the original file.
      if (const VsmReader* const stream = conversion.stream())
      {
        copyIsolated(stream->path(), source->info(), writer, {}, stream->fingerprint());
      }
    });
  stages.discard();
}

const ColumnSpec FlagsSpec{ CellFlagsName, ScalarType::UInt8, 1 };

/** Counts the flags of the cells of the stream. */
void countFlags(Conversion& conversion, const VsmReader& reader)
{
  ConversionReport& report = conversion.report();
  visitBlocks(*reader.source({}, { CellFlagsName }), conversion.progress(), 0.0, 1.0,
    [&report](const MeshBlock& block)
    {
      for (const std::uint8_t flags : block.cellColumns[0].as<std::uint8_t>())
      {
        report.degenerate_cells += (flags & DegenerateCell) != 0 ? 1 : 0;
        report.duplicate_cells += (flags & DuplicateCell) != 0 ? 1 : 0;
      }
    });
}

/** Counts the degenerate and duplicate cells of the stream, unless that needs too much memory. */
void findFlags(Conversion& conversion, const VsmReader& reader)
{
  const StreamInfo& info = reader.info();
  ConversionReport& report = conversion.report();
  if (info.span > conversion.memory() / CellFlagger::BytesPerVertex)
  {
    report.degenerate_cells = report.duplicate_cells = -1;
    report.notes.push_back("The order of the stream is too poor (span " +
                           std::to_string(info.span) +
                           ") to look for degenerate and duplicate cells within the memory limit.");
    return;
  }
  CellFlagger flagger(info.cellType);
  visitBlocks(*reader.source({}, {}), conversion.progress(), 0.0, 1.0,
    [&flagger](const MeshBlock& block) { flagger.flags(block); });
  report.degenerate_cells = flagger.degenerateCells();
  report.duplicate_cells = flagger.duplicateCells();
}

std::unique_ptr<MeshSource> withFlags(std::unique_ptr<MeshSource> source, CellType cellType)
{
  return std::make_unique<AddedColumn>(std::move(source), AddedColumn::Cells, FlagsSpec,
    [flagger = CellFlagger(cellType)](const MeshBlock& block, Column& column) mutable
    { std::memcpy(column.bytes.data(), flagger.flags(block).data(), column.bytes.size()); });
}

/** Writes a stream in its order, block by block, with the flags of its degenerate and duplicate
 * cells. Throws like convert(). */
void copyStream(Conversion& conversion)
{
  Workspace& space = conversion.workspace();
  ConversionReport& report = conversion.report();
  space.beginPart(0.4, Unknown);
  const VsmReader& reader = conversion.openStream();
  checkOutput(conversion.out(), reader.info().cellType);
  report.seconds.import = conversion.lap();

  const bool flagged = findColumn(reader.info().cellColumns, FlagsSpec) >= 0;
  space.beginPart(0.6, Unknown);
  flagged ? countFlags(conversion, reader) : findFlags(conversion, reader);
  report.seconds.order = conversion.lap();

  std::optional<Orientation> winding;
  std::unique_ptr<MeshSource> source = wound(conversion, winding,
    [&]
    {
      const bool adds = !flagged && (report.degenerate_cells > 0 || report.duplicate_cells > 0);
      return adds ? withFlags(reader.source(), reader.info().cellType) : reader.source();
    });
  space.beginPart(1.0, Unknown);
  conversion.write(*source, [&](VsmWriter& writer)
    { copyIsolated(reader.path(), source->info(), writer, {}, reader.fingerprint()); });
}

/** Restores the order of the original file. */
void restoreMesh(Conversion& conversion)
{
  if (conversion.inputKind() != MeshFileKind::Vsm)
  {
    throw Error(conversion.in().string() +
                ": only a .vsm file knows the order of the file that it was made of: give one.");
  }
  Workspace& space = conversion.workspace();
  ConversionReport& report = conversion.report();
  space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
  const VsmReader reader(conversion.in());
  const StreamInfo& info = reader.info();
  report.order = "restored";
  report.vertices = info.vertices;
  report.cells = info.cells;
  report.notes = writeRestored(conversion.in(), conversion.out(), space, conversion.options().text);
  report.seconds.write = conversion.lap();
}

/** Converts a compressed stream via an uncompressed file in the scratch folder. Throws like
 * convert(), and Error if the compressed data are damaged. */
ConversionReport convertCompressedStream(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options)
{
  Workspace space(options.scratch, memoryOf(options), {}, options.scratchLimit);
  ConversionOptions inner = options;
  inner.scratch = space.folder();
  inner.checkpoint.clear(); // the inflated file has another name in each program
  InputFile file(in);
  const std::string name = in.stem().string() + ".stream";
  const InflatedFile inflated(file, space, name.c_str());
  try
  {
    ConversionReport report = convert(inflated.path(), out, inner);
    report.scratch_bytes_peak = space.peakScratch();
    return report;
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const Error& error)
  {
    std::string sentence = error.what();
    const std::string path = inflated.path().string();
    if (sentence.starts_with(path))
    {
      sentence.replace(0, path.size(), in.string());
    }
    throw Error(sentence);
  }
}

void run(Conversion& conversion)
{
  const ConversionOptions& options = conversion.options();
  if (options.restoreOrder)
  {
    restoreMesh(conversion);
    return;
  }
  checkOutput(conversion.out());
  conversion.report().order = nameOf(options.order);
  conversion.copies() ? copyStream(conversion) : convertMesh(conversion);
}

} // namespace

ConversionReport convert(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options)
{
  checkIsNotInput(in, out);
  checkOutputPlace(out);
  checkForm(out, options.text);
  if (!options.checkpoint.empty() && !Conversion::hasStages(in, options))
  {
    throw Error(in.string() +
                ": this conversion has no stages from which it could continue: leave the "
                "checkpoint out (option --checkpoint).");
  }
  if (isCompressedStream(in))
  {
    return convertCompressedStream(in, out, options);
  }
  Conversion conversion(in, out, options);
  return runConversion(conversion);
}

ConversionReport runConversion(Conversion& conversion)
{
  const Timer timer;
  const double cpu = processSeconds();
  run(conversion);
  Workspace& space = conversion.workspace();
  ConversionReport report = conversion.report();
  report.pool_bytes_peak = space.pool().peak();
  report.scratch_bytes_peak = space.peakScratch();
  report.scratch_bytes_read = space.traffic().bytesRead;
  report.scratch_bytes_written = space.traffic().bytesWritten;
  report.seconds.total = timer.seconds();
  report.cpu_seconds = processSeconds() - cpu;
  report.rss_bytes_peak = peakResidentBytes();
  return report;
}

} // namespace smg
