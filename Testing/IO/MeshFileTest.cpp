// SPDX-License-Identifier: BSD-3-Clause
#include "IO/AnyFormat/MeshFile.h"

#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <cstdlib>

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

} // namespace smg::testing
