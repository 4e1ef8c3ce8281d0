/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Streaming Multigrid for any language: elliptic problems on meshes too large for memory.
 *
 *   smg_mesh* mesh = NULL;
 *   smg_field* field = NULL;
 *   if (smg_open("bunny.ply", NULL, NULL, NULL, &mesh) ||
 *       smg_run(mesh, "solve", problem, NULL, NULL, &field) ||
 *       smg_save(field, "bunny.vtu", NULL, NULL, NULL, NULL))
 *     fprintf(stderr, "%s\n", smg_error());
 *   smg_close_field(field);
 *   smg_close_mesh(mesh);
 *
 * Functions that can fail return a status; smg_error() then has the sentence for the user. What to
 * compute, and how, are JSON texts: NULL or "" is {}. Keys that do not exist are errors.
 *
 * Vertices and cells have two orders. The *original* one is that of the file or of the arrays, with
 * the vertices of no cell; the *stream* order is that in which a mesh is read. Numbers in JSON,
 * rows of arrays that are given, and smg_read() refer to the original order; blocks come in stream
 * order. Numbers of vertices are refused where the mesh has those of another one in OriginalId.
 *
 * A handle may be used by one thread at a time, different handles by different threads. A field,
 * its blocks and a solver keep what they need of their mesh: handles may be closed in any order.
 *
 * After fork(), a child may use its copies of handles that no thread was using, as long as the
 * parent has not closed its own, and closes them without effect on the parent. Solvers are not for
 * the child, where they return an error: it would share their memory with the parent. A progress
 * function that forks cancels the call in the child.
 */
#ifndef STREAMINGMULTIGRID_H
#define STREAMINGMULTIGRID_H

#include <stdint.h>

#ifndef SMG_C_EXPORT
#define SMG_C_EXPORT
#endif

#ifdef __cplusplus
extern "C"
{
#endif

  typedef struct smg_mesh smg_mesh;     /* a mesh, on disk */
  typedef struct smg_field smg_field;   /* what a job found: values at the vertices, on disk */
  typedef struct smg_blocks smg_blocks; /* a mesh or a field, block after block */
  typedef struct smg_solver smg_solver; /* equations with their hierarchy */

  typedef enum smg_status
  {
    SMG_OK = 0,
    SMG_FAILED = 1,   /* the mesh, a file, the disk, or the system */
    SMG_INVALID = 2,  /* a wrong argument: a text, an option, the shape or type of an array */
    SMG_MEMORY = 3,   /* a memory limit is too low, or there is no memory */
    SMG_CANCELLED = 4 /* the progress function said so; nothing half-done is left */
  } smg_status;

  typedef enum smg_type
  {
    SMG_INT8 = 0,
    SMG_UINT8 = 1,
    SMG_INT16 = 2,
    SMG_UINT16 = 3,
    SMG_INT32 = 4,
    SMG_UINT32 = 5,
    SMG_INT64 = 6,
    SMG_UINT64 = 7,
    SMG_FLOAT32 = 8,
    SMG_FLOAT64 = 9
  } smg_type;

  /* A table of numbers that belongs to somebody else. Strides are in bytes, and may be negative. */
  typedef struct smg_array
  {
    const void* data;
    int32_t type; /* an smg_type */
    int64_t rows, columns;
    int64_t row_stride, column_stride;
  } smg_array;

  /* Takes the part that is done, from 0 to 1; returns 0 to go on, anything else to cancel. It is
   * called on the thread that called the function, and must not use handles. */
  typedef int (*smg_progress)(double done, void* user);

  /* The version of the library, for example "0.2.0". */
  SMG_C_EXPORT const char* smg_version(void);

  /* What the last function that failed on this thread has to say. */
  SMG_C_EXPORT const char* smg_error(void);

  /* Opens a mesh file of any format; one that is no .vsm is converted to a scratch file.
   * options: "memory" (bytes, or a text as "1GB"), "cells" ("triangles", "tets"), "weld"
   * (distance), "orient" (turn triangles), "time_step", "partition", "order" ("bfs", "spectral",
   * "axis", "keep"), "problem" (an object as in a problem file: the order keeps near each other
   * what it couples), "threads", "scratch" (folder), "scratch_limit" (bytes, or a text),
   * "checkpoint" (folder), "numbering"
   * ("columns": rows of arrays are those that int64 columns OriginalId and OriginalCellId of the
   * file name, if it has them; "rows": those of the file, such columns are renamed); of a .vsm that
   * smg_convert() has made, "welded": its "weld". */
  SMG_C_EXPORT smg_status smg_open(
    const char* path, const char* options, smg_progress progress, void* user, smg_mesh** mesh);

  /* A mesh of arrays, which are read during the call: points (n x 3) of any type, and cells (m x 3:
   * triangles, m x 4: tetrahedra), rows of `points`, of any integer type. options as of smg_open(),
   * without those of files. */
  SMG_C_EXPORT smg_status smg_open_arrays(const smg_array* points, const smg_array* cells,
    const char* options, smg_progress progress, void* user, smg_mesh** mesh);

  /* Cuts polygons into triangles, as those of a file are cut: points (n x 3); corners, the rows of
   * `points` of all polygons; offsets, where those of each polygon begin and, last, where all end.
   * `triangles` has room for three rows of `points` for each triangle: a polygon of n corners
   * becomes n - 2. */
  SMG_C_EXPORT smg_status smg_triangulate(const smg_array* points, const smg_array* corners,
    const smg_array* offsets, smg_progress progress, void* user, int64_t* triangles);

  /* Adds a column to the vertices (cells = 0) or cells (1), a row for each in the original order,
   * in place of one of this name. The array is not copied: it must not change or go as long as the
   * mesh has it, and fields, blocks and solvers are open that were made until then. The first time,
   * a mesh whose order is not known may be read. */
  SMG_C_EXPORT smg_status smg_add_column(smg_mesh* mesh, const char* name, int cells,
    const smg_array* values, smg_progress progress, void* user);

  /* Adds a column that is an argument of jobs alone: they find it by its name, which must not be
   * that of a column of the mesh; nothing else has it, neither files, blocks and results nor what
   * is said of the mesh. */
  SMG_C_EXPORT smg_status smg_add_argument(smg_mesh* mesh, const char* name, int cells,
    const smg_array* values, smg_progress progress, void* user);

  /* Takes a column away that was added, if there is one of this name. */
  SMG_C_EXPORT smg_status smg_remove_column(smg_mesh* mesh, const char* name, int cells);

  /* What is known of a mesh: the JSON of `smg info --report`; with `full` that of `smg info
   * --full`, which reads the mesh. It is that of the mesh as it was opened, with added columns:
   * "width", "span", "mean_width", "expected_solve" and the memory of the description are those of
   * the "order" of smg_open(), where smg info has the file in its own order ("order": "keep") and
   * expects a solve in that of a conversion. The text is valid until the next call with this mesh.
   */
  SMG_C_EXPORT smg_status smg_info(
    smg_mesh* mesh, int full, smg_progress progress, void* user, const char** json);

  /* The report of the conversion with which smg_open() or smg_open_arrays() has read the mesh: the
   * JSON of `smg convert --report`, with "changes", what is left out or counts for nothing, a
   * sentence each, or "null" if there was none, as of a .vsm file. The text is valid until the next
   * call with this mesh. */
  SMG_C_EXPORT smg_status smg_conversion(smg_mesh* mesh, const char** json);

  /* Marks the vertices of a part of the mesh with 1, others with 0: `selected` has room for all
   * vertices, in the original order. `where` is a WHERE of docs/problem.md, as
   * {"sphere": [0, 0, 0, 1]}; a column of the cells selects their vertices. */
  SMG_C_EXPORT smg_status smg_select(
    smg_mesh* mesh, const char* where, smg_progress progress, void* user, uint8_t* selected);

  /* The numbers of vertices and cells in the original order. */
  SMG_C_EXPORT smg_status smg_counts(const smg_mesh* mesh, int64_t* vertices, int64_t* cells);

  /* The number of cells of the file or arrays, as polygons or hexahedra, of which the cells of the
   * mesh are parts: of different numbers in the column OriginalCellId. Elements that are no cells
   * of the mesh, as those of groups of facets, do not count. */
  SMG_C_EXPORT smg_status smg_elements(
    const smg_mesh* mesh, smg_progress progress, void* user, int64_t* elements);

  /* The points that "weld" has merged: their number, and their rows in the original order,
   * ascending, with the row of the vertex that each has become. rows, kept: NULL, or with room for
   * as many. */
  SMG_C_EXPORT smg_status smg_merged(smg_mesh* mesh, smg_progress progress, void* user,
    int64_t* count, int64_t* rows, int64_t* kept);

  /* The files of a mesh, which are several of TetGen, or of VTK in pieces: a JSON list of paths,
   * the given one first. The text is valid until the next call on this thread. */
  SMG_C_EXPORT smg_status smg_files(const char* path, const char** json);

  /* What jobs may be asked, and what they report: a JSON object. "jobs" has a list for each of
   * them, by its name, as "solve", of its options in the order in which they are read: "key",
   * "kind", "help", and as far as they have them "required", "default", "allowed", "unit",
   * "choices". "report", "simplify_report" and "estimate"
   * list the entries of these: "key", "kind", and "list" if there are several. The text stays
   * valid. */
  SMG_C_EXPORT smg_status smg_describe(const char** json);

  /* What a job of smg_run(), or "simplify", is expected to cost, before it starts: the JSON of
   * `--dry-run --report`, without the conversion that smg_open() has made. `path`: where the result
   * is to be written; NULL: nowhere. The text as that of smg_info(). */
  SMG_C_EXPORT smg_status smg_estimate(
    smg_mesh* mesh, const char* job, const char* description, const char* path, const char** json);

  /* The same of a file that is not opened: of one that is no .vsm, with the conversion, from its
   * header or its size. options as of smg_open(). The text is valid until the next call on this
   * thread. */
  SMG_C_EXPORT smg_status smg_estimate_file(const char* file, const char* options, const char* job,
    const char* description, const char* path, const char** json);

  /* Does a job that smg_describe() lists, but "simplify". description: its options, as {"patch":
   * "scan", "columns": ["Colors"]}. They mean what the options of the command line of these names
   * mean ("keep_volume" is --keep-volume), and have their defaults; "memory", "threads", "scratch"
   * and "scratch_limit" those that the mesh was opened with. A number of "memory" is in bytes.
   * "problem" of solve is as a problem file (docs/problem.md), "handles" of deform as a handle file
   * (docs/deform.md). A checkpoint goes with the field that smg_save() has written. */
  SMG_C_EXPORT smg_status smg_run(smg_mesh* mesh, const char* job, const char* description,
    smg_progress progress, void* user, smg_field** field);

  /* The mesh with the result of a job as a mesh, for other jobs: its columns are those of
   * smg_columns() of the field, its order is that of the field. It is written to a scratch file the
   * first time. */
  SMG_C_EXPORT smg_status smg_open_field(
    smg_field* field, smg_progress progress, void* user, smg_mesh** mesh);

  /* Writes the simplified surface. description: the options of "simplify". The report is that of
   * `smg simplify --report`; its text as that of smg_info(). */
  SMG_C_EXPORT smg_status smg_simplify(smg_mesh* mesh, const char* description, const char* path,
    smg_progress progress, void* user, const char** report);

  /* Converts a file: options as of smg_open(), and "codec" ("none", "lz4", "zstd"), "restore"
   * (true: in the order of the original file), "text" as of smg_save(). The report is that of `smg
   * convert --report`, valid until the next call on this thread; it may be NULL. */
  SMG_C_EXPORT smg_status smg_convert(const char* in, const char* out, const char* options,
    smg_progress progress, void* user, const char** report);

  /* The report of a job (docs: Report.h); with `full` what follows from its result, too:
   * conditions, energy, means, inverted cells, for which the mesh is read once the first time. The
   * text is valid until the next call with this field. */
  SMG_C_EXPORT smg_status smg_report(
    smg_field* field, int full, smg_progress progress, void* user, const char** json);

  /* The number of vertices in the original order, and of values at each in the first column of the
   * result: Solution, Distance, the first one blended, or Position. */
  SMG_C_EXPORT smg_status smg_shape(const smg_field* field, int64_t* vertices, int64_t* columns);

  /* Writes the mesh with the result, in the format of the suffix and in the order of the command
   * line. options: "memory", "threads", "scratch", "text" (true: text where the format has a binary
   * and a text form). The report is that of smg_report(), with a
   * warning of each thing that the format cannot hold; it may be NULL. */
  SMG_C_EXPORT smg_status smg_save(smg_field* field, const char* path, const char* options,
    smg_progress progress, void* user, const char** report);

  /* Writes a mesh with the columns that were added, likewise. The notes are a JSON list of a
   * sentence for each thing that the format cannot hold; they may be NULL. The text as that of
   * smg_info(). */
  SMG_C_EXPORT smg_status smg_save_mesh(smg_mesh* mesh, const char* path, const char* options,
    smg_progress progress, void* user, const char** notes);

  /* The columns of a mesh, or of a field with its mesh: a JSON object with the lists "vertices" and
   * "cells" of { "name", "type", "components" }. Either handle may be NULL, not both. A field has
   * the columns of its result, for example Solution; of moved points "Position". */
  SMG_C_EXPORT smg_status smg_columns(smg_mesh* mesh, smg_field* field, const char** json);

  /* Reads a whole column of the vertices (cells = 0) or cells (1) of a mesh or of a field, in the
   * original order, into room for all rows, C-contiguous, of the type of the column. Columns that
   * every mesh has: "Position" of the vertices (3 x float64), "Corners" of the cells (int64). Rows
   * of vertices of no cell have what the mesh has there; of a solution NaN. */
  SMG_C_EXPORT smg_status smg_read(smg_mesh* mesh, smg_field* field, const char* name, int cells,
    smg_progress progress, void* user, void* values);

  /* Reads a mesh, or a field with its mesh, in blocks of consecutive cells with all their vertices.
   * options: "points" (the most vertices of a block; 1,000,000 by default), "columns" (names of
   * columns of the vertices), "cell_columns" (of the cells); by default all. A field is written to
   * a scratch file the first time. */
  SMG_C_EXPORT smg_status smg_open_blocks(smg_mesh* mesh, smg_field* field, const char* options,
    smg_progress progress, void* user, smg_blocks** blocks);

  /* Goes to the next block; `cells` is 0 at the end. */
  SMG_C_EXPORT smg_status smg_next_block(smg_blocks* blocks, int64_t* vertices, int64_t* cells);

  /* An array of the block, valid until the next call of smg_next_block(). Vertices (cells = 0):
   * "Position" and columns; cells (1): "Corners" (int64, rows of this block) and columns. */
  SMG_C_EXPORT smg_status smg_block_array(
    smg_blocks* blocks, const char* name, int cells, smg_array* array);

  /* The rows of the vertices or cells of the block in the original order (int64), likewise. */
  SMG_C_EXPORT smg_status smg_block_rows(smg_blocks* blocks, int cells, smg_array* rows);

  /* 1 at vertices that an earlier block has, too, else 0 (uint8), likewise. */
  SMG_C_EXPORT smg_status smg_block_ghosts(smg_blocks* blocks, smg_array* ghosts);

  /* The equations A x = b of a problem ("problem") with their hierarchy, in memory or, with
   * "on_disk", on scratch files within the memory limit, where it neither multiplies nor
   * preconditions, and is solved without copies of the vectors: A is the stiffness with screening,
   * Robin and soft terms. Rows of vectors are vertices in the original order. At fixed vertices,
   * which have a Dirichlet condition, or no cell with a weight, the rows of A are those of the
   * identity; rows of others have entries for fixed neighbours, and the part of A on the others is
   * symmetric. So b has the load of each free vertex and the value of each fixed one; sources,
   * fluxes and values of the problem have no part in it. options: "problem", "sweeps", "memory",
   * "threads", "on_disk" (false by default). */
  SMG_C_EXPORT smg_status smg_open_solver(
    smg_mesh* mesh, const char* options, smg_progress progress, void* user, smg_solver** solver);

  /* Solves A x = b for all columns of b, as many together as the problem has, beginning with what
   * `x` has (C-contiguous, of the shape of b; it must not overlap b, and is unchanged after an
   * error, but in columns that were complete if the hierarchy is on disk). At fixed vertices x = b.
   * On a component without any condition, where A is singular, the mean is taken from b, and x
   * keeps its mean. options: "tolerance" (||b - A x|| / ||b - A x_0||, 1e-8 by default),
   * "max_cycles" (50 by default). The report is as that of a solve, with a step for each group of
   * columns; it may be NULL, and is valid until the next call with this solver.
   */
  SMG_C_EXPORT smg_status smg_solver_solve(smg_solver* solver, const smg_array* b, double* x,
    const char* options, smg_progress progress, void* user, const char** report);

  /* z = M r: one V-cycle, a symmetric positive definite approximation of the inverse on free
   * vertices, up to the rounding of single precision; at fixed vertices z = r, without effect on
   * others. Vectors of one number for each vertex; z may be r. */
  SMG_C_EXPORT smg_status smg_solver_precondition(smg_solver* solver, const double* r, double* z);

  /* y = A x; y may be x. Conjugate gradients need a first guess with x = b at fixed vertices. */
  SMG_C_EXPORT smg_status smg_solver_multiply(smg_solver* solver, const double* x, double* y);

  /* Close a handle and remove its scratch files; NULL is nothing. */
  SMG_C_EXPORT void smg_close_mesh(smg_mesh* mesh);
  SMG_C_EXPORT void smg_close_field(smg_field* field);
  SMG_C_EXPORT void smg_close_blocks(smg_blocks* blocks);
  SMG_C_EXPORT void smg_close_solver(smg_solver* solver);

  /* Removes a folder with all that it has, as one made for the file of smg_simplify(); nothing is
   * said if that fails. It is for languages whose own functions a signal can interrupt while they
   * clean up. */
  SMG_C_EXPORT void smg_remove_folder(const char* folder);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif
