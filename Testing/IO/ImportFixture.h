// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Mesh/Columns.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace smg::testing
{

/** Appends the bytes of a value, in the other byte order if `big`. */
template <class T>
void put(std::string& bytes, T value, bool big = false)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  bytes.append(raw, sizeof(T));
}

using Numbers = std::vector<std::int64_t>;

/** Imports files with the given bytes. */
class ImportFixture : public ::testing::Test
{
protected:
  ReadMesh read(const std::string& name, std::string_view bytes,
    CellChoice cells = CellChoice::Only, std::int64_t memory = Workspace::MinMemory)
  {
    writeBytes(this->Folder / name, bytes);
    return this->readFile(this->Folder / name, cells, memory);
  }

  ReadMesh readFile(const std::filesystem::path& path, CellChoice cells = CellChoice::Only,
    std::int64_t memory = Workspace::MinMemory)
  {
    Workspace workspace(this->Folder.path(), memory);
    ImportOptions options;
    options.cells = cells;
    const Looked looked = this->lookAt(path, options, memory);
    const RawMesh mesh = importMesh(path, workspace, options);
    EXPECT_LE(workspace.pool().peak(), memory);
    expectLooked(looked, mesh, formatOfFile(path));
    return readRaw(mesh);
  }

  /** What a look at a file tells. */
  struct Looked
  {
    StreamInfo mesh;
    std::string error; ///< empty: none
  };
  Looked lookAt(const std::filesystem::path& path, const ImportOptions& options,
    std::int64_t memory = Workspace::MinMemory)
  {
    Workspace workspace(this->Folder.path(), memory);
    Looked looked;
    looked.error = messageOf([&] { looked.mesh = lookAtMesh(path, workspace, options); });
    EXPECT_LE(workspace.pool().peak(), memory);
    return looked;
  }

  /** Expects that a look at a file of the format told what the mesh is. */
  static void expectLooked(const Looked& looked, const RawMesh& mesh, const Format* format)
  {
    EXPECT_EQ(looked.error, "");
    EXPECT_EQ(looked.mesh.cellType, mesh.cellType);
    EXPECT_EQ(looked.mesh.doublePositions, mesh.doublePositions);
    // Only formats that may hold solids are looked at, see statedMesh().
    if (format && std::ranges::any_of(format->suffixes, &FileSuffix::tetrahedra))
    {
      expectColumns(looked.mesh.vertexColumns, mesh.vertexColumns, format);
      expectColumns(looked.mesh.cellColumns, mesh.elementColumns, format);
    }
  }
  /** But for those of labels and data of Gmsh, which only the whole file tells. */
  static void expectColumns(const std::vector<ColumnSpec>& looked,
    const std::vector<RawColumn>& columns, const Format* format)
  {
    std::vector<ColumnSpec> told = looked, all;
    for (const RawColumn& column : columns)
    {
      all.push_back(column.spec);
    }
    const auto areLabels = [format](const ColumnSpec& column)
    {
      return (format == &GmshFormat && isReal(column.type)) || column.name == ReferenceName ||
             column.name == PhysicalTagName || column.name == GeometricalTagName ||
             isGroupColumn(column.name);
    };
    std::erase_if(told, areLabels);
    std::erase_if(all, areLabels);
    EXPECT_EQ(told, all);
  }

  /** The message of the Error; empty if there is none. */
  std::string errorOf(const std::string& name, std::string_view bytes)
  {
    return messageOf([&] { this->read(name, bytes); });
  }
  void expectError(const std::string& name, std::string_view bytes, const std::string& part)
  {
    const std::string message = this->errorOf(name, bytes);
    EXPECT_NE(message.find((this->Folder / name).string()), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << "got: '" << message << "'";
  }

  /** Expects the file to be refused with an Error, or read as a valid mesh. */
  void expectRefusedOrValid(const std::string& name, std::string_view bytes)
  {
    try
    {
      expectValid(this->read(name, bytes));
    }
    catch (const Error& error)
    {
      ASSERT_NE(std::string(error.what()).find((this->Folder / name).string()), std::string::npos)
        << error.what();
    }
  }

  /** The same for the file truncated at every byte, and with changed bytes. */
  void expectDamageIsFound(const std::string& name, const std::string& bytes, int changes = 400)
  {
    Combinations combinations;
    for (std::size_t length = 0; length < bytes.size(); ++length)
    {
      if (!combinations.next())
      {
        continue;
      }
      this->expectRefusedOrValid(name, std::string_view(bytes).substr(0, length));
    }
    Random random(7);
    for (int i = 0; i < changes; ++i)
    {
      if (!combinations.next())
      {
        continue;
      }
      std::string damaged = bytes;
      for (int k = 0; k < 1 + i % 4; ++k)
      {
        const auto place =
          static_cast<std::size_t>(random.below(static_cast<std::int64_t>(damaged.size())));
        damaged[place] =
          i % 2 ? static_cast<char>(random.below(256)) : "0123456789-.e \n"[random.below(15)];
      }
      this->expectRefusedOrValid(name, damaged);
    }
  }

  TemporaryFolder Folder;
};

} // namespace smg::testing
