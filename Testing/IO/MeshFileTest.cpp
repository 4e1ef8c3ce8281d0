// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/MeshFile.h"

#include "IO/Formats/Streams/StreamFile.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/FormatSuffixes.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestFolders.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <cstdlib>
#include <cstring>
#include <set>
#include <string>

#include <unistd.h>

namespace smg::testing
{
namespace
{

void expectRefused(const std::filesystem::path& out, const std::string& part)
{
  expectError([&] { checkOutput(out); }, out.filename().string() + part);
}

/** Expects the refusal in a process without write access to everything. */
void expectRefusedForStranger(const std::filesystem::path& out)
{
  if (::geteuid() == 0 && ::setuid(65534) != 0)
  {
    std::exit(1);
  }
  expectRefused(out, ": no file can be made in the folder");
  std::exit(::testing::Test::HasFailure() ? 1 : 0);
}

/** How a file is read: for example "PLY", "SMB" or "VSM". */
std::string readingOf(const std::filesystem::path& path)
{
  switch (kindOfInput(path))
  {
    case MeshFileKind::Vsm:
      return "VSM";
    case MeshFileKind::Stream:
      return std::string(nameOf(detectStreamFormat(path)));
    case MeshFileKind::Indexed:
      return std::string(formatOfFile(path)->name);
    default:
      return "nothing";
  }
}

/** The numbers of vertices and cells of a file; with the message if it is refused. */
std::string sizeOf(const std::filesystem::path& path)
{
  std::string size;
  const std::string message = messageOf(
    [&]
    {
      const auto mesh = openMesh(path);
      const auto& info = mesh->reader().info();
      size = std::to_string(info.vertices) + " and " + std::to_string(info.cells);
    });
  return size + message;
}

/** The suffixes of all formats, those that streaming formats alone have, and others. */
std::set<std::string> allSuffixes()
{
  std::set<std::string> suffixes = suffixesWhere([](auto&, auto&) { return true; });
  suffixes.insert({ "", ".xyz", ".smc", ".svc", ".SMA" });
  return suffixes;
}

/** Whether the content does not tell the format: then a name may lead to an error. */
bool saysNothing(const std::filesystem::path& seed)
{
  return seed.filename() == "no_keyword.off";
}

/** Expects a file to be read as the same format under every suffix that is chosen. */
void expectItself(
  const std::filesystem::path& seed, const std::filesystem::path& folder, Combinations& chosen)
{
  const std::string reading = readingOf(seed);
  const std::string size = sizeOf(seed);
  for (const std::string& suffix : allSuffixes())
  {
    if (!chosen.next())
    {
      continue;
    }
    const std::filesystem::path copy = folder / ("copy" + suffix);
    std::filesystem::copy_file(seed, copy, std::filesystem::copy_options::overwrite_existing);
    if (saysNothing(seed))
    {
      const std::string outcome = sizeOf(copy);
      const bool named = outcome.find((folder / "copy").string()) != std::string::npos;
      EXPECT_TRUE(outcome == size || named) << outcome;
      continue;
    }
    const std::string now = readingOf(copy);
    // Vertices and triangles alone are OBJ and SMA at once, and the same mesh in both.
    const bool mayBeBoth = (reading == "OBJ" || reading == "SMA") && (now == "OBJ" || now == "SMA");
    EXPECT_TRUE(now == reading || mayBeBoth) << seed << ' ' << reading << suffix << ' ' << now;
    EXPECT_EQ(sizeOf(copy), size) << seed << suffix;
  }
}

} // namespace

TEST(MeshFile, OutputsThatCannotBeWrittenAreRefused)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.vsm");
  EXPECT_NO_THROW(checkOutput(folder / "out.vsm"));
  EXPECT_NO_THROW(checkOutput("out.vsm"));
  expectRefused(folder / "out.xyz", ": meshes are written as");
  expectRefused(folder / "folder.vsm", ": this is a folder");
  expectRefused(folder / "absent" / "out.vsm", ": there is no folder");
}

TEST(MeshFile, CommentsMakeNoStream)
{
  const TemporaryFolder folder;
  writeBytes(folder / "a.node", "# c cube\n# f\n4 3 0 0\n1 0 0 0\n");
  EXPECT_EQ(kindOfInput(folder / "a.node"), MeshFileKind::Indexed);
  writeBytes(folder / "a.txt", "# nfaces 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(kindOfInput(folder / "a.txt"), MeshFileKind::Stream);
}

TEST(MeshFile, FoldersThatCannotBeWrittenToAreRefused)
{
  using std::filesystem::perms;
  const TemporaryFolder folder;
  for (const perms others : { perms::none, perms::others_exec, perms::others_read })
  {
    std::filesystem::permissions(folder.path(), perms::owner_read | perms::owner_exec | others);
    EXPECT_EXIT(expectRefusedForStranger(folder / "out.vsm"), ::testing::ExitedWithCode(0), "");
  }
  std::filesystem::permissions(folder.path(), perms::owner_all);
}

TEST(MeshFile, FilesAreReadAsThemselvesUnderEverySuffix)
{
  Combinations chosen;
  const TemporaryFolder folder;
  const auto corpus = sourceFolder() / "Testing" / "Fuzzing" / "corpus";
  for (const char* format :
    { "gmsh", "medit", "obj", "off", "ply", "stl", "stream", "vsm", "vtk", "vtu" })
  {
    for (const auto& entry : std::filesystem::directory_iterator(corpus / format))
    {
      // Seeds that are refused, and pieces of other files.
      if (entry.path().filename().string().starts_with("refused_") ||
          sizeOf(entry.path()).find(" and ") == std::string::npos)
      {
        continue;
      }
      expectItself(entry.path(), folder.path(), chosen);
    }
  }
}

TEST(MeshFile, TitlesOfStlFilesMakeNoOtherFormat)
{
  Combinations chosen;
  const TemporaryFolder folder;
  for (const char first : { '\0', '\1', '\2', '\3', '\4', 's', 'x' })
  {
    std::string stl(84 + 50, '\0');
    stl[0] = first;
    stl[80] = 1;
    constexpr float one = 1;
    std::memcpy(&stl[84 + 12 + 12], &one, sizeof(one));
    std::memcpy(&stl[84 + 12 + 24 + 4], &one, sizeof(one));
    writeBytes(folder / "title.stl", stl);
    ASSERT_EQ(sizeOf(folder / "title.stl"), "3 and 1");
    expectItself(folder / "title.stl", folder.path(), chosen);
  }
}

TEST(MeshFile, NamesDecideWhereContentIsUnknown)
{
  const TemporaryFolder folder;
  for (const char* content : { "nothing of the kind\n", "", "\4\4\4\4", "\x7f" })
  {
    writeBytes(folder / "a.vsm", content);
    writeBytes(folder / "a.smb", content);
    writeBytes(folder / "a.svc", content);
    writeBytes(folder / "a.ply", content);
    writeBytes(folder / "a", content);
    EXPECT_EQ(kindOfInput(folder / "a.vsm"), MeshFileKind::Vsm);
    EXPECT_EQ(kindOfInput(folder / "a.smb"), MeshFileKind::Stream);
    EXPECT_EQ(kindOfInput(folder / "a.svc"), MeshFileKind::Stream);
    EXPECT_EQ(kindOfInput(folder / "a.ply"), MeshFileKind::Indexed);
    EXPECT_EQ(kindOfInput(folder / "a"), MeshFileKind::Unknown);
  }
}

} // namespace smg::testing
