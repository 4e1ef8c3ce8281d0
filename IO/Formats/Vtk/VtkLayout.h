// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/ByteSource.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace smg
{

/** A list of cells in a VTK file. */
struct VtkCellList
{
  std::int64_t cells = 0;
  /** VTK's type of all cells, if there are no `types`. */
  int type = 0;
  std::optional<VtkArray> types;
  /** The points of the cells, cell by cell; without `offsets`, those of a cell are preceded by
   * their number. */
  std::optional<VtkArray> points;
  /** The end of each cell in `points`, with a leading 0 if there is one number more than cells. */
  std::optional<VtkArray> offsets;
};

/** Points and cells of a piece, with their attributes. */
struct VtkPiece
{
  std::size_t file = 0; ///< index in VtkLayout::files
  std::int64_t points = 0;
  std::int64_t cells = 0; ///< of all lists
  std::optional<VtkArray> positions;
  /** In the order in which VTK numbers the cells. All pieces of a layout have the same lists. */
  std::vector<VtkCellList> lists;
  std::vector<VtkArray> pointArrays, cellArrays;
  /** Names of the active normals and texture coordinates, and of the array of global numbers of
   * points; may be empty. */
  std::string pointNormals, cellNormals, pointTexture, globalIds;
};

/** Calls `visit` with each array of a piece. */
void forEachArray(auto& piece, const auto& visit)
{
  const auto visitOne = [&visit](auto& array)
  {
    if (array)
    {
      visit(*array);
    }
  };
  visitOne(piece.positions);
  std::ranges::for_each(piece.pointArrays, visit);
  std::ranges::for_each(piece.cellArrays, visit);
  for (auto& list : piece.lists)
  {
    visitOne(list.points);
    visitOne(list.offsets);
    visitOne(list.types);
  }
}

/** A file of a mesh, which may be a temporary one with the content of a compressed file. */
struct VtkFile
{
  explicit VtkFile(const InputFile& file)
    : path(file.path())
    , name(file.name())
  {
  }

  std::filesystem::path path;
  std::string name; ///< in error messages
};

/** The positions of all data of a mesh in its files. */
struct VtkLayout
{
  std::vector<VtkFile> files;
  std::vector<VtkPiece> pieces;
  std::set<std::string> otherArrays; ///< those of texts and bits, of the points and cells
  std::set<std::string> fields;      ///< arrays of the field data; see addFieldName()
  /** The text MeshGroups of the field data: its place, or itself. */
  std::optional<VtkArray> groupsArray;
  std::string groupsText;
  /** Names of several arrays of the points, or of the cells; see VtkArrayNames. */
  std::set<std::string> repeatedArrays;
  std::int64_t bytes = 0; ///< approximate memory of the pieces
  bool isPart = false;    ///< whether there are other, unread pieces, whose cells are omitted
};

/**
 * Finds the positions of all data in a legacy VTK file of polygonal data or of an unstructured
 * grid, text or binary, versions 1 to 5, without storing the data. Arrays of texts and bits are
 * omitted.
 * @throws Error with the byte position if the file is invalid, truncated, or has another kind of
 * data
 */
VtkLayout legacyVtkLayout(InputFile& file);

/**
 * The same of a .vtp or .vtu file: adds its pieces to the layout.
 * @param maxBytes of memory that the layout may take
 */
void addVtkXmlLayout(InputFile& file, VtkLayout& layout, std::int64_t maxBytes);

class RawMeshBuilder;

/**
 * Passes the mesh with a known layout to the builder: points, cells, and as columns the arrays that
 * all pieces have. Of several pieces, cells that belong to another piece (`vtkGhostType`) are
 * omitted, and points with the same global number are merged.
 * @param file the only file of the layout, or the one that names the files
 * @param progress of several files; otherwise `file` reports it
 * @throws Error with the position in a file; Cancelled
 */
SMG_EXPORT void readVtkMesh(InputFile& file, const VtkLayout& layout, RawMeshBuilder& builder,
  const ProgressFunction& progress = {});

/** Types of cells in VTK, which are the same in its files. */
namespace VtkCellTypes
{
inline constexpr int PolyVertex = 2, PolyLine = 4, Triangle = 5, TriangleStrip = 6, Polygon = 7,
                     Quadrilateral = 9, Tetrahedron = 10;
}

/** The files of a mesh, whose arrays are read concurrently, each through its own window. Only the
 * files of one piece are open. */
class VtkFiles
{
public:
  enum Window
  {
    Main,
    Offsets,
    Types,
    Ghosts,
    Labels,
    Windows
  };

  /** `first` is the only file of the layout, or the one that names the files. */
  VtkFiles(InputFile& first, const VtkLayout& layout, ProgressFunction progress = {})
    : First(first)
    , Layout(layout)
    , Report(std::move(progress))
  {
  }

  /** A file, through a window. Closes the previous file of the same window. */
  InputFile& open(std::size_t file, Window window);

  /** For several files: reports that this share of the whole is done. Throws Cancelled. */
  void progress(double done);

private:
  struct Opened
  {
    std::size_t file = 0;
    std::optional<InputFile> window;
  };

  InputFile& First;
  const VtkLayout& Layout;
  ProgressFunction Report;
  double Done = 0.0;
  std::array<Opened, Windows> Opens;
};

} // namespace smg
