// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/Support/TestFolders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

std::string textOf(const std::string& file)
{
  std::ifstream stream(sourceFolder() / file);
  EXPECT_TRUE(stream) << file;
  return { std::istreambuf_iterator<char>(stream), {} };
}

/** In what form files are written, if it is one. */
std::string formOf(const Format& format)
{
  const auto isAs = [&](FileForm form)
  {
    return std::ranges::all_of(
      format.suffixes, [form](const FileSuffix& suffix) { return suffix.form == form; });
  };
  return isAs(FileForm::Either) ? "binary, or text with `--text`"
         : isAs(FileForm::Text) ? "text"
                                : "yes";
}

/** The table of docs/formats.md. */
std::string documentedTable()
{
  std::string table = "| format | suffixes | cells | all columns | written | restored |\n"
                      "|---|---|---|---|---|---|\n";
  for (const Format* format : formats())
  {
    std::string suffixes;
    for (const FileSuffix& suffix : format->suffixes)
    {
      suffixes += (suffixes.empty() ? "`" : ", `") + std::string(suffix.text) + '`';
    }
    table += "| " + std::string(format->name) + ": " + std::string(format->description) + " | " +
             suffixes + " | " + std::string(format->cells) +
             (!format->holdsColumns   ? " | |"
               : format->isStreamed() ? " | with `OriginalId` |"
                                      : " | yes |");
    for (const FormatUse use : { FormatUse::Write, FormatUse::Restore })
    {
      const bool can = suffixFor(use, "mesh" + std::string(format->suffixes[0].text));
      table += (can ? ' ' + formOf(*format) : "") + " |";
    }
    table += '\n';
  }
  return table;
}

} // namespace

TEST(FormatTable, SuffixesAreOfOneFormatEach)
{
  std::set<std::string_view> seen;
  for (const Format* format : formats())
  {
    EXPECT_FALSE(format->name.empty() || format->description.empty() || format->cells.empty());
    for (const FileSuffix& suffix : format->suffixes)
    {
      EXPECT_TRUE(seen.insert(suffix.text).second) << suffix.text;
      EXPECT_EQ(formatOfSuffix(suffix.text), format);
      EXPECT_TRUE(suffix.triangles || suffix.tetrahedra);
    }
    EXPECT_TRUE(format->parse || format->kind != MeshFileKind::Indexed) << format->name;
    EXPECT_FALSE(format->writer && format->writeVsm) << format->name;
    const bool isWritten = format->writer || format->writeVsm || format->kind == MeshFileKind::Vsm;
    EXPECT_EQ(format->bytes != nullptr, isWritten) << format->name;
  }
  EXPECT_EQ(formatOfName("A.PLY.gz"), formatOfSuffix(".ply"));
  EXPECT_EQ(formatOfName("a.xyz"), nullptr);
}

TEST(FormatTable, ListsFollowFromIt)
{
  EXPECT_EQ(suffixList(FormatUse::Write, CellType::Tetrahedron, "or"),
    ".vsm, .sva, .svb, .mesh, .msh, .node, .ele, .inp, .e, .exo, .ex2, .g, .vtk, "
    ".vtu, .vtkhdf or .hdf");
  EXPECT_EQ(suffixFor(FormatUse::Write, "a.pvtu"), nullptr);
  EXPECT_EQ(suffixFor(FormatUse::Write, "a.ply.gz"), nullptr);
  EXPECT_EQ(suffixFor(FormatUse::Restore, "A.OBJ")->text, ".obj");
  EXPECT_EQ(suffixFor(FormatUse::WriteColumns, "a.sma"), nullptr);
  EXPECT_EQ(suffixList(FormatUse::RestoreColumns, "or"),
    ".ply, .msh, .e, .exo, .ex2, .g, .vtk, .vtp or .vtu");
  using Names = std::vector<std::string>;
  EXPECT_TRUE(restoresColumns("a.vtu", Names{ "any" }));
  EXPECT_TRUE(restoresColumns("a.OBJ", Names{ "Colors" }));
  EXPECT_TRUE(restoresColumns("a.obj", Names{ "Colors", "Normals" }));
  EXPECT_FALSE(restoresColumns("a.obj", Names{ "Colors", "Reference" }));
  EXPECT_TRUE(restoresColumns("a.off", Names{ "Colors", "Normals", "TextureCoordinates" }));
  EXPECT_FALSE(restoresColumns("a.vsm", Names{ "Colors" }));
  EXPECT_FALSE(restoresColumns("a.stl", Names{ "Colors" }));
  EXPECT_FALSE(restoresColumns("a", Names{ "Colors" }));
}

TEST(FormatTable, ItsDocumentIsUpToDate)
{
  const std::string table = "<!-- formats -->\n" + documentedTable() + "<!-- end -->\n";
  EXPECT_TRUE(textOf("docs/formats.md").find(table) != std::string::npos)
    << "docs/formats.md should have:\n"
    << table;
}

// Scripts that say that they try every format.
TEST(FormatTable, ListsInTestsAreComplete)
{
  const std::string estimates = textOf("Testing/Examples/smg_estimates.py"),
                    readers = textOf("Testing/Examples/mesh_files.py");
  for (const Format* format : formats())
  {
    const std::string suffix(format->suffixes[0].text.substr(1));
    EXPECT_TRUE(!format->bytes || estimates.find('"' + suffix + '"') != std::string::npos)
      << "smg_estimates.py: " << suffix;
    EXPECT_TRUE(!format->writer || format->furtherOutputs ||
                readers.find("\"." + suffix + '"') != std::string::npos)
      << "mesh_files.py: " << suffix;
  }
}

} // namespace smg::testing
