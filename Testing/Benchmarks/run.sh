#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Benchmarks/run.sh [PART] [OPTION VALUE]... [MESH...] : measures, and writes tables (.md) and
# numbers (.json) to build-benchmarks/results. A MESH may have any format that `smg convert` reads,
# a .vsm is used unchanged; without one a part generates its own, with --quick tiny ones, which show
# that the part works. The parts:
#
#   all       every part below, one after the other, with the meshes of docs/performance.md, made of those
#             in SMG_TEST_DATA_DIR, the unpacked archive of test meshes (takes hours, and 60 GB of disk);
#             without that with the parts' own. all.md has the machine, and of each part the commit and
#             the time. Testing/Benchmarks/document.py puts the results into the documents.
#               --from PART          leaves out what comes before it, to go on where a run was stopped
#   solve     (default) the solver, hypre, PETSc and CHOLMOD, and the interactive deformation of
#             each mesh's preview. Its own meshes: tori of 0.25 and 1 million vertices, a box of
#             tetrahedra of 0.25 million, and a bumpy surface like a scan of 1 million, where
#             only the preview is measured.
#   convert   the conversion of each mesh, and the cost of VTK's reader if ParaView is installed.
#               --memory 64,256                  memory limits in MiB
#               --orders bfs,spectral,axis,keep  which orders
#               --address-space MiB              as ulimit -v on every conversion, to prove the
#                                                memory; the program itself and the stacks of its
#                                                threads count
#             Its own meshes, refined and shuffled: a torus of 1 million vertices and a box of
#             tetrahedra of 0.5 million. To make a larger real one:
#               build-benchmarks/bin/make_mesh finer dragon.ply 3 dragon-x64.ply --shuffle
#   scaling   the growth of memory and time: each mesh is refined repeatedly, converted and
#             solved out of core with one and two threads; scaling.md, .json and .svg, with the
#             exponents of the growth.
#               --to VERTICES        most vertices of a mesh (3000000)
#               --peers-to VERTICES  most vertices of a mesh for the other solvers (1000000)
#             Its own meshes: a torus and a box of tetrahedra of 40 thousand vertices.
#   table3    Table 3 of the paper: the deformation of meshes of the sizes of its models, out of core
#             and in core, the paper's numbers beside ours; table3.md and .json. Its own meshes: with
#             SMG_TEST_DATA_DIR of the archive (15 million vertices, 5 GB of memory), else bumpy surfaces
#             up to 1 million vertices.
#               --threads N          of each run (1)
#   headline  a deformation of 14 and one of 44 million vertices from file to file, a picture of
#             every triangle, and memory by stream orders; headline.md, .json and .jpg. MESH is
#             refined; without one these are made of the archive, or of a torus of 4 thousand vertices.
#               --times N            refinements of MESH, each with four times the vertices (4)
#               --memory MB          limit for MESH (84)
#               --plugin FILE        StreamingMultigrid.so, for the picture
#   kernels   nanoseconds per node of each kernel. Its own mesh: a torus of 0.25 million vertices.
#   convergence  V-cycles with and without acceleration, the factors of a V-cycle and of two levels
#             alone, by level, and at which vertices the slowest error sits; beside hypre's iterations.
#             Its own meshes: a torus and a box of tetrahedra of 0.25 million vertices.
#   schedule  how much faster a solve becomes with more threads: a model from the times of its stages
#             on one thread, for 1 to 64 threads. Its own meshes: a torus of 1 million vertices, and a
#             box of tetrahedra of 0.25 million. Beside it, wall times with the cores of this machine.
#   roofline  the bytes that a pass moves, compared with the bandwidths of memory, page
#             cache and disk. Its own mesh: a torus of 1 million vertices.
#               --scratch DIR        on the disk to measure (TMPDIR)
#               --threads 1,2        of the solves
#               --file MiB           size of the measured file (1024)
#   story     what people do with one large scan, all with the same memory limit: convert, smooth,
#             distances from a point, a picture with isolines; story.md, .json and .png. MESH is
#             refined and gets noise; without one it is a torus of 40 thousand vertices.
#               --times N            refinements, each with four times the vertices (3)
#               --memory MiB         limit of every step (128)
#               --size S             of smg smooth (8edges)
#               --source WHERE       of smg distance ({"vertices": [0]})
#               --plugin FILE        StreamingMultigrid.so, for the picture
#   discretisation  V-cycles and errors with --tolerance auto. Meshes as for convergence.
#   largest   a solve of MESH, refined 6 times, within 256 MiB: 177 million vertices of the Armadillo.
#             Its own mesh: a torus of 40 thousand vertices, refined 4 times.
#               --times N            refinements (6)
#   orders    what stream orders and sweeps cost a solve, for docs/paper.md. Its own mesh: a torus of 0.25
#             million vertices.
#   estimates what --dry-run says, and the truth. Meshes as for schedule.
#   python    solves from arrays in Python.
#               --vertices N         of a torus (1000000)
#   checkpoint, distance, simplification, smoothing   what docs/reliability.md, distance.md,
#             simplify.md and smooth.md show. Their own mesh: a torus of 0.25 million vertices; smoothing
#             and simplification need VTK's Python modules and .ply files.
#
# Scratch files go to TMPDIR, which should be a disk. To repeat a measurement: keep the machine
# otherwise idle, and run it twice; the spread between the runs is the accuracy of the times.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_benchmark_packages[@]}"

cmake --preset benchmarks > /dev/null
cmake --build --preset benchmarks
top=$PWD
cd "$here"
exec bash "$top/Testing/Benchmarks/parts.sh" "$top/build-benchmarks/bin" "$top/build-benchmarks/results" "$@"
