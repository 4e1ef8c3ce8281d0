// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Import/GroupTable.h"
#include "IO/Mesh/GroupsJson.h"
#include "Testing/IO/ImportFixture.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

// Big assemblies: the table of the groups has any size.

namespace smg::testing
{
namespace
{

constexpr int Parts = 20000;
constexpr std::size_t NameBytes = 200;

std::string nameOfPart(int part)
{
  return "part " + std::to_string(part) + ' ' + std::string(NameBytes, 'x');
}

/** A strip of triangles, each of which is a part with a name. */
std::string stripOfParts(int parts)
{
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  text += std::to_string(parts) + '\n';
  for (int part = 1; part <= parts; ++part)
  {
    text += "2 " + std::to_string(part) + " \"" + nameOfPart(part) + "\"\n";
  }
  text += "$EndPhysicalNames\n$Nodes\n" + std::to_string(parts + 2) + '\n';
  for (int node = 1; node <= parts + 2; ++node)
  {
    text += std::to_string(node) + ' ' + std::to_string(node / 2) + ' ' + std::to_string(node % 2) +
            " 0\n";
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(parts) + '\n';
  for (int part = 1; part <= parts; ++part)
  {
    text += std::to_string(part) + " 2 2 " + std::to_string(part) + " 1 ";
    for (int k = 0; k < 3; ++k)
    {
      text += std::to_string(part + k) + (k < 2 ? " " : "\n");
    }
  }
  return text + "$EndElements\n";
}

/** How many cells each group has, by its name. */
std::map<std::string, int> cellsOf(const std::filesystem::path& vsm)
{
  const VsmReader reader(vsm);
  const MeshGroups& groups = reader.info().groups;
  std::map<std::string, int> cells;
  const auto source = reader.source({}, { CellGroupsName });
  for (MeshBlock block; source->next(block);)
  {
    for (const GroupSet set : std::as_const(block.cellColumns.front()).as<GroupSet>())
    {
      for (const std::uint32_t group : groups.sets.at(set))
      {
        ++cells[groups.groups[group].name];
      }
    }
  }
  return cells;
}

using ManyGroups = ImportFixture;

} // namespace

TEST_F(ManyGroups, HaveTheirNamesInEveryFile)
{
  writeBytes(this->Folder / "in.msh", stripOfParts(Parts));
  convert(this->Folder / "in.msh", this->Folder / "mesh.vsm");
  std::map<std::string, int> expected;
  for (int part = 1; part <= Parts; ++part)
  {
    expected[nameOfPart(part)] = 1;
  }
  ASSERT_EQ(cellsOf(this->Folder / "mesh.vsm"), expected);
  for (const char* name : { "a.msh", "a.vtk", "text.vtk", "a.vtu", "a.vtkhdf" })
  {
    SCOPED_TRACE(name);
    writeFromVsm(this->Folder / "mesh.vsm", this->Folder / name, {}, {},
      std::string(name).starts_with("text"));
    convert(this->Folder / name, this->Folder / "again.vsm");
    EXPECT_EQ(cellsOf(this->Folder / "again.vsm"), expected);
  }
}

TEST_F(ManyGroups, OfOlderFilesAreInTheHeader)
{
  writeBytes(this->Folder / "in.msh", stripOfParts(20));
  convert(this->Folder / "in.msh", this->Folder / "new.vsm");
  {
    BlockFileReader in(this->Folder / "new.vsm");
    std::vector<TableSpec> tables = in.tables();
    ASSERT_EQ(tables.size(), std::size_t(VsmFormat::Groups) + 1);
    tables.pop_back();
    BlockFileWriter out(this->Folder / "old.vsm", tables, Codec::Lz4);
    for (int table = 0; table < VsmFormat::Groups; ++table)
    {
      for (std::int64_t block = 0; block < in.blocks(table); ++block)
      {
        std::vector<std::vector<std::byte>> columns(tables[std::size_t(table)].columns.size());
        for (std::size_t c = 0; c < columns.size(); ++c)
        {
          columns[c].resize(in.columnBytes(table, block, int(c)));
          in.read(table, block, int(c), columns[c]);
        }
        const std::vector<std::span<const std::byte>> spans(columns.begin(), columns.end());
        out.append(table, in.blockRows(table, block), spans);
      }
    }
    nlohmann::json header = nlohmann::json::parse(in.header());
    EXPECT_FALSE(header.contains("groups"));
    header.update(jsonOf(VsmReader(this->Folder / "new.vsm").info().groups));
    out.finish(header.dump());
  }
  EXPECT_EQ(cellsOf(this->Folder / "old.vsm"), cellsOf(this->Folder / "new.vsm"));
}

TEST_F(ManyGroups, BeyondTheNumbersOfSetsAreLeftOutWithANote)
{
  GroupTable table;
  for (int number = 1; number <= 65535; ++number)
  {
    ASSERT_NE(table.numbered(2, number), GroupTable::None);
  }
  EXPECT_FALSE(table.overflowed());
  EXPECT_EQ(table.numbered(2, 65536), GroupTable::None);
  EXPECT_TRUE(table.overflowed());
  EXPECT_EQ(table.finish(CellType::Triangle).groups.size(), 65535U);
  MeshGroups groups = table.finish(CellType::Triangle);
  groups.sets.push_back({ 0, 1 });
  EXPECT_THROW(groupsOfText(textOf(groups)), MeshError);
}

TEST(GroupTable, ALargerGroupHasTheMembersOfItsParts)
{
  GroupTable table;
  table.include(2, 1, "left");
  table.include(2, 2, "right");
  const GroupSet all = table.named(2, "all");
  ASSERT_NE(all, GroupTable::None);
  const MeshGroups groups = table.finish(CellType::Triangle);
  const GroupSet one = table.numbered(2, 1);
  ASSERT_EQ(groups.sets[one].size(), 2U);
  EXPECT_EQ(groups.groups[groups.sets[one][1]].name, "left");
}

} // namespace smg::testing
