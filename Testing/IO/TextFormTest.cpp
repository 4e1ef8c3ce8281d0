// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/RestoredMeshFixture.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "smg/Convert.h"
#include "smg/Simplify.h"
#include "smg/WriteMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

// The law of formats with a binary and a text form: both are the same mesh, whichever way a file is
// written. Formats of text alone are the same with and without the wish for text, and formats of
// binary files refuse it.

namespace smg::testing
{
namespace
{

class TextForm : public RestoredMeshFixture
{
protected:
  /** Calls `use` with each suffix that is written, and each kind of cells that it holds. */
  static void forEachSuffix(const std::function<void(const FileSuffix&, CellType)>& use)
  {
    for (const Format* format : formats())
    {
      for (const FileSuffix& suffix : format->suffixes)
      {
        const bool isWritten = suffixFor(FormatUse::Write, "mesh" + std::string(suffix.text));
        for (const CellType cells : { CellType::Triangle, CellType::Tetrahedron })
        {
          if (isWritten && suffix.holds(cells))
          {
            SCOPED_TRACE(std::string(suffix.text) +
                         (cells == CellType::Triangle ? " triangles" : " tetrahedra"));
            use(suffix, cells);
          }
        }
      }
    }
  }

  /** Writes a file of this suffix in a way of its own. */
  using Write = std::function<void(const std::filesystem::path& path, bool text)>;

  /** Checks what the wish for text does to a file. `precise`: coordinates are doubles. */
  void check(const FileSuffix& suffix, const Write& write, bool precise)
  {
    const std::filesystem::path plain = this->Folder / ("plain" + std::string(suffix.text)),
                                text = this->Folder / ("text" + std::string(suffix.text));
    if (suffix.form == FileForm::Binary)
    {
      expectError([&] { write(text, true); }, "file is not written as text");
      EXPECT_FALSE(std::filesystem::exists(text));
      return;
    }
    write(plain, false);
    write(text, true);
    const std::string bytes = readFile(text);
    for (const char c : bytes)
    {
      ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
    }
    if (suffix.form == FileForm::Text)
    {
      EXPECT_TRUE(bytes == readFile(plain));
      return;
    }
    expectSameMesh(importWhole(text), importWhole(plain), precise);
  }

private:
  static void expectSameMesh(const ReadMesh& text, const ReadMesh& binary, bool precise)
  {
    const auto singles = [](const std::vector<double>& numbers)
    { return std::vector<float>(numbers.begin(), numbers.end()); };
    if (precise)
    {
      EXPECT_EQ(text.positions, binary.positions);
    }
    // The text of a float is a number whose nearest float it is.
    EXPECT_EQ(singles(text.positions), singles(binary.positions));
    EXPECT_EQ(text.corners, binary.corners);
    expectSame(text.vertexColumns, binary.vertexColumns);
    expectSame(text.elementColumns, binary.elementColumns);
  }
};

/** Numbers that need all their digits, and such as are no numbers. */
void addExtremes(MeshOfFile& mesh)
{
  using Double = std::numeric_limits<double>;
  Column column{ { "extremes", ScalarType::Float64, 2 }, {} };
  column.resize(static_cast<std::size_t>(mesh.vertices()));
  const std::vector<double> extremes{ Double::max(), -Double::max(), Double::min(),
    Double::denorm_min(), Double::infinity(), -Double::infinity(), Double::quiet_NaN(), -0.0,
    0.1 + 0.2, 1.0 / 3, 1e22, 123456789012345678.0 };
  std::size_t k = 0;
  for (double& value : column.as<double>())
  {
    value = extremes[k++ % extremes.size()];
  }
  mesh.vertexColumns.push_back(column);
}

TEST_F(TextForm, IsTheMeshOfTheBinaryForm)
{
  forEachSuffix(
    [this](const FileSuffix& suffix, CellType cells)
    {
      if (!suffixFor(FormatUse::Restore, "mesh" + std::string(suffix.text)))
      {
        return;
      }
      for (const bool precise : { true, false })
      {
        MeshOfFile mesh = randomMeshOfFile(cells, 9, precise);
        addExtremes(mesh);
        writeVsmOf(mesh, this->Folder / "mesh.vsm", 1);
        this->check(
          suffix,
          [this](const std::filesystem::path& path, bool text)
          {
            Workspace workspace(this->Folder.path(), Workspace::MinMemory);
            writeRestored(this->Folder / "mesh.vsm", path, workspace, text);
          },
          precise);
      }
    });
}

TEST_F(TextForm, OfAStreamIsTheMeshOfTheBinaryForm)
{
  forEachSuffix(
    [this](const FileSuffix& suffix, CellType cells)
    {
      for (const bool precise : { true, false })
      {
        MeshOfFile mesh = randomMeshOfFile(cells, 3, precise);
        addExtremes(mesh);
        writeVsmOf(mesh, this->Folder / "mesh.vsm", 1);
        this->check(
          suffix,
          [this](const std::filesystem::path& path, bool text)
          {
            const auto source = VsmReader(this->Folder / "mesh.vsm").source();
            writeMesh(*source, path, { .text = text });
            const std::string bytes = readFile(path);
            writeFromVsm(this->Folder / "mesh.vsm", path, {}, {}, text);
            // Isolated vertices are what the two differ in, which a .vsm file alone has.
            EXPECT_TRUE(path.extension() == ".vsm" || bytes == readFile(path));
          },
          precise);
      }
    });
}

TEST_F(TextForm, NumbersThatVtkDoesNotReadAreSaid)
{
  forEachSuffix(
    [this](const FileSuffix& suffix, CellType cells)
    {
      for (const bool areExtreme : { true, false })
      {
        MeshOfFile mesh = randomMeshOfFile(cells, 3, true);
        if (areExtreme)
        {
          addExtremes(mesh);
        }
        writeVsmOf(mesh, this->Folder / "mesh.vsm", 1);
        const std::filesystem::path file = this->Folder / ("said" + std::string(suffix.text));
        for (const bool text : { false, true })
        {
          if (suffix.text == ".vsm" || (text && suffix.form == FileForm::Binary))
          {
            continue;
          }
          const std::vector<std::string> notes =
            writeFromVsm(this->Folder / "mesh.vsm", file, {}, {}, text);
          const bool isSaid = std::ranges::any_of(notes, [](const std::string& note)
            { return note.find("NaN or infinite: VTK") != std::string::npos; });
          EXPECT_EQ(isSaid, areExtreme && text && suffix.text == ".vtk");
        }
      }
    });
}

TEST_F(TextForm, OfOtherDoorsIsThatOfWriteMesh)
{
  forEachSuffix(
    [this](const FileSuffix& suffix, CellType cells)
    {
      writeVsmOf(randomMeshOfFile(cells, 3, true), this->Folder / "mesh.vsm", 1);
      const std::filesystem::path file = this->Folder / ("mesh" + std::string(suffix.text));
      if (suffix.text == ".vsm")
      {
        return;
      }
      this->check(
        suffix,
        [&](const std::filesystem::path& path, bool text)
        {
          ConversionOptions options;
          options.text = text;
          convert(this->Folder / "mesh.vsm", path, options);
        },
        true);
      if (suffix.form != FileForm::Binary && cells == CellType::Triangle)
      {
        const VsmReader reader(this->Folder / "mesh.vsm");
        this->check(
          suffix,
          [&](const std::filesystem::path& path, bool text)
          { simplify(reader, { .vertices = 40 }, path, { .text = text }); },
          true);
      }
      // A PLY file is written again with other positions.
      if (suffix.text == ".ply")
      {
        writeFromVsm(this->Folder / "mesh.vsm", file);
        const auto moved = openMesh(file);
        this->check(
          suffix,
          [&](const std::filesystem::path& path, bool text)
          {
            RewriteOptions options;
            options.text = text;
            rewriteMesh(file, path, *moved->source({ "OriginalId" }, {}), options);
          },
          true);
      }
    });
}

TEST_F(TextForm, FormatsWithBothAreThoseThatAreDocumented)
{
  std::string both;
  forEachSuffix(
    [&both](const FileSuffix& suffix, CellType cells)
    {
      if (suffix.form == FileForm::Either && cells == CellType::Triangle)
      {
        both += std::string(suffix.text) + ' ';
      }
    });
  EXPECT_EQ(both, ".ply .stl .vtk ");
}

} // namespace
} // namespace smg::testing
