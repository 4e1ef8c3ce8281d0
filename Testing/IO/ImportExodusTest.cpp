// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/ImportFixture.h"

#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

/** Writes a classic netCDF file: dimensions, then variables with their values. */
class NetCdfBytes
{
public:
  explicit NetCdfBytes(int version)
    : Version(version)
  {
  }

  /** 0: the number of records. */
  void dimension(const std::string& name, std::int64_t extent)
  {
    this->Names.push_back(name);
    this->Extents.push_back(extent);
  }
  template <class T>
  void variable(const std::string& name, const std::vector<std::string>& dimensions,
    const std::vector<T>& values, const std::string& elementType = "")
  {
    Variable& variable =
      this->Variables.emplace_back(Variable{ name, dimensions, typeOf(T()), {}, elementType });
    for (const T value : values)
    {
      put(variable.bytes, value, true);
    }
    variable.size = sizeof(T);
  }
  /** A list of names, of eight characters each. */
  void names(
    const std::string& name, const std::string& dimension, const std::vector<std::string>& names)
  {
    std::vector<char> all;
    for (std::string text : names)
    {
      text.resize(8);
      all.insert(all.end(), text.begin(), text.end());
    }
    this->variable(name, { dimension, "len_name" }, all);
  }

  std::string bytes(std::int64_t records)
  {
    // The header has the same length whatever the places of the variables are.
    const std::size_t headerBytes = this->header(records, 0).size();
    return this->header(records, headerBytes) + this->data(records);
  }

private:
  struct Variable
  {
    std::string name;
    std::vector<std::string> dimensions;
    int type;
    std::string bytes, elementType;
    std::size_t size = 1;
  };

  static int typeOf(char) { return 2; }
  static int typeOf(std::int32_t) { return 4; }
  static int typeOf(float) { return 5; }
  static int typeOf(double) { return 6; }
  static int typeOf(std::int64_t) { return 10; }

  void size(std::string& out, std::int64_t value) const
  {
    this->Version == 5 ? put(out, value, true) : put(out, static_cast<std::int32_t>(value), true);
  }
  void text(std::string& out, const std::string& text) const
  {
    this->size(out, std::ssize(text));
    out += text;
    out.resize((out.size() + 3) / 4 * 4);
  }
  bool isOfRecords(const Variable& variable) const
  {
    return !variable.dimensions.empty() && variable.dimensions[0] == "time_step";
  }
  std::size_t bytesOf(const Variable& variable, std::int64_t records) const
  {
    const std::size_t bytes = this->isOfRecords(variable)
                                ? variable.bytes.size() / static_cast<std::size_t>(records)
                                : variable.bytes.size();
    return (bytes + 3) / 4 * 4;
  }

  std::string header(std::int64_t records, std::size_t begin) const
  {
    std::string out = "CDF" + std::string(1, static_cast<char>(this->Version));
    this->size(out, records);
    put(out, std::int32_t(10), true);
    this->size(out, std::ssize(this->Names));
    for (std::size_t i = 0; i < this->Names.size(); ++i)
    {
      this->text(out, this->Names[i]);
      this->size(out, this->Extents[i]);
    }
    put(out, std::int32_t(12), true);
    this->size(out, 1);
    this->text(out, "title");
    put(out, std::int32_t(2), true);
    this->text(out, "mesh");
    put(out, std::int32_t(11), true);
    this->size(out, std::ssize(this->Variables));
    for (const bool ofRecords : { false, true })
    {
      for (const Variable& variable : this->Variables)
      {
        if (this->isOfRecords(variable) == ofRecords)
        {
          this->describe(out, variable, begin, records);
          begin += this->bytesOf(variable, records);
        }
      }
    }
    return out;
  }
  void describe(
    std::string& out, const Variable& variable, std::size_t begin, std::int64_t records) const
  {
    this->text(out, variable.name);
    this->size(out, std::ssize(variable.dimensions));
    for (const std::string& name : variable.dimensions)
    {
      this->size(out, std::ranges::find(this->Names, name) - this->Names.begin());
    }
    put(out, std::int32_t(variable.elementType.empty() ? 0 : 12), true);
    this->size(out, variable.elementType.empty() ? 0 : 1);
    if (!variable.elementType.empty())
    {
      this->text(out, "elem_type");
      put(out, std::int32_t(2), true);
      this->text(out, variable.elementType);
    }
    put(out, std::int32_t(variable.type), true);
    this->size(out, static_cast<std::int64_t>(this->bytesOf(variable, records)));
    this->Version == 1 ? put(out, static_cast<std::int32_t>(begin), true)
                       : put(out, static_cast<std::int64_t>(begin), true);
  }

  std::string data(std::int64_t records) const
  {
    std::string out;
    for (const Variable& variable : this->Variables)
    {
      if (!this->isOfRecords(variable))
      {
        out += variable.bytes;
        out.resize(out.size() + this->bytesOf(variable, records) - variable.bytes.size());
      }
    }
    for (std::int64_t record = 0; record < records; ++record)
    {
      for (const Variable& variable : this->Variables)
      {
        if (this->isOfRecords(variable))
        {
          const std::size_t bytes = variable.bytes.size() / static_cast<std::size_t>(records);
          out += variable.bytes.substr(static_cast<std::size_t>(record) * bytes, bytes);
          out.resize((out.size() + 3) / 4 * 4);
        }
      }
    }
    return out;
  }

  int Version;
  std::vector<std::string> Names;
  std::vector<std::int64_t> Extents;
  std::vector<Variable> Variables;
};

/** Two blocks of a tetrahedron each, one of a triangle, sets, and results at two times. */
NetCdfBytes exodusMesh(int version)
{
  NetCdfBytes file(version);
  for (const auto& [name, extent] :
    std::vector<std::pair<std::string, std::int64_t>>{ { "time_step", 0 }, { "len_name", 8 },
      { "num_dim", 3 }, { "num_nodes", 5 }, { "num_el_blk", 3 }, { "num_el_in_blk", 1 },
      { "num_nod_per_el1", 4 }, { "num_nod_per_el3", 3 }, { "num_node_sets", 1 },
      { "num_nod_ns1", 3 }, { "num_side_sets", 2 }, { "num_side_ss1", 2 }, { "num_side_ss2", 1 },
      { "num_nod_var", 2 }, { "num_elem_var", 1 } })
  {
    file.dimension(name, extent);
  }
  using Integers = std::vector<std::int32_t>;
  using Reals = std::vector<double>;
  file.variable("time_whole", { "time_step" }, Reals{ 0.5, 2.5 });
  file.variable("eb_prop1", { "num_el_blk" }, Integers{ 10, 20, 30 });
  file.names("eb_names", "num_el_blk", { "copper", "", "skin" });
  file.variable("ns_prop1", { "num_node_sets" }, Integers{ 7 });
  file.names("ns_names", "num_node_sets", { "held" });
  file.variable("ss_prop1", { "num_side_sets" }, Integers{ 30, 5 });
  file.names("ss_names", "num_side_sets", { "inlet", "" });
  file.variable("coordx", { "num_nodes" }, Reals{ 0, 1, 0, 0, 1 });
  file.variable("coordy", { "num_nodes" }, Reals{ 0, 0, 1, 0, 1 });
  file.variable("coordz", { "num_nodes" }, Reals{ 0, 0, 0, 1, 1 });
  file.variable(
    "connect1", { "num_el_in_blk", "num_nod_per_el1" }, Integers{ 1, 2, 3, 4 }, "TETRA");
  file.variable(
    "connect2", { "num_el_in_blk", "num_nod_per_el1" }, Integers{ 2, 3, 4, 5 }, "tetra4");
  file.variable("connect3", { "num_el_in_blk", "num_nod_per_el3" }, Integers{ 1, 2, 3 }, "TRI3");
  file.variable("node_ns1", { "num_nod_ns1" }, Integers{ 1, 3, 5 });
  file.variable("elem_ss1", { "num_side_ss1" }, Integers{ 1, 2 });
  file.variable("side_ss1", { "num_side_ss1" }, Integers{ 4, 2 });
  file.variable("elem_ss2", { "num_side_ss2" }, Integers{ 3 });
  file.variable("side_ss2", { "num_side_ss2" }, Integers{ 1 });
  file.names("name_nod_var", "num_nod_var", { "temp", "flag" });
  file.variable(
    "vals_nod_var1", { "time_step", "num_nodes" }, Reals{ 1, 2, 3, 4, 5, 11, 12, 13, 14, 15 });
  file.variable("vals_nod_var2", { "time_step", "num_nodes" },
    std::vector<float>{ 0, 1, 0, 1, 0, 1, 0, 1, 0, 1 });
  file.names("name_elem_var", "num_elem_var", { "heat" });
  file.variable("vals_elem_var1eb1", { "time_step", "num_el_in_blk" }, Reals{ 100, 110 });
  file.variable("vals_elem_var1eb2", { "time_step", "num_el_in_blk" }, Reals{ 200, 210 });
  return file;
}

using ImportExodus = ImportFixture;

void expectExodusMesh(const ReadMesh& mesh)
{
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(
    groupCounts(mesh), (GroupCounts{ { "cells copper", 1 }, { "cells 20", 1 }, { "facets skin", 1 },
                         { "facets inlet", 2 }, { "facets 5", 1 }, { "vertices held", 3 } }));
}

} // namespace

TEST_F(ImportExodus, BlocksAndSetsAreGroups)
{
  for (const int version : { 1, 2, 5 })
  {
    const ReadMesh mesh = this->read("a.e", exodusMesh(version).bytes(2));
    expectExodusMesh(mesh);
    // Side 4 of the first one is 1-3-2, side 2 of the second 2-3-4 of its own.
    EXPECT_EQ(mesh.facets, (Numbers{ 0, 1, 2, 0, 2, 1, 2, 3, 4, 0, 1, 2 }));
    EXPECT_EQ(formatOfFile(this->Folder / "a.e"), &ExodusFormat);
  }
}

/** As of writers other than the library of Exodus. */
TEST_F(ImportExodus, BlocksAndSetsWithoutNumbersAreCounted)
{
  std::string bytes = exodusMesh(1).bytes(2);
  for (const std::string name : { "eb_prop1", "ns_prop1", "ss_prop1" })
  {
    bytes.replace(bytes.find(name), name.size(), "no" + name.substr(2));
  }
  EXPECT_EQ(groupCounts(this->read("a.e", bytes)),
    (GroupCounts{ { "cells copper", 1 }, { "cells 2", 1 }, { "facets skin", 1 },
      { "facets inlet", 2 }, { "facets 2", 1 }, { "vertices held", 3 } }));
}

TEST_F(ImportExodus, ResultsOfATimeStepAreColumns)
{
  const std::string bytes = exodusMesh(2).bytes(2);
  writeBytes(this->Folder / "a.exo", bytes);
  EXPECT_EQ(timesOf(this->Folder / "a.exo"), (std::vector<double>{ 0.5, 2.5 }));
  for (const int step : { 0, 1 })
  {
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    ImportOptions options;
    options.part.timeStep = step;
    const ReadMesh mesh = readRaw(importMesh(this->Folder / "a.exo", workspace, options));
    expectExodusMesh(mesh);
    ASSERT_EQ(mesh.vertexColumns.size(), 2u);
    EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "temp", ScalarType::Float64, 1 }));
    EXPECT_EQ(mesh.vertexColumns[0].value(4), 5 + 10 * step);
    EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "flag", ScalarType::Float32, 1 }));
    EXPECT_EQ(mesh.vertexColumns[1].value(1), 1 - step);
    const Column& heat = elementColumn(mesh, "heat");
    EXPECT_EQ(heat.value(0), 100 + 10 * step);
    EXPECT_EQ(heat.value(1), 200 + 10 * step);
    EXPECT_TRUE(heat.value(2) != heat.value(2));
  }
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  ImportOptions later;
  later.part.timeStep = 2;
  smg::testing::expectError([&] { importMesh(this->Folder / "a.exo", workspace, later); },
    "there is no time step 2: the file has 2");
}

TEST_F(ImportExodus, OtherNetCdfFilesAreRefused)
{
  NetCdfBytes other(1);
  other.dimension("x", 2);
  other.variable("x", { "x" }, std::vector<double>{ 1, 2 });
  this->expectError("a.e", other.bytes(0), "is a netCDF file without a mesh");
  this->expectError("a.e", "CDF\x01", "truncated");
}

TEST_F(ImportExodus, DamagedFilesAreRefusedOrValid)
{
  this->expectDamageIsFound("a.e", exodusMesh(1).bytes(2), 200);
}

} // namespace smg::testing
