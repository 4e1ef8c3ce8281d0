// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Files/FileDescriptor.h"
#include "Testing/Fuzzing/EditedState.h"
#include "Testing/Fuzzing/SmallSolve.h"
#include "Testing/Fuzzing/SolverTargets.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/MemorySource.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

namespace smg::testing
{

namespace
{

/** The checkpoint of a solve that was killed after its second pass. */
class KilledSolve
{
public:
  static const KilledSolve& instance()
  {
    static const KilledSolve solve;
    return solve;
  }

  /** Solves, or continues, with the checkpoint in a folder. */
  std::unique_ptr<Solution> solve(
    const std::filesystem::path& folder, const ProgressFunction& progress = {}) const
  {
    auto options = smallSolve();
    options.maxCycles = 4;
    options.acceleration = AccelerationKind::ConjugateGradients;
    options.checkpoint = { folder, "mesh", "problem" };
    options.progress = progress;
    MemorySource source(this->Mesh);
    ArrayProblem problem = fixedEnds(this->Mesh);
    return smg::solve(source, problem, options);
  }

  /** Writes the files of the checkpoint to a folder, the state with edits. */
  void restore(const std::filesystem::path& folder, std::string_view edits) const
  {
    std::filesystem::create_directory(folder);
    for (const auto& [name, bytes] : this->Files)
    {
      writeBytes(folder / name, name == this->StateName ? editedState(bytes, edits) : bytes);
    }
  }

  /** The values of the solve if it is not killed. */
  const std::vector<double>& values() const { return this->Values; }

private:
  KilledSolve()
  {
    const TemporaryFolder place;
    const std::filesystem::path folder = place / "killed";
    FileDescriptor::setDurable(false);
    try
    {
      this->solve(folder, [&](double) { return Checkpoint::steps(folder) < 2; });
    }
    catch (const Cancelled&)
    {
      this->keep(folder);
    }
    mustHold(!this->StateName.empty(), "the solve was not killed");
    this->Values = valuesOf(*this->solve(place / "whole"));
  }

  /** Keeps the files, of the states only the last one. */
  void keep(const std::filesystem::path& folder)
  {
    std::int64_t most = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
      std::ifstream stream(entry.path(), std::ios::binary);
      std::string bytes{ std::istreambuf_iterator<char>(stream), {} };
      const std::string name = entry.path().filename().string();
      if (name.starts_with(Checkpoint::StateName))
      {
        StateFront front{};
        std::memcpy(&front, bytes.data(), sizeof(front));
        if (front.steps <= most)
        {
          continue;
        }
        this->Files.erase(this->StateName);
        most = front.steps;
        this->StateName = name;
      }
      this->Files[name] = std::move(bytes);
    }
  }

  StreamMesh Mesh = toStream(torus(30, 20, 0.3), TestOrder::BreadthFirst);
  std::map<std::string, std::string> Files;
  std::string StateName;
  std::vector<double> Values;
};

} // namespace

bool runCheckpoint(std::string_view bytes, CellChoice)
{
  FuzzPlace& place = FuzzPlace::instance();
  const KilledSolve& killed = KilledSolve::instance();
  const std::filesystem::path folder = place.path("checkpoint");
  std::filesystem::remove_all(folder);
  killed.restore(folder, bytes);
  return place.run(
    [&]
    {
      std::unique_ptr<Solution> solution;
      // Other numbers may make the solve diverge.
      ofFile(folder, [&] { solution = killed.solve(folder); });
      const std::vector<double> values = valuesOf(*solution);
      mustHold(values.size() == killed.values().size(), "the solution has another size");
      // Edits may change numbers of the solve.
      mustHold(!bytes.empty() || values == killed.values(), "the solve continued with other bits");
      solution->removeCheckpoint();
    });
}

} // namespace smg::testing
