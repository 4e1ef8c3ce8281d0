// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConvertMesh.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/ConversionStages.h"
#include "IO/Conversion/NumberNames.h"
#include "IO/Files/InQuotes.h"
#include "IO/Formats/Importer.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Import/ReadStream.h"
#include "IO/Import/Weld.h"
#include "IO/Order/Assembly/LayoutSource.h"
#include "IO/Order/LayOut.h"
#include "IO/Order/Search/TakeIsolated.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace smg
{

namespace
{

constexpr std::int64_t Unknown = std::numeric_limits<std::int64_t>::max();

/**
 * Rejects meshes that certainly do not fit on the disk, if the file states the size of the mesh.
 */
void checkSaidRoom(const Conversion& conversion)
{
  if (conversion.inputKind() == MeshFileKind::Unknown)
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
  if (!conversion.isStream())
  {
    return importMesh(conversion.in(), space,
      { conversion.options().cells, conversion.progress(), conversion.part() });
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
}

void importInput(Conversion& conversion, RawMesh& mesh)
{
  Workspace& space = conversion.workspace();
  ConversionReport& report = conversion.report();
  mesh = readInput(conversion);
  checkOutput(conversion.out(), mesh.cellType);
  checkScratchRoom(conversion.scratch(), scratchBytes(infoOf(mesh), conversion.options()),
    space.traffic().bytesWritten);
  const std::optional<double>& weld = conversion.options().weld;
  // Merged points no longer belong to a cell.
  report.isolated_vertices -= weld ? weldPoints(mesh, *weld, space) : 0;
  freeNumberNames(mesh, report.notes);
  report.keeps_numbers = isNumbered(mesh);
  report.seconds.import = conversion.lap();
}

void layOutInput(Conversion& conversion, const RawMesh& mesh, StreamLayout& layout)
{
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

} // namespace

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
  space.beginPart(1.0, Unknown);
  LayoutSource source(mesh, layout, space);
  conversion.write(source,
    [&](VsmWriter& writer)
    {
      takeIsolatedVertices(mesh, layout, space,
        [&writer](const IsolatedVertices& vertices)
        { writer.isolated(vertices.ids, vertices.positions, vertices.columns); });
      // Those of a stream are already stored separately, by their indices in the original file.
      if (const VsmReader* const stream = conversion.stream())
      {
        copyIsolated(stream->path(), source.info(), writer);
      }
    });
  stages.discard();
}

} // namespace smg
