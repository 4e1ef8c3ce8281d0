// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/MeshText.h"
#include "Testing/Python/C/CInterface.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Whatever is wrong is a status and a sentence, and nothing of it remains.

namespace smg::testing
{
namespace
{

void expectStatus(smg_status status, smg_status expected, const std::string& words)
{
  EXPECT_EQ(status, expected) << smg_error();
  EXPECT_NE(std::string(smg_error()).find(words), std::string::npos) << smg_error();
}

void expectInvalid(smg_status status, const std::string& words)
{
  expectStatus(status, SMG_INVALID, words);
}

struct ErrorMesh
{
  IndexedTestMesh mesh = shuffled(torus(30, 20, 0.1));
  MeshHandle handle = openMesh(this->mesh);
  FieldHandle field = run(this->handle.get(), "distance", R"({"from": {"vertices": [0]}})");
};

TEST(CErrors, NullIsAnErrorOfEveryFunction)
{
  ErrorMesh given;
  smg_mesh* mesh = nullptr;
  smg_field* field = nullptr;
  smg_blocks* blocks = nullptr;
  smg_array array{};
  std::int64_t number = 0;
  double value = 0.0;
  const char* text = nullptr;
  smg_mesh* const m = given.handle.get();
  smg_field* const f = given.field.get();
  const smg_array points = arrayOf(given.mesh.positions, 3);
  const char* const null = "must not be NULL";
  expectInvalid(smg_open(nullptr, nullptr, nullptr, nullptr, &mesh), null);
  expectInvalid(smg_open("a.ply", nullptr, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_open_arrays(nullptr, &points, nullptr, nullptr, nullptr, &mesh), null);
  expectInvalid(smg_open_arrays(&points, nullptr, nullptr, nullptr, nullptr, &mesh), null);
  expectInvalid(smg_open_arrays(&points, &points, nullptr, nullptr, nullptr, nullptr), null);
  std::int64_t triangle[3] = {};
  expectInvalid(smg_triangulate(nullptr, &points, &points, nullptr, nullptr, triangle), null);
  expectInvalid(smg_triangulate(&points, nullptr, &points, nullptr, nullptr, triangle), null);
  expectInvalid(smg_triangulate(&points, &points, nullptr, nullptr, nullptr, triangle), null);
  expectInvalid(smg_triangulate(&points, &points, &points, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_triangulate(&points, &points, &points, nullptr, nullptr, triangle), "columns");
  for (const auto add : { smg_add_column, smg_add_argument })
  {
    expectInvalid(add(nullptr, "a", 0, &points, nullptr, nullptr), null);
    expectInvalid(add(m, nullptr, 0, &points, nullptr, nullptr), null);
    expectInvalid(add(m, "a", 0, nullptr, nullptr, nullptr), null);
  }
  expectInvalid(smg_remove_column(nullptr, "a", 0), null);
  expectInvalid(smg_remove_column(m, nullptr, 0), null);
  expectInvalid(smg_info(nullptr, 0, nullptr, nullptr, &text), null);
  expectInvalid(smg_info(m, 0, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_counts(nullptr, &number, &number), null);
  expectInvalid(smg_counts(m, nullptr, &number), null);
  expectInvalid(smg_counts(m, &number, nullptr), null);
  expectInvalid(smg_conversion(nullptr, &text), null);
  expectInvalid(smg_conversion(m, nullptr), null);
  expectInvalid(smg_elements(nullptr, nullptr, nullptr, &number), null);
  expectInvalid(smg_elements(m, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_merged(nullptr, nullptr, nullptr, &number, nullptr, nullptr), null);
  expectInvalid(smg_merged(m, nullptr, nullptr, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_estimate(nullptr, "solve", nullptr, nullptr, &text), null);
  expectInvalid(smg_estimate(m, nullptr, nullptr, nullptr, &text), null);
  expectInvalid(smg_estimate(m, "solve", nullptr, nullptr, nullptr), null);
  expectInvalid(smg_run(nullptr, "solve", nullptr, nullptr, nullptr, &field), null);
  expectInvalid(smg_run(m, nullptr, nullptr, nullptr, nullptr, &field), null);
  expectInvalid(smg_run(m, "solve", nullptr, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_simplify(nullptr, nullptr, "a.ply", nullptr, nullptr, &text), null);
  expectInvalid(smg_simplify(m, nullptr, nullptr, nullptr, nullptr, &text), null);
  expectInvalid(smg_convert(nullptr, "a.vsm", nullptr, nullptr, nullptr, &text), null);
  expectInvalid(smg_convert("a.ply", nullptr, nullptr, nullptr, nullptr, &text), null);
  expectInvalid(smg_report(nullptr, 0, nullptr, nullptr, &text), null);
  expectInvalid(smg_report(f, 0, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_shape(nullptr, &number, &number), null);
  expectInvalid(smg_shape(f, nullptr, &number), null);
  expectInvalid(smg_shape(f, &number, nullptr), null);
  expectInvalid(smg_save(nullptr, "a.vtu", nullptr, nullptr, nullptr, &text), null);
  expectInvalid(smg_save(f, nullptr, nullptr, nullptr, nullptr, &text), null);
  expectInvalid(smg_save_mesh(nullptr, "a.vtu", nullptr, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_save_mesh(m, nullptr, nullptr, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_columns(nullptr, nullptr, &text), null);
  expectInvalid(smg_columns(m, f, nullptr), null);
  expectInvalid(smg_read(nullptr, nullptr, "Position", 0, nullptr, nullptr, &value), null);
  expectInvalid(smg_read(m, nullptr, nullptr, 0, nullptr, nullptr, &value), null);
  expectInvalid(smg_read(m, nullptr, "Position", 0, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_open_blocks(nullptr, nullptr, nullptr, nullptr, nullptr, &blocks), null);
  expectInvalid(smg_open_blocks(m, nullptr, nullptr, nullptr, nullptr, nullptr), null);
  expectInvalid(smg_next_block(nullptr, &number, &number), null);
  expectInvalid(smg_block_array(nullptr, "Position", 0, &array), null);
  expectInvalid(smg_block_rows(nullptr, 0, &array), null);
  expectInvalid(smg_block_ghosts(nullptr, &array), null);
  smg_close_mesh(nullptr);
  smg_close_field(nullptr);
  smg_close_blocks(nullptr);
  smg_remove_folder(nullptr);
  smg_remove_folder("/no/such/folder");
}

TEST(CErrors, ADescriptionSaysWhereItIsWrong)
{
  const ErrorMesh given;
  smg_field* field = nullptr;
  const std::vector<std::array<const char*, 3>> wrong{
    { "melt", "{}", "the jobs are solve, deform, smooth, blend, distance, area and simplify" },
    { "solve", "{", "solve: this is not valid JSON" },
    { "solve", "[]", "solve: must be an object" }, { "solve", "{}", "solve: has no 'problem'" },
    { "solve", R"({"problem": {}})", "says nothing to solve for" },
    { "solve", R"({"problem": {"source": 1}, "sweep": 1})", "solve: sweep: is not known" },
    { "solve", R"({"problem": {"dirichlet": [{"value": 0, "box": [0]}]}})",
      "solve: problem.dirichlet[0].box: must be an array of 6 numbers" },
    { "solve", R"({"problem": {"source": 1}, "tolerance": 2})", "solve: tolerance: must be" },
    { "solve", R"({"problem": {"source": 1}, "sweeps": 0})", "solve: sweeps: must be" },
    { "solve", R"({"problem": {"source": 1}, "memory": "2 pounds"})", "solve: memory: '2 pounds'" },
    { "solve", R"({"problem": {"source": 1}, "memory": 5})", "solve: memory: must be" },
    { "solve", R"({"problem": {"source": 1}, "threads": -1})", "solve: threads: must be" },
    { "solve", R"({"problem": {"source": 1}, "in_core": 1})", "solve: in_core: must be true" },
    { "solve", R"({"problem": {"source": 1}, "acceleration": "warp"})", "solve: acceleration" },
    { "deform", R"({"handles": {"handles": []}})", "deform: handles.handles: must have" },
    { "deform", R"({"cycles": 1})", "deform: has no 'handles'" },
    { "smooth", R"({"size": "4 miles"})", "smooth: size: '4 miles' is not a size" },
    { "smooth", R"({"size": -1})", "smooth: size: must be above 0" },
    { "smooth", R"({"steps": 0})", "smooth: steps: must be" },
    { "smooth", R"({"boundary": "wavy"})", "smooth: boundary: must be one of" },
    { "smooth", R"({"keep_edges": 500})", "keep_edges: must be between 0 and 180, both excluded" },
    { "smooth", R"({"hold": {"ball": 1}})", "smooth: hold.ball: is not known" },
    { "blend", R"({"patch": "p"})", "blend: has no 'columns'" },
    { "blend", R"({"patch": "p", "columns": ["a"], "anchor": -1})", "blend: anchor: must be" },
    { "distance", "{}", "distance: needs" },
    { "distance", R"({"wall": "yes"})", "distance: wall: must be true or false" }
  };
  for (const auto& [job, description, words] : wrong)
  {
    SCOPED_TRACE(std::string(job) + ' ' + description);
    expectInvalid(smg_run(given.handle.get(), job, description, nullptr, nullptr, &field), words);
    EXPECT_EQ(field, nullptr);
  }
}

TEST(CErrors, OptionsSayWhereTheyAreWrong)
{
  ErrorMesh given;
  smg_mesh* mesh = nullptr;
  smg_blocks* blocks = nullptr;
  double room = 0.0;
  const smg_array points = arrayOf(given.mesh.positions, 3), cells = arrayOf(given.mesh.corners, 3);
  const auto open = [&](const char* options)
  { return smg_open("none.ply", options, nullptr, nullptr, &mesh); };
  expectInvalid(open("{\"color\": 1}"), "options: color: is not known");
  expectInvalid(open("{\"order\": \"random\"}"), "options: order: must be one of");
  expectInvalid(open("{\"weld\": -1}"), "options: weld: must be");
  expectInvalid(open("{\"cells\": \"quads\"}"), "options: cells: must be one of");
  expectStatus(open("{}"), SMG_FAILED, "none.ply");
  expectInvalid(
    smg_open_arrays(&points, &cells, R"({"time_step": 1})", nullptr, nullptr, &mesh), "time_step");
  expectInvalid(
    smg_open_blocks(given.handle.get(), nullptr, R"({"points": 3})", nullptr, nullptr, &blocks),
    "points");
  expectInvalid(smg_open_blocks(given.handle.get(), nullptr, R"({"columns": ["none"]})", nullptr,
                  nullptr, &blocks),
    "none");
  expectInvalid(smg_convert("a.ply", "b.vsm", R"({"restore": true, "order": "bfs"})", nullptr,
                  nullptr, nullptr),
    "options: order: does not go with restore");
  expectInvalid(
    smg_simplify(given.handle.get(), "{}", "a.ply", nullptr, nullptr, nullptr), "simplify: needs");
  expectInvalid(smg_read(given.handle.get(), nullptr, "none", 0, nullptr, nullptr, &room),
    "'none': the vertices have no column");
  EXPECT_EQ(smg_save(given.field.get(), "a.obj", nullptr, nullptr, nullptr, nullptr), SMG_FAILED);
  EXPECT_NE(std::string(smg_error()).find("cannot hold a distance"), std::string::npos);
}

TEST(CErrors, AnArraySaysItsRow)
{
  const IndexedTestMesh mesh = sphere(1);
  smg_mesh* handle = nullptr;
  const auto open = [&](const smg_array& points, const smg_array& cells)
  { return smg_open_arrays(&points, &cells, nullptr, nullptr, nullptr, &handle); };
  const smg_array points = arrayOf(mesh.positions, 3), cells = arrayOf(mesh.corners, 3);
  expectInvalid(open(arrayOf(mesh.positions, 2), cells), "points: must have 3 columns");
  expectInvalid(open(points, arrayOf(mesh.corners, 5)), "cells: must have 3 columns");
  expectInvalid(open(points, points), "cells: must be integers");
  expectInvalid(open(points, arrayOf(std::vector<std::int32_t>{}, 3)), "cells: has no rows");
  std::vector<std::int64_t> corners = mesh.corners;
  corners[3 * 7 + 1] = -1;
  expectInvalid(open(points, arrayOf(corners, 3)), "cells: row 7: the corner -1");
  corners[3 * 7 + 1] = mesh.vertices();
  expectInvalid(open(points, arrayOf(corners, 3)), "cells: row 7: the corner 42");
  std::vector<std::uint64_t> large(mesh.corners.begin(), mesh.corners.end());
  large[0] = std::numeric_limits<std::uint64_t>::max();
  expectInvalid(open(points, arrayOf(large, 3)), "cells: row 0: the corner 18446744073709551615");
  std::vector<double> positions = mesh.positions;
  positions[3 * 9] = std::nan("");
  expectInvalid(open(arrayOf(positions, 3), cells), "points: row 9: a coordinate is not finite");
  smg_array wrong = points;
  wrong.type = 77;
  expectInvalid(open(wrong, cells), "points: has a type");
  wrong = points;
  wrong.data = nullptr;
  expectInvalid(open(wrong, cells), "points: must have data");
  wrong = points;
  wrong.columns = 0;
  expectInvalid(open(wrong, cells), "points: must have one or more columns");
  wrong = points;
  wrong.rows = -1;
  expectInvalid(open(wrong, cells), "points: the number of rows is below 0");
}

TEST(CErrors, AColumnMustFitTheMesh)
{
  const ErrorMesh given;
  const std::vector<double> few(3);
  const smg_array array = arrayOf(few);
  expectInvalid(
    smg_add_column(given.handle.get(), "a", 0, &array, nullptr, nullptr), "'a': has 3 rows");
  expectInvalid(
    smg_add_column(given.handle.get(), "a", 1, &array, nullptr, nullptr), "has 1200 cells");
  const std::vector<double> values(600);
  const smg_array fitting = arrayOf(values);
  for (const char* name : { "", "Position", "OriginalId", "vtkGhostType" })
  {
    expectInvalid(smg_add_column(given.handle.get(), name, 0, &fitting, nullptr, nullptr),
      "cannot have this name");
  }
}

TEST(CErrors, MemoryThatDoesNotSufficeHasItsStatus)
{
  const MeshHandle handle = openMesh(shuffled(tetBox(25, 25, 25, 0.1)));
  smg_field* field = nullptr;
  expectStatus(
    smg_run(handle.get(), "solve",
      R"({"memory": 1048576, "problem": {"dirichlet": [{"vertices": [0], "value": 1}]}})", nullptr,
      nullptr, &field),
    SMG_MEMORY, "the limit is 1 MiB");
}

/** Counts its calls, and cancels at one of them. */
struct Calls
{
  int until = std::numeric_limits<int>::max();
  int calls = 0;
  double last = 0.0;
  bool isMonotone = true, isOnOtherThread = false;
  std::thread::id thread = std::this_thread::get_id();

  static int function(double done, void* user)
  {
    Calls& self = *static_cast<Calls*>(user);
    self.isMonotone = self.isMonotone && done >= self.last && done <= 1.0;
    self.last = done;
    self.isOnOtherThread = self.isOnOtherThread || std::this_thread::get_id() != self.thread;
    return ++self.calls >= self.until ? 1 : 0;
  }
};

/** Every function that reports its progress, with a mesh in a file. */
struct LongCalls
{
  using Function = smg_status (*)(LongCalls&, Calls&);

  TemporaryFolder folder;
  std::string options = "{\"scratch\": \"" + (this->folder / "scratch").string() + "\"}";
  std::string file = (this->folder / "mesh.off").string();
  std::string stream = (this->folder / "mesh.vsm").string();
  std::string out = (this->folder / "out.vtu").string();
  MeshHandle mesh;
  FieldHandle field;
  std::vector<double> room;
  std::vector<float> values = std::vector<float>(120 * 90);

  LongCalls()
  {
    std::filesystem::create_directory(this->folder / "scratch");
    writeBytes(this->file, meshText(shuffled(torus(120, 90, 0.1))));
    this->mesh = openFile(this->file, this->options);
    expectOk(
      smg_save_mesh(this->mesh.get(), this->stream.c_str(), nullptr, nullptr, nullptr, nullptr));
    this->field = this->solved();
    this->room.resize(3 * 120 * 90);
  }

  FieldHandle solved()
  {
    return run(this->mesh.get(), "solve", R"({"problem": {"source": 1,
      "dirichlet": [{"vertices": [0], "value": 0}]}})");
  }
};

const std::vector<std::pair<const char*, LongCalls::Function>> Functions{
  { "open",
    [](LongCalls& self, Calls& calls)
    {
      smg_mesh* mesh = nullptr;
      const smg_status status =
        smg_open(self.file.c_str(), self.options.c_str(), Calls::function, &calls, &mesh);
      smg_close_mesh(mesh);
      return status;
    } },
  { "run",
    [](LongCalls& self, Calls& calls)
    {
      smg_field* field = nullptr;
      const smg_status status =
        smg_run(self.mesh.get(), "smooth", R"({"steps": 2})", Calls::function, &calls, &field);
      smg_close_field(field);
      return status;
    } },
  { "report",
    [](LongCalls& self, Calls& calls)
    {
      const char* text = nullptr;
      self.field = self.solved();
      return smg_report(self.field.get(), 1, Calls::function, &calls, &text);
    } },
  { "save",
    [](LongCalls& self, Calls& calls)
    {
      return smg_save(
        self.field.get(), self.out.c_str(), nullptr, Calls::function, &calls, nullptr);
    } },
  { "save_mesh",
    [](LongCalls& self, Calls& calls)
    {
      return smg_save_mesh(
        self.mesh.get(), self.out.c_str(), nullptr, Calls::function, &calls, nullptr);
    } },
  { "add_column",
    [](LongCalls& self, Calls& calls)
    {
      // Of a file, the first time.
      const MeshHandle mesh = openFile(self.stream);
      const smg_array values = arrayOf(self.values);
      return smg_add_column(mesh.get(), "a", 0, &values, Calls::function, &calls);
    } },
  { "open_blocks",
    [](LongCalls& self, Calls& calls)
    {
      const MeshHandle mesh = openFile(self.stream);
      smg_blocks* blocks = nullptr;
      const smg_status status =
        smg_open_blocks(mesh.get(), nullptr, nullptr, Calls::function, &calls, &blocks);
      smg_close_blocks(blocks);
      return status;
    } },
  { "open_blocks of a field",
    [](LongCalls& self, Calls& calls)
    {
      const FieldHandle field = self.solved();
      smg_blocks* blocks = nullptr;
      const smg_status status =
        smg_open_blocks(nullptr, field.get(), nullptr, Calls::function, &calls, &blocks);
      smg_close_blocks(blocks);
      return status;
    } },
  { "open_solver",
    [](LongCalls& self, Calls& calls)
    {
      const MeshHandle mesh = openFile(self.stream);
      smg_solver* solver = nullptr;
      const smg_status status =
        smg_open_solver(mesh.get(), nullptr, Calls::function, &calls, &solver);
      smg_close_solver(solver);
      return status;
    } },
  { "simplify",
    [](LongCalls& self, Calls& calls)
    {
      return smg_simplify(self.mesh.get(), R"({"vertices": 1000})", self.out.c_str(),
        Calls::function, &calls, nullptr);
    } },
  { "convert",
    [](LongCalls& self, Calls& calls)
    {
      return smg_convert(self.file.c_str(), self.out.c_str(), self.options.c_str(), Calls::function,
        &calls, nullptr);
    } },
  { "read",
    [](LongCalls& self, Calls& calls)
    {
      return smg_read(
        self.mesh.get(), nullptr, "Position", 0, Calls::function, &calls, self.room.data());
    } }
};

TEST(CErrors, ProgressIsReportedOnTheCallingThreadAndNeverDecreases)
{
  LongCalls all;
  for (const auto& [name, function] : Functions)
  {
    SCOPED_TRACE(name);
    Calls calls;
    expectOk(function(all, calls));
    EXPECT_GT(calls.calls, 0);
    EXPECT_TRUE(calls.isMonotone);
    EXPECT_FALSE(calls.isOnOtherThread);
    std::filesystem::remove(all.out);
  }
}

TEST(CErrors, WhatIsCancelledLeavesNothing)
{
  LongCalls all;
  for (const auto& [name, function] : Functions)
  {
    SCOPED_TRACE(name);
    Calls whole;
    expectOk(function(all, whole));
    std::filesystem::remove(all.out);
    const auto scratch = std::filesystem::directory_iterator(all.folder / "scratch");
    const auto before = std::distance(begin(scratch), end(scratch));
    for (const int until : { 1, whole.calls / 2, whole.calls })
    {
      Calls calls;
      calls.until = until;
      const smg_status status = function(all, calls);
      if (calls.calls < until) // how often it is called may depend on the disk
      {
        expectOk(status);
        std::filesystem::remove(all.out);
        continue;
      }
      expectStatus(status, SMG_CANCELLED, "cancelled");
      EXPECT_FALSE(std::filesystem::exists(all.out));
      const auto rest = std::filesystem::directory_iterator(all.folder / "scratch");
      EXPECT_EQ(std::distance(begin(rest), end(rest)), before);
    }
  }
}

TEST(CErrors, TheTextIsThatOfTheThread)
{
  smg_mesh* mesh = nullptr;
  EXPECT_EQ(smg_open("here.ply", nullptr, nullptr, nullptr, &mesh), SMG_FAILED);
  std::thread(
    []
    {
      smg_mesh* other = nullptr;
      EXPECT_STREQ(smg_error(), "");
      EXPECT_EQ(smg_open("there.ply", nullptr, nullptr, nullptr, &other), SMG_FAILED);
      EXPECT_NE(std::string(smg_error()).find("there.ply"), std::string::npos);
    })
    .join();
  EXPECT_NE(std::string(smg_error()).find("here.ply"), std::string::npos);
}

} // namespace
} // namespace smg::testing
