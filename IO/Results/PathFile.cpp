// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/PathFile.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/TextOutput.h"
#include "smg/Error.h"

#include <cstddef>
#include <string_view>
#include <vector>

// Polylines in text: the paths are few, and people look into them.

namespace smg
{

namespace
{

using Paths = std::vector<const Report::Path*>;

void writePoints(TextOutput& out, const Paths& paths, std::string_view prefix)
{
  for (const Report::Path* path : paths)
  {
    for (const auto& point : path->points)
    {
      out << prefix;
      out.position(point, true);
      out << '\n';
    }
  }
}

/** The numbers of the points of each path, from `first` on. */
void writeNumbers(TextOutput& out, const Paths& paths, std::string_view prefix, std::size_t first)
{
  for (const Report::Path* path : paths)
  {
    out << prefix;
    for (std::size_t k = 0; k < path->points.size(); ++k)
    {
      out << (k > 0 ? " " : "") << first++;
    }
    out << '\n';
  }
}

void writeObj(TextOutput& out, Paths paths)
{
  // A line has two points at least.
  std::erase_if(paths, [](const Report::Path* path) { return path->points.size() < 2; });
  writePoints(out, paths, "v ");
  writeNumbers(out, paths, "l ", 1);
}

void writeVtp(TextOutput& out, const Paths& paths)
{
  const auto array = [&](std::string_view type, std::string_view name, auto write)
  {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" format=\"ascii\">\n";
    write();
    out << "</DataArray>\n";
  };
  const auto ofEach = [&](std::string_view type, std::string_view name, auto valueOf)
  {
    array(type, name,
      [&]
      {
        for (const Report::Path* path : paths)
        {
          out << valueOf(*path) << '\n';
        }
      });
  };
  std::size_t points = 0;
  for (const Report::Path* path : paths)
  {
    points += path->points.size();
  }
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
         "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\""
      << points << "\" NumberOfVerts=\"0\" NumberOfLines=\"" << paths.size()
      << "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<CellData>\n";
  ofEach("Int64", "To", [](const Report::Path& path) { return path.to; });
  ofEach("Int64", "From", [](const Report::Path& path) { return path.from; });
  ofEach("Float64", "Length", [](const Report::Path& path) { return path.length; });
  out << "</CellData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">\n";
  writePoints(out, paths, "");
  out << "</DataArray>\n</Points>\n<Lines>\n";
  array("Int64", "connectivity", [&] { writeNumbers(out, paths, "", 0); });
  std::size_t end = 0;
  ofEach(
    "Int64", "offsets", [&end](const Report::Path& path) { return end += path.points.size(); });
  out << "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace

void checkPathFile(const std::filesystem::path& file)
{
  const std::string suffix = lowerSuffix(file);
  if (suffix != ".vtp" && suffix != ".obj")
  {
    throw Error(file.string() + ": the file of paths must be a .vtp or an .obj file.");
  }
}

void writePaths(const std::filesystem::path& file, std::span<const Report::Path> paths)
{
  checkPathFile(file);
  Paths found;
  for (const Report::Path& path : paths)
  {
    if (!path.points.empty())
    {
      found.push_back(&path);
    }
  }
  TextOutput out(file);
  lowerSuffix(file) == ".obj" ? writeObj(out, found) : writeVtp(out, found);
  out.finish();
}

} // namespace smg
