// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Simplify.h"

#include "IO/External/Workspace.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "IO/Mesh/Columns.h"
#include "IO/Simplification/HeldMesh.h"
#include "IO/Simplification/SimplifiedMesh.h"
#include "IO/Simplification/SimplifyFields.h"
#include "IO/Simplification/StreamSimplifier.h"
#include "IO/Simplification/WindowSize.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/FieldsJson.h"
#include "Solver/Core/Text.h"
#include "Solver/Core/Timer.h"
#include "Solver/Core/Workers.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Mesh/StreamCheck.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

// simplify(): a mesh file to a simplified surface, through a .vsm file. A .vsm result is written as
// the parts come; any other format is written from a .vsm file in a scratch folder.

namespace smg
{
namespace
{

void check(const SimplifyTarget& target, const SimplifyOptions& options)
{
  if (target.vertices == 0 && target.error == 0.0)
  {
    throw Error("a simplification needs the number of vertices or the error of its result");
  }
  if (target.vertices != 0 && (target.vertices < SimplifyTarget::MinVertices ||
                                target.vertices > SimplifyTarget::MaxVertices))
  {
    throw Error("a simplified mesh of " + std::to_string(target.vertices) +
                " vertices is asked for; expected " + std::to_string(SimplifyTarget::MinVertices) +
                " to " + std::to_string(SimplifyTarget::MaxVertices));
  }
  if (!std::isfinite(target.error) || target.error < 0.0)
  {
    throw Error("the error of a simplification is " + std::to_string(target.error) +
                "; expected a length above 0, or 0 for what the number of vertices needs");
  }
  checkLeastMemory("a simplification", options.memoryLimit);
}

/** What must be the same when a simplification is continued: the mesh and everything that its
 * result depends on. Threads do not. */
std::vector<Checkpoint::Item> subjectOf(
  const StoredMesh& mesh, const SimplifyTarget& target, const SimplifyOptions& options)
{
  char error[32];
  // Seventeen digits: different numbers are different texts.
  std::snprintf(error, sizeof(error), "%.17g", target.error);
  return { { "kind of task", "simplification" }, { "mesh", mesh.fingerprint() },
    { "number of vertices", std::to_string(target.vertices) }, { "error", error },
    { "memory limit", std::to_string(options.memoryLimit) },
    { "held parts", textOf(options.hold) } };
}

std::string cellColumnsOf(const std::vector<std::string>& names)
{
  std::string text = names.size() == 1 ? "cell column '" : "cell columns '";
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    text += (k == 0 ? "" : "', '") + names[k];
  }
  return text + '\'';
}

/** Names the columns of the cells of a solid, which its surface does not have. The numbers and
 * flags that a conversion gives to cells are not missed. */
void noteCellColumns(const StreamInfo& info, std::vector<std::string>& notes)
{
  const std::vector<std::string> names = columnNames(carriedColumns(info));
  if (info.cellType == CellType::Tetrahedron && !names.empty())
  {
    notes.push_back("The " + cellColumnsOf(names) + " of the solid " +
                    (names.size() == 1 ? "is" : "are") + " not in the result.");
  }
}

/** "Of the labels in 'Material', 2 of 9 are not in the result, and ..." */
std::string textOf(const CellLabels::Changes& changes)
{
  std::string text =
    "Of the " + std::to_string(changes.labels) + " labels in '" + changes.column + "', ";
  if (changes.lost > 0)
  {
    text += std::to_string(changes.lost) + (changes.lost == 1 ? " is" : " are") +
            " not in the result" + (changes.changed > 0 ? ", and " : "");
  }
  if (changes.changed > 0)
  {
    text += std::to_string(changes.changed) + (changes.changed == 1 ? " has" : " have") +
            " a share of the area that differs from that in the mesh by more than 20 %";
  }
  return text + '.';
}

/** Says where borders between labels are not held. */
void noteBorders(
  const StreamSimplifier& simplifier, const StreamInfo& info, std::vector<std::string>& notes)
{
  if (const std::vector<std::string> names = simplifier.labels().others();
      !names.empty() && info.cellType == CellType::Triangle)
  {
    notes.push_back("The " + cellColumnsOf(names) + (names.size() == 1 ? " has" : " have") +
                    " too many values, or values that change too often, for labels (at most " +
                    std::to_string(CellLabels::MostLabels) + ", each of at least " +
                    std::to_string(CellLabels::CellsOfLabel) +
                    " cells on average): borders between them are not held.");
  }
  if (simplifier.counts().crossesBorders)
  {
    notes.emplace_back("So few vertices are not enough for the borders between the labels of the "
                       "cells and for edges in groups: some are not held.");
  }
}

/** Says that cracks may open along seams where there was no memory to hold them; where vertices
 * were merged, or nothing was simplified, none do. */
void noteSeams(const HeldMesh& mesh, const SimplifyReport& report,
  const SimplificationCounts& counts, std::vector<std::string>& notes)
{
  if (mesh.seams() == 0 || (mesh.marksSeams() && !counts.splitsSeams) || counts.merged > 0 ||
      report.vertices == report.vertices_before)
  {
    return;
  }
  notes.push_back("Points of the boundary coincide at " +
                  std::string(mesh.marksSeams() ? "" : "about ") + std::to_string(mesh.seams()) +
                  (mesh.seams() == 1 ? " place" : " places") +
                  ", more than the memory limit has room for: the sides of such a seam are "
                  "simplified each for itself, and a crack may open between them. Raise the limit, "
                  "or join these points first " +
                  HowToWeld + '.');
}

/** Says where the number of vertices is not that which was asked for, or points are held in vain,
 * or the error that is asked for cannot be meant.
 * `held`: in the mesh. */
void noteVertices(const StreamInfo& info, const SimplifyTarget& target,
  const SimplifyReport& report, const SimplificationCounts& counts, std::int64_t held,
  std::vector<std::string>& notes)
{
  if (const std::int64_t lost = held - counts.held; lost > 0)
  {
    notes.push_back(std::to_string(lost) + " of the " + std::to_string(held) +
                    " held points are in no triangle of the surface, so not in the result.");
  }
  const auto& [xmin, xmax, ymin, ymax, zmin, zmax] = info.bounds;
  if (const double diagonal = std::hypot(xmax - xmin, ymax - ymin, zmax - zmin);
      diagonal > 0.0 && target.error > diagonal)
  {
    char sentence[256];
    std::snprintf(sentence, sizeof(sentence),
      "An error of %.3g is larger than the mesh, whose diagonal is %.3g, and limits nothing. Is it "
      "in the unit of the mesh?",
      target.error, diagonal);
    notes.emplace_back(sentence);
  }
  if (target.vertices <= 0 || report.vertices <= target.vertices)
  {
    return;
  }
  const std::string more =
    "The result has more than " + std::to_string(target.vertices) + " vertices: ";
  if (counts.held >= target.vertices)
  {
    notes.push_back(more + std::to_string(counts.held) + " are held.");
    return;
  }
  notes.push_back(
    more + (counts.held > 0 ? std::to_string(counts.held) + " are held, and further" : "further") +
    " collapses would " + (target.error > 0.0 ? "exceed the error, " : "") +
    "turn triangles over or tear the surface.");
}

/** Says where labels lose or gain area, after what was said of the number of vertices and of the
 * borders, if anything was. */
void noteShares(const CellLabels& labels, std::vector<std::string>& notes)
{
  std::string text;
  for (const CellLabels::Changes& changes : labels.changes())
  {
    text += (text.empty() ? "" : " ") + textOf(changes);
  }
  if (text.empty())
  {
    return;
  }
  if (notes.empty())
  {
    notes.push_back(text);
  }
  else
  {
    notes.back() += ' ' + text;
  }
}

std::vector<std::string> notesOn(const StreamInfo& info, const SimplifyTarget& target,
  const SimplifyReport& report, const StreamSimplifier& simplifier, const HeldMesh& mesh)
{
  const SimplificationCounts& counts = simplifier.counts();
  std::vector<std::string> notes;
  if (counts.resumedAt > 0)
  {
    notes.push_back("continued after " + std::to_string(counts.resumedAt) +
                    " vertices of the mesh, the last state that the checkpoint has");
  }
  noteBodies(simplifier, notes);
  noteCellColumns(info, notes);
  noteBorders(simplifier, info, notes);
  noteSeams(mesh, report, counts, notes);
  noteShape(simplifier, mesh.seams() > 0, notes);
  noteVertices(info, target, report, counts, mesh.held(), notes);
  noteShares(simplifier.labels(), notes);
  return notes;
}

/** Simplifies the mesh to a .vsm file and reports what it did. `checkpoint` is the folder of the
 * checkpoint, or null. */
SimplifyReport simplifyToVsm(const StoredMesh& mesh, const SimplifyTarget& target,
  const std::filesystem::path& vsm, const SimplifyOptions& options, double end,
  ScratchFolder* checkpoint)
{
  // What is read first: only positions and corners, unless something is held.
  const double found = (options.hold.empty() ? 0.1 : 0.2) * end;
  HeldMesh source(
    mesh, options.hold, options.memoryLimit, options.scratch, partOf(options.progress, 0.0, found));
  Progress done(partOf(options.progress, found, end));
  Workers workers(options.threads);
  const std::int64_t kept = source.bytes();
  // Joined seams take more memory in the window.
  constexpr std::int64_t ShareOfSeams = 10;
  const std::int64_t seams = source.marksSeams() ? options.memoryLimit / ShareOfSeams : 0;
  const auto inOwnTerms = [&](const auto& work)
  {
    try
    {
      return work();
    }
    catch (const MemoryLimitError& error)
    {
      // In terms of the limit that was given, of which seams have their share.
      const std::int64_t own = seams == 0 ? 0 : (error.needed() + kept) / (ShareOfSeams - 1);
      throw error.inside(kept + own, options.memoryLimit);
    }
  };
  SimplifiedMesh simplified = inOwnTerms(
    [&]
    {
      return SimplifiedMesh(source, source.marksHeld(), target, options.memoryLimit - kept - seams,
        workers, [&done](double share) { done.update(share); });
    });
  if (checkpoint)
  {
    simplified.simplifier().keepIn(*checkpoint, subjectOf(mesh, target, options));
  }
  VsmWriter writer(vsm, simplified.info(), { .codec = options.codec, .scratch = options.scratch });
  inOwnTerms(
    [&]
    {
      for (MeshBlock block; simplified.next(block);)
      {
        writer.append(block);
      }
    });
  const StreamInfo written = writer.finish();
  const SimplificationCounts& counts = simplified.simplifier().counts();
  SimplifyReport report;
  report.vertices_before = counts.vertices;
  report.cells_before = mesh.info().cells;
  report.vertices = written.vertices;
  report.cells = written.cells;
  report.error = counts.merged > 0 ? std::numeric_limits<double>::quiet_NaN() : counts.error;
  report.dropped_bodies = counts.dropped;
  report.merged_vertices = counts.merged;
  report.resumed_vertices = counts.resumedAt;
  report.pool_bytes_peak =
    std::max(kept + seams + simplified.simplifier().peakMemory(), source.peakMemory());
  report.notes = notesOn(mesh.info(), target, report, simplified.simplifier(), source);
  done.update(1.0);
  return report;
}

/** The vertices that are held by their numbers, as points or all: others are known when the mesh is
 * read. */
std::int64_t heldByName(const std::vector<Where>& parts, const StreamInfo& mesh)
{
  std::int64_t held = 0;
  for (const Where& part : parts)
  {
    const auto* region = std::get_if<Region>(&part);
    const auto* points = std::get_if<NearestVertices>(&part);
    held += region && region->vertices()               ? std::ssize(region->vertices()->ids)
            : points                                   ? std::ssize(points->points)
            : std::holds_alternative<Everywhere>(part) ? mesh.vertices
                                                       : 0;
  }
  return std::min(held, mesh.vertices);
}

} // namespace

JobEstimate simplifyEstimate(const EstimatedInput& mesh, const SimplifyTarget& target,
  const std::filesystem::path& out, const SimplifyOptions& options,
  const ConversionOptions& conversion)
{
  check(target, options);
  constexpr double SecondsOfCell = 1.3e-6; // on a machine of 2023
  Costs costs;
  const bool isSurface = mesh.info.cellType == CellType::Triangle;
  StreamInfo surface = mesh.info;
  if (!isSurface)
  {
    surface.cells = 0; // not known
    surface.cellColumns.clear();
  }
  costs.memory = windowBytes(options.memoryLimit, surface) + openBytes(surface) +
                 heldBytes(options.memoryLimit, heldByName(options.hold, mesh.info), surface);
  costs.passes = isSurface || !options.hold.empty() ? 2 : 1; // the first for seams and what is held
  costs.seconds = SecondsOfCell * static_cast<double>(mesh.info.cells);
  EstimatedInput result = mesh;
  result.parts.clear();
  result.info.cellType = CellType::Triangle;
  result.info.cellColumns = mesh.info.cellType == CellType::Triangle ? carriedColumns(mesh.info)
                                                                     : std::vector<ColumnSpec>();
  if (target.vertices > 0)
  {
    result.info.vertices = std::min(result.info.vertices, target.vertices);
    result.info.cells = std::min(result.info.cells, 2 * result.info.vertices);
  }
  JobEstimate estimate(result,
    { .out = out, .added = { { OriginalIdSpec }, {} }, .text = options.text }, costs, conversion);
  estimate.vertices = mesh.info.vertices;
  estimate.cells = mesh.info.cells;
  estimate.memory_limit = options.memoryLimit;
  return estimate;
}

void checkSimplifiedPath(const std::filesystem::path& path)
{
  const std::string choices = suffixList(FormatUse::Write, CellType::Triangle, "or");
  const FileSuffix* const suffix = suffixFor(FormatUse::Write, path);
  if (!suffix)
  {
    throw Error(
      path.string() + ": this is not a format of a surface: write it as " + choices + '.');
  }
  checkHolds(path, *suffix, CellType::Triangle, choices);
  checkOutputPlace(path);
}

std::string SimplifyReport::json(int indent) const
{
  nlohmann::ordered_json json = jsonOf<false>(*this);
  json["seconds"] = { { "total", this->seconds } }; // as those of other jobs
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

SimplifyReport simplify(const StoredMesh& mesh, const SimplifyTarget& target,
  const std::filesystem::path& path, const SimplifyOptions& options)
{
  check(target, options);
  checkSimplifiedPath(path);
  checkForm(path, options.text);
  checkIsNotInput(mesh.file(), path);
  const Timer timer;
  const double cpu = processSeconds();
  const bool isVsm = kindOfOutput(path) == MeshFileKind::Vsm;
  std::optional<ScratchFolder> kept;
  if (!options.checkpoint.empty())
  {
    if (mesh.fingerprint().empty())
    {
      throw Error("the checkpoint of a simplification needs a mesh with a fingerprint");
    }
    kept.emplace(KeptFolder(options.checkpoint));
  }
  const ScratchFolder scratch(options.scratch, options.scratchLimit);
  const std::filesystem::path vsm = isVsm ? path : scratch / "simplified.vsm";
  SimplifyOptions inside = options;
  inside.scratch = scratch.path();
  SimplifyReport report =
    simplifyToVsm(mesh, target, vsm, inside, isVsm ? 1.0 : 0.9, kept ? &*kept : nullptr);
  if (!isVsm)
  {
    const std::vector<std::string> notes =
      writeFromVsm(vsm, path, partOf(options.progress, 0.9, 1.0), scratch.path(), options.text);
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
  }
  if (kept)
  {
    // Only when the result is complete and has its name.
    Checkpoint(*kept, subjectOf(mesh, target, options)).discard();
  }
  report.rss_bytes_peak = peakResidentBytes();
  report.cpu_seconds = processSeconds() - cpu;
  report.seconds = timer.seconds();
  return report;
}

} // namespace smg
