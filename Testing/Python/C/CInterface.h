// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Python/C/streamingmultigrid.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Column.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg::testing
{

struct CloseHandle
{
  void operator()(smg_mesh* mesh) const { smg_close_mesh(mesh); }
  void operator()(smg_field* field) const { smg_close_field(field); }
  void operator()(smg_blocks* blocks) const { smg_close_blocks(blocks); }
};
using MeshHandle = std::unique_ptr<smg_mesh, CloseHandle>;
using FieldHandle = std::unique_ptr<smg_field, CloseHandle>;
using BlocksHandle = std::unique_ptr<smg_blocks, CloseHandle>;

/** Expects a function of the C interface to succeed. */
inline void expectOk(smg_status status)
{
  EXPECT_EQ(status, SMG_OK) << smg_error();
}

/** The rows of a vector as a C-contiguous array. */
template <class T>
smg_array arrayOf(const std::vector<T>& values, int columns = 1)
{
  const auto size = static_cast<std::int64_t>(sizeof(T));
  return { values.data(), static_cast<smg_type>(scalarTypeOf<T>()),
    static_cast<std::int64_t>(values.size()) / columns, columns, size * columns, size };
}

inline MeshHandle openFile(const std::filesystem::path& path, const std::string& options = {})
{
  smg_mesh* mesh = nullptr;
  expectOk(smg_open(path.c_str(), options.c_str(), nullptr, nullptr, &mesh));
  return MeshHandle(mesh);
}

inline MeshHandle openMesh(const IndexedTestMesh& mesh, const std::string& options = {})
{
  const smg_array points = arrayOf(mesh.positions, 3);
  const smg_array cells = arrayOf(mesh.corners, cornersOf(mesh.cellType));
  smg_mesh* handle = nullptr;
  expectOk(smg_open_arrays(&points, &cells, options.c_str(), nullptr, nullptr, &handle));
  return MeshHandle(handle);
}

inline FieldHandle run(smg_mesh* mesh, const char* job, const std::string& description)
{
  smg_field* field = nullptr;
  expectOk(smg_run(mesh, job, description.c_str(), nullptr, nullptr, &field));
  return FieldHandle(field);
}

/** A whole column of T, of this many components. */
template <class T>
std::vector<T> read(smg_mesh* mesh, smg_field* field, const char* name, bool ofCells,
  int components, std::int64_t rows)
{
  std::vector<T> values(static_cast<std::size_t>(rows * components));
  expectOk(smg_read(mesh, field, name, ofCells ? 1 : 0, nullptr, nullptr, values.data()));
  return values;
}

/** The numbers of vertices and cells. */
struct Counts
{
  explicit Counts(const smg_mesh* mesh)
  {
    expectOk(smg_counts(mesh, &this->vertices, &this->cells));
  }
  std::int64_t vertices = 0, cells = 0;
};

inline nlohmann::json reportOf(smg_field* field)
{
  const char* text = nullptr;
  expectOk(smg_report(field, 1, nullptr, nullptr, &text));
  return text ? nlohmann::json::parse(text) : nlohmann::json();
}

/** The names of columns, of a mesh or of a field. */
inline std::vector<std::string> columnNames(smg_mesh* mesh, smg_field* field, const char* of)
{
  const char* text = nullptr;
  expectOk(smg_columns(mesh, field, &text));
  std::vector<std::string> names;
  const nlohmann::json columns = nlohmann::json::parse(text);
  for (const nlohmann::json& column : columns.at(of))
  {
    names.push_back(column.at("name"));
  }
  return names;
}

} // namespace smg::testing
