// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzzing/FuzzTargets.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Testing/Fuzzing/Finding.h"
#include "Testing/Fuzzing/FuzzPlace.h"
#include "Testing/Fuzzing/MeshChecks.h"
#include "Testing/Fuzzing/SealedVsm.h"
#include "Testing/Fuzzing/SolverTargets.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace smg::testing
{

namespace
{

/** Separates the files of a format that consists of several. */
constexpr std::string_view FileSeparator = "\n%%\n";

/** The bytes before the first separator, which are removed from `bytes` together with it. */
std::string_view takeFile(std::string_view& bytes)
{
  const std::size_t end = bytes.find(FileSeparator);
  const std::string_view file = bytes.substr(0, end);
  bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + FileSeparator.size());
  return file;
}

/** Writes the files of a seed. Returns the one that is read. */
std::filesystem::path writeFiles(const Format& format, std::string_view bytes)
{
  FuzzPlace& place = FuzzPlace::instance();
  if (&format == &TetGenFormat)
  {
    const std::filesystem::path nodes = place.write("tetgen/mesh.node", takeFile(bytes));
    const std::filesystem::path elements = place.write("tetgen/mesh.ele", bytes);
    return bytes.size() % 2 ? nodes : elements;
  }
  if (&format == &ParallelVtkXmlFormat)
  {
    // The file, then its pieces.
    const std::filesystem::path path = place.write("pieces/mesh.pvtu", takeFile(bytes));
    for (const char* piece : { "pieces/0.vtu", "pieces/1.vtu", "pieces/2.vtu" })
    {
      place.write(piece, takeFile(bytes));
    }
    return path;
  }
  return place.write("mesh" + std::string(format.suffixes.back().text), bytes);
}

/** The type of cells that a parser finds which only looks at the file; none if that fails. */
std::optional<CellType> lookAt(
  const std::filesystem::path& path, CellChoice cells, const Format& format)
{
  RawMeshBuilder builder(FuzzPlace::instance().workspace(), cells, RawMeshBuilder::Look);
  InputFile file(path);
  try
  {
    format.parse(file, builder, {}, {});
    builder.finish(); // of triangles only the end tells that no tetrahedron follows
  }
  catch (const CellTypeFound& found)
  {
    return found.type;
  }
  catch (const std::runtime_error&)
  {
    // The whole file has the error, too, or else more of it.
  }
  return {};
}

/** Parses the files with the parser of one format, of which a look at them must have told the type
 * of the cells. */
bool parse(const Format& format, std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = writeFiles(format, bytes);
  return place.run(
    [&]
    {
      const std::optional<CellType> looked = lookAt(path, cells, format);
      RawMeshBuilder builder(place.workspace(), cells);
      InputFile file(path);
      format.parse(file, builder, {}, {});
      try
      {
        const RawMesh mesh = builder.finish();
        checkMesh(mesh);
        mustHold(looked == mesh.cellType, "a look at the file tells another type of the cells");
      }
      catch (const MeshError& error)
      {
        // finish() does not know the file: its caller adds the position.
        throw Error(path.string() + ": " + error.what() + '.');
      }
    });
}

/** The folder of the corpus of a format: its name or, of several words, its last suffix. */
std::string folderOf(const Format& format)
{
  std::string name(format.name);
  std::ranges::transform(
    name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.find(' ') == std::string::npos ? name
                                             : std::string(format.suffixes.back().text.substr(1));
}

bool runImportMesh(const std::string& name, std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = place.write(name, bytes);
  return place.run([&] { checkMesh(importMesh(path, place.workspace(), { cells, {} })); });
}

bool runGzip(std::string_view bytes, CellChoice cells)
{
  return runImportMesh("mesh.obj.gz", bytes, cells);
}

bool runImport(std::string_view bytes, CellChoice cells)
{
  const std::array<const char*, 4> names{ "mesh", "mesh.stl", "mesh.obj", "mesh.ele" };
  return runImportMesh(names[bytes.size() % names.size()], bytes, cells);
}

bool runStream(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  // The suffix decides where the content does not determine the format.
  const char* const name = cells == CellChoice::Only        ? "mesh"
                           : cells == CellChoice::Triangles ? "mesh.sma"
                                                            : "mesh.sva";
  const std::filesystem::path path = place.write(name, bytes);
  return place.run(
    [&]
    {
      // Remains of the output after a failure are found in the workspace.
      const std::filesystem::path out = place.workspace().folder() / "out.vsm";
      checkStreamFile(path);
      streamToVsm(path, out);
      checkVsm(out);
      std::filesystem::remove(out);
    });
}

bool runVsm(std::string_view bytes, CellChoice)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = place.write("mesh.vsm", sealedVsm(bytes));
  return place.run(
    [&]
    {
      checkVsm(path);
      checkConversions(path, place.workspace().folder());
    });
}

std::vector<FuzzTarget> makeTargets()
{
  std::vector<FuzzTarget> targets{ { "gzip", runGzip }, { "import", runImport },
    { "stream", runStream }, { "vsm", runVsm }, { "problem", runProblem, true },
    { "handles", runHandles, true }, { "places", runPlaces, true }, { "solve", runSolve, true },
    { "checkpoint", runCheckpoint, true } };
  for (const Format* format : formats())
  {
    if (format->parse && !format->hasParts) // HDF5 itself is not fuzzed
    {
      targets.push_back({ folderOf(*format), std::bind_front(parse, std::cref(*format)) });
    }
  }
  return targets;
}

} // namespace

std::span<const FuzzTarget> fuzzTargets()
{
  static const std::vector<FuzzTarget> targets = makeTargets();
  return targets;
}

const FuzzTarget& fuzzTarget(std::string_view name)
{
  const auto found = std::ranges::find(fuzzTargets(), name, &FuzzTarget::name);
  if (found == fuzzTargets().end())
  {
    throw std::invalid_argument("there is no fuzz target " + std::string(name));
  }
  return *found;
}

CellChoice choiceFor(std::string_view bytes)
{
  constexpr std::array choices{ CellChoice::Only, CellChoice::Triangles, CellChoice::Tetrahedra };
  return choices[bytes.size() % choices.size()];
}

} // namespace smg::testing
