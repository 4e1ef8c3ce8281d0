// SPDX-License-Identifier: BSD-3-Clause
// benchmark_interactive [MESH.vsm] : the time of an update while a handle is dragged, on one
// thread.
//
//   benchmark_interactive arm.vsm --benchmark_out=arm.json
//
// deforms the preview of the mesh of at most 10,000 points, as the deformation filter does, or
// without a mesh a torus of 10,000 vertices. An update should take at most bound_ms milliseconds,
// so that a handle can be dragged. Takes the options of Google Benchmark (--help).

#include "IO/Preview/StreamPreview.h"
#include "Solver/Jobs/Deformation/InteractiveDeformation.h"
#include "Testing/Support/ArrayHandles.h"
#include "Testing/Support/MemorySource.h"
#include "smg/VsmReader.h"

#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using namespace smg::testing;

constexpr std::int64_t PreviewPoints = 10000;

/** Allowed time of an update in milliseconds. */
constexpr double UpdateBound = 30.0;

StreamMesh previewOf(const std::string& path)
{
  const smg::VsmReader reader(path);
  const auto source = reader.source();
  const smg::MeshPiece preview = smg::makePreview(*source, PreviewPoints);
  return toStream({ smg::CellType::Triangle, preview.positions, preview.corners });
}

smg::DeformOptions onOneThread(smg::Weights weights, int cycles)
{
  smg::DeformOptions options;
  options.weights = weights;
  options.cycles = cycles;
  options.tolerance = 1e-4;
  options.threads = 1;
  return options;
}

/** A frame of a drag: new angles of the same handles, and the resulting positions. */
void update(benchmark::State& state, const StreamMesh& mesh, smg::Weights weights, int cycles)
{
  std::vector<smg::VertexHandles> frames;
  for (int degrees = 0; degrees < 90; degrees += 10)
  {
    frames.push_back(figureHandles(mesh, degrees).Values);
  }
  MemorySource source(mesh);
  ArrayHandles handles = figureHandles(mesh);
  smg::InteractiveDeformation deformation(source, handles, onOneThread(weights, cycles));
  std::vector<double> positions(3 * mesh.vertices());
  std::size_t frame = 0;
  for (auto _ : state)
  {
    if (!deformation.update(frames[frame++ % frames.size()]))
    {
      state.SkipWithError("other vertices are held");
      break;
    }
    deformation.read(0, mesh.vertices(), positions);
    benchmark::DoNotOptimize(positions.data());
  }
  state.counters["vertices"] = static_cast<double>(mesh.vertices());
  state.counters["cycles"] = deformation.report().cycles;
  state.counters["bound_ms"] = UpdateBound;
}

/** The cost that an update avoids: everything from the start. */
void start(benchmark::State& state, const StreamMesh& mesh, smg::Weights weights, int cycles)
{
  MemorySource source(mesh);
  ArrayHandles handles = figureHandles(mesh);
  for (auto _ : state)
  {
    source.rewind(5000);
    smg::InteractiveDeformation deformation(source, handles, onOneThread(weights, cycles));
    benchmark::DoNotOptimize(deformation.vertices());
  }
}

void addBenchmarks(const StreamMesh& mesh)
{
  for (const smg::Weights weights : { smg::Weights::Clamped, smg::Weights::Uniform })
  {
    const std::string suffix = weights == smg::Weights::Uniform ? "/uniform" : "/cotangent";
    const auto add = [&](const std::string& name, auto function, int cycles)
    {
      benchmark::RegisterBenchmark((name + suffix).c_str(),
        [=, &mesh](benchmark::State& state) { function(state, mesh, weights, cycles); })
        ->Unit(benchmark::kMillisecond);
    };
    add("start/3_cycles", start, 3);
    add("update/3_cycles", update, 3);
    add("update/6_cycles", update, 6);
    add("update/tolerance_1e-4", update, 0);
  }
}

} // namespace

int main(int argc, char** argv)
try
{
  benchmark::Initialize(&argc, argv);
  const StreamMesh mesh = argc > 1 ? previewOf(argv[1]) : toStream(torus(142, 71, 0.2));
  addBenchmarks(mesh);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_interactive: " << error.what() << '\n';
  return 1;
}
