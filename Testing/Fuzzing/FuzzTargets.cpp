// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzzing/FuzzTargets.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Gmsh/GmshFormat.h"
#include "IO/Formats/Medit/MeditFormat.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Obj/ObjFormat.h"
#include "IO/Formats/Off/OffFormat.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Stl/StlFormat.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/TetGen/TetGenFormat.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Testing/Fuzzing/Finding.h"
#include "Testing/Fuzzing/FuzzPlace.h"
#include "Testing/Fuzzing/MeshChecks.h"
#include "Testing/Fuzzing/SealedVsm.h"
#include "Testing/Fuzzing/SolverTargets.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

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

/** The type of cells that a parser finds which only looks at the file; none if that fails. */
template <class Parser>
std::optional<CellType> lookAt(const std::filesystem::path& path, CellChoice cells, Parser parser)
{
  RawMeshBuilder builder(FuzzPlace::instance().workspace(), cells, RawMeshBuilder::Look);
  InputFile file(path);
  try
  {
    parser(file, builder);
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

/** Parses the file in the folder with the parser of one format, of which a look at it must have
 * told the type of the cells. */
template <class Parser>
bool parse(const std::filesystem::path& path, CellChoice cells, Parser parser)
{
  FuzzPlace& place = FuzzPlace::instance();
  return place.run(
    [&]
    {
      const std::optional<CellType> looked = lookAt(path, cells, parser);
      RawMeshBuilder builder(place.workspace(), cells);
      InputFile file(path);
      parser(file, builder);
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

template <void (*Parser)(InputFile&, RawMeshBuilder&)>
bool runParser(std::string_view bytes, CellChoice cells)
{
  return parse(FuzzPlace::instance().write("mesh", bytes), cells, Parser);
}

bool runTetGen(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path nodes = place.write("tetgen/mesh.node", takeFile(bytes));
  const std::filesystem::path elements = place.write("tetgen/mesh.ele", bytes);
  return parse(bytes.size() % 2 ? nodes : elements, cells, importTetGen);
}

bool runVtkXml(std::string_view bytes, CellChoice cells)
{
  return parse(FuzzPlace::instance().write("mesh.vtu", bytes), cells, importVtkXml);
}

/** The file, then its pieces, which are called 0.vtu, 1.vtu and 2.vtu. */
bool runParallelVtkXml(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = place.write("pieces/mesh.pvtu", takeFile(bytes));
  for (const char* piece : { "pieces/0.vtu", "pieces/1.vtu", "pieces/2.vtu" })
  {
    place.write(piece, takeFile(bytes));
  }
  return parse(path, cells,
    [](InputFile& file, RawMeshBuilder& builder) { importParallelVtkXml(file, builder, {}); });
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

constexpr std::array Targets{ FuzzTarget{ "ply", runParser<importPly> },
  FuzzTarget{ "obj", runParser<importObj> }, FuzzTarget{ "off", runParser<importOff> },
  FuzzTarget{ "stl", runParser<importStl> }, FuzzTarget{ "medit", runParser<importMedit> },
  FuzzTarget{ "meshb", runParser<importBinaryMedit> }, FuzzTarget{ "gmsh", runParser<importGmsh> },
  FuzzTarget{ "tetgen", runTetGen }, FuzzTarget{ "vtk", runParser<importLegacyVtk> },
  FuzzTarget{ "vtu", runVtkXml }, FuzzTarget{ "pvtu", runParallelVtkXml },
  FuzzTarget{ "gzip", runGzip }, FuzzTarget{ "import", runImport },
  FuzzTarget{ "stream", runStream }, FuzzTarget{ "vsm", runVsm },
  FuzzTarget{ "problem", runProblem, true }, FuzzTarget{ "handles", runHandles, true },
  FuzzTarget{ "places", runPlaces, true }, FuzzTarget{ "solve", runSolve, true },
  FuzzTarget{ "checkpoint", runCheckpoint, true } };

} // namespace

std::span<const FuzzTarget> fuzzTargets()
{
  return Targets;
}

const FuzzTarget& fuzzTarget(std::string_view name)
{
  const auto found = std::ranges::find(Targets, name, &FuzzTarget::name);
  if (found == Targets.end())
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
