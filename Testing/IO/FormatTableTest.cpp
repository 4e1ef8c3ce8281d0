// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "IO/Files/Decompressor.h"
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

template <class Test>
std::set<std::string> suffixesWhere(Test&& test)
{
  std::set<std::string> suffixes;
  for (const Format* format : formats())
  {
    for (const FileSuffix& suffix : format->suffixes)
    {
      if (test(*format))
      {
        suffixes.emplace(suffix.text);
      }
    }
  }
  return suffixes;
}

} // namespace

TEST(FormatTable, SuffixesAreOfOneFormatEach)
{
  std::set<std::string_view> seen;
  for (const Format* format : formats())
  {
    EXPECT_FALSE(format->name.empty() || format->attributes.empty());
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
  const auto isOwn = [](const Format& format) { return format.kind != MeshFileKind::Indexed; };
  EXPECT_EQ(suffixesOfProxy("StreamingMeshReader.xml", "ReaderFactory"), suffixesWhere(isOwn));
  std::set<std::string> alone = suffixesWhere(isOwn);
  alone.insert({ ".off", ".mesh", ".msh", ".node", ".ele" }); // of which ParaView has no writer
  EXPECT_EQ(suffixesOfProxy("StreamingMeshWriter.xml", "WriterFactory"), alone);
  // Only one file of TetGen is opened; .hdf may be anything; ParaView reads the pieces.
  std::set<std::string> parsed = suffixesWhere([](const Format& format) { return format.parse; });
  std::set<std::string> offered = suffixesOfProxy("StreamingMeshConverter.xml", "ReaderFactory");
  for (const char* suffix : { ".ele", ".hdf", ".pvtp", ".pvtu" })
  {
    EXPECT_EQ(parsed.erase(suffix), 1u);
  }
  // Files that may be text are compressed; others are so by themselves.
  for (const std::string& suffix : std::set<std::string>(parsed))
  {
    const Format& format = *formatOfSuffix(suffix);
    if (std::ranges::find(format.suffixes, std::string_view(suffix), &FileSuffix::text)->form !=
        FileForm::Binary)
    {
      for (const std::string_view compressed : CompressedSuffixes)
      {
        parsed.insert(suffix + std::string(compressed));
      }
    }
  }
  EXPECT_EQ(offered, parsed);
  std::set<std::string> written = suffixesWhere(
    [&](const Format& format) { return !isOwn(format) && format.isStreamed() && format.bytes; });
  EXPECT_EQ(written.erase(".hdf"), 1u);
  written.insert({ ".pvtp", ".pvtu" });
  written.insert(
    { ".obj", ".stl", ".vtk" }); // which ParaView writes, too, and would of the preview
  std::set<std::string> saved = suffixesOfProxy("BigMeshWriter.xml", "WriterFactory");
  saved.merge(suffixesOfProxy("BigMeshWriter.xml", "WriterFactory", "BigMeshPieces"));
  EXPECT_EQ(saved, written);
}

TEST(FormatTable, DocumentsNameItsFormats)
{
  const std::string text = textOf("docs/formats.md");
  for (const Format* format : formats())
  {
    const bool named =
      text.find(format->name) != std::string::npos ||
      std::ranges::all_of(format->suffixes, [&](const FileSuffix& suffix)
        { return text.find('`' + std::string(suffix.text) + '`') != std::string::npos; });
    EXPECT_TRUE(named) << format->name;
  }
}

} // namespace smg::testing
