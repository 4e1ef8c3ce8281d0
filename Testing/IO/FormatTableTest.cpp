// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "IO/Files/Decompressor.h"
#include "Testing/Support/FormatSuffixes.h"
#include "Testing/Support/TestFolders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
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

/** The suffixes, with dots, in the first hint of the proxies of a file of the plugin, from the
 * proxy `name` on. */
std::set<std::string> suffixesOfProxy(
  const std::string& file, const std::string& hint, const std::string& name = "")
{
  const std::string text = textOf("ParaViewPlugin/StreamingMultigrid/" + file);
  const std::string begin = "<" + hint + " extensions=\"";
  const std::size_t at = text.find(begin, text.find("name=\"" + name));
  EXPECT_NE(at, std::string::npos) << file;
  std::istringstream words(
    text.substr(at + begin.size(), text.find('"', at + begin.size()) - at - begin.size()));
  std::set<std::string> suffixes;
  for (std::string word; words >> word;)
  {
    suffixes.insert('.' + word);
  }
  return suffixes;
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
    ".vsm, .sva, .svb, .mesh, .msh, .node, .ele, .vtk, .vtu, .vtkhdf or .hdf");
  EXPECT_EQ(suffixFor(FormatUse::Write, "a.pvtu"), nullptr);
  EXPECT_EQ(suffixFor(FormatUse::Write, "a.ply.gz"), nullptr);
  EXPECT_EQ(suffixFor(FormatUse::Restore, "A.OBJ")->text, ".obj");
  EXPECT_EQ(suffixFor(FormatUse::WriteColumns, "a.sma"), nullptr);
  EXPECT_EQ(suffixList(FormatUse::RestoreColumns, "or"), ".ply, .vtk, .vtp or .vtu");
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

TEST(FormatTable, ParaViewOffersItsFormats)
{
  const auto isStream = [](auto& format, auto&) { return format.kind != MeshFileKind::Indexed; };
  EXPECT_EQ(suffixesOfProxy("StreamingMeshReader.xml", "ReaderFactory"), suffixesWhere(isStream));
  // What ParaView writes, too, is ours where a preview is shown; later versions write VTKHDF.
  const auto isOfVtk = [](const Format& format, const FileSuffix& suffix)
  { return format.isReadByVtk || suffix.text == ".vtkhdf"; };
  std::set<std::string> saved = suffixesOfProxy("BigMeshWriter.xml", "WriterFactory");
  saved.merge(suffixesOfProxy("BigMeshWriter.xml", "WriterFactory", "BigMeshPieces"));
  EXPECT_EQ(saved, suffixesWhere(isOfVtk));
  // A file .hdf may be anything.
  const auto isWritten = [&](auto& format, auto& suffix)
  { return format.bytes && !isOfVtk(format, suffix) && suffix.text != ".hdf"; };
  EXPECT_EQ(suffixesOfProxy("StreamingMeshWriter.xml", "WriterFactory"), suffixesWhere(isWritten));
  // Only one file of TetGen is opened; ParaView reads the pieces.
  const auto isOpened = [](const Format& format, const FileSuffix& suffix)
  {
    return format.parse && &format != formatOfSuffix(".pvtu") && suffix.text != ".ele" &&
           suffix.text != ".hdf";
  };
  // Files that may be text are compressed; others are so by themselves.
  const auto isText = [&](auto& format, auto& suffix)
  { return isOpened(format, suffix) && suffix.form != FileForm::Binary; };
  std::set<std::string> opened = suffixesWhere(isOpened);
  for (const std::string& suffix : suffixesWhere(isText))
  {
    for (const std::string_view compressed : CompressedSuffixes)
    {
      opened.insert(suffix + std::string(compressed));
    }
  }
  EXPECT_EQ(suffixesOfProxy("StreamingMeshConverter.xml", "ReaderFactory"), opened);
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
