// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "IO/Description/OptionValues.h"
#include "IO/Jobs/Job.h"
#include "IO/Jobs/MeshJob.h"
#include "smg/Region.h"
#include "smg/Smooth.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

// What jobs are asked, in a table each. Whatever must know the options of a job follows its table:
// the command line (Examples/smg/JobOptions.cpp), descriptions in JSON (ReadOptions.cpp), which the
// interface for C takes and describes, signatures and docstrings of Python (_jobs.py), and the
// tables of the documents.

namespace smg
{

/** Reads and sets what an option is kept in. */
template <class Value>
struct OptionMember
{
  std::optional<Value> (*get)(const Job& job); ///< none: it has not been given
  void (*set)(Job& job, Value value);
};

// The kinds of options.

struct NumberOption
{
  OptionMember<double> member;
  NumberRange range = {};
  const char* unit = "";
  const char* zero = nullptr; ///< a text that stands for 0, which is not in the range
};

struct CountOption
{
  OptionMember<std::int64_t> member;
  std::int64_t least, most;
};

struct BytesOption
{
  OptionMember<std::int64_t> member;
};

struct FlagOption
{
  OptionMember<bool> member;
};

/** One of some names, in the order of an enumeration. */
struct ChoiceOption
{
  OptionMember<std::size_t> member;
  std::span<const char* const> names;
  const char* formerName = nullptr; ///< which is still taken for the place `former`
  std::size_t former = 0;
};

/** The name of a column of the mesh. */
struct ColumnOption
{
  OptionMember<std::string> member;
};

struct ColumnsOption
{
  OptionMember<std::vector<std::string>> member;
};

/** Parts of the mesh. */
struct WhereOption
{
  OptionMember<std::vector<Where>> member;
};

/** The size of details. */
struct SizeOption
{
  OptionMember<SmoothingSize> member;
};

struct FolderOption
{
  OptionMember<std::filesystem::path> member;
};

/** A description with keys of its own, as a problem; on the command line, a file. */
struct DescriptionOption
{
  void (*read)(const JsonNode& node, Job& job);
};

using OptionKind = std::variant<NumberOption, CountOption, BytesOption, FlagOption, ChoiceOption,
  ColumnOption, ColumnsOption, WhereOption, SizeOption, FolderOption, DescriptionOption>;

/** A row of the table of a job. */
struct JobOption
{
  const char* key; ///< in JSON and Python; on the command line with -- and hyphens
  OptionKind kind;
  const char* help; ///< a sentence without its end
  bool isRequired = false;
  bool isAdvanced = false;
  bool isCommon = false; ///< a command has it as all commands have
  /** The keys of earlier options that do not go with it, as without effect beside it. */
  std::array<const char*, 3> excludes = {};
  /** Of the filter in VTK, if it is not the key as SeveralWords; "": none, or one that is more than
   * its value. */
  const char* property = nullptr;
};

template <class Kind>
bool isKind(const JobOption& option)
{
  return std::holds_alternative<Kind>(option.kind);
}

namespace option
{

template <class>
inline constexpr bool isOptional = false;
template <class Value>
inline constexpr bool isOptional<std::optional<Value>> = true;

/** The member at the end of a path of members. */
template <auto First, auto... Rest>
constexpr auto& at(auto& object)
{
  if constexpr (sizeof...(Rest) == 0)
  {
    return object.*First;
  }
  else
  {
    return at<Rest...>(object.*First);
  }
}

/** A member of a job as the value of an option. */
template <class Value, class Member>
std::optional<Value> valueOf(const Member& member)
{
  if constexpr (isOptional<Member>)
  {
    return member ? std::optional<Value>(static_cast<Value>(*member)) : std::nullopt;
  }
  else
  {
    return static_cast<Value>(member);
  }
}

/** Sets a member, perhaps of an enumeration, to the value of an option. */
template <class Value, class Member>
void assign(Member& member, Value value)
{
  if constexpr (isOptional<Member>)
  {
    member = static_cast<typename Member::value_type>(std::move(value));
  }
  else
  {
    member = static_cast<Member>(std::move(value));
  }
}

} // namespace option

/** The member of jobs of the class Owner to which a path of members leads. */
template <class Value, class Owner, auto... Path>
inline constexpr OptionMember<Value> memberOf{ [](const Job& job)
  { return option::valueOf<Value>(option::at<Path...>(static_cast<const Owner&>(job))); },
  [](Job& job, Value value)
  { option::assign(option::at<Path...>(static_cast<Owner&>(job)), std::move(value)); } };

/** The same of the options of the solver. */
template <class Value, auto... Path>
inline constexpr OptionMember<Value> solverMember{ [](const Job& job)
  {
    return option::valueOf<Value>(
      option::at<Path...>(static_cast<const SolvingJob&>(job).options()));
  },
  [](Job& job, Value value)
  {
    option::assign(option::at<Path...>(static_cast<SolvingJob&>(job).options()), std::move(value));
  } };

/** One table of several. */
template <std::size_t... Sizes>
constexpr auto joined(const std::array<JobOption, Sizes>&... tables)
{
  return std::apply([](const auto&... rows)
    { return std::array<JobOption, (Sizes + ...)>{ rows... }; },
    std::tuple_cat(tables...));
}

/** A table in which the option of a key does not go with another one. */
template <std::size_t Size>
constexpr std::array<JobOption, Size> excluding(
  std::array<JobOption, Size> table, std::string_view key, const char* other)
{
  for (JobOption& option : table)
  {
    option.excludes[0] = option.key == key ? other : option.excludes[0];
  }
  return table;
}

/** What a job may take. */
inline constexpr std::array LimitOptions{
  JobOption{ .key = "memory",
    .kind = BytesOption{ memberOf<std::int64_t, Job, &Job::limits, &JobLimits::memory> },
    .help = "Limit of the accounted memory, in bytes or with a unit, as 2GB",
    .isCommon = true,
    .property = "MemoryLimit" },
  JobOption{ .key = "threads",
    .kind = CountOption{ memberOf<std::int64_t, Job, &Job::limits, &JobLimits::threads>, 0, 1024 },
    .help = "Threads that compute; 0: one for each core. The result does not depend on it",
    .isCommon = true,
    .property = "NumberOfThreads" },
  JobOption{ .key = "scratch",
    .kind = FolderOption{ memberOf<std::filesystem::path, Job, &Job::limits, &JobLimits::scratch> },
    .help = "Folder for scratch files",
    .isCommon = true,
    .property = "ScratchDirectory" },
};

/** What the scratch files may take. */
inline constexpr std::array ScratchLimitOption{
  JobOption{ .key = "scratch_limit",
    .kind = BytesOption{ memberOf<std::int64_t, Job, &Job::limits, &JobLimits::scratchLimit> },
    .help = "Limit of the scratch files that exist at once, in bytes or with a unit",
    .isAdvanced = true,
    .isCommon = true },
};

/** The relative residual. */
inline constexpr std::array ToleranceOptions{
  JobOption{ .key = "tolerance",
    .kind = NumberOption{ solverMember<double, &SolveOptions::tolerance>, { 0.0, 1.0, true } },
    .help = "Relative residual to stop at" },
};

/** How equations are solved. */
inline constexpr std::array SolverOptions{
  JobOption{ .key = "max_cycles",
    .kind = CountOption{ solverMember<std::int64_t, &SolveOptions::maxCycles>, 1, 1000000 },
    .help = "Maximum number of V-cycles, of each step if there are several",
    .property = "MaximumCycles" },
  JobOption{ .key = "sweeps",
    .kind = CountOption{ solverMember<std::int64_t, &SolveOptions::sweeps>, 1, 20 },
    .help = "Gauss-Seidel sweeps before and after a coarse-grid correction",
    .isAdvanced = true },
  JobOption{ .key = "in_core",
    .kind = FlagOption{ solverMember<bool, &SolveOptions::inCore> },
    .help = "Keep everything in memory and use no scratch files; the result is the same, bit for "
            "bit",
    .isAdvanced = true,
    .property = "" },
};

/** Where a killed job continues from. */
inline constexpr std::array CheckpointOption{
  JobOption{ .key = "checkpoint",
    .kind = FolderOption{ solverMember<std::filesystem::path, &SolveOptions::checkpoint,
      &CheckpointOptions::folder> },
    .help = "Folder from which the same job, run again, continues if it was killed",
    .isAdvanced = true,
    .isCommon = true,
    .property = "CheckpointDirectory" },
};

/** In the order of MovedNormals. */
inline constexpr const char* NormalsNames[] = { "recompute", "drop" };

/** Of jobs that move vertices. */
template <class Owner>
inline constexpr std::array NormalsOption{
  JobOption{ .key = "normals",
    .kind = ChoiceOption{ memberOf<std::size_t, Owner, &Owner::normals>, NormalsNames },
    .help = "Columns Normals of the mesh: recompute (tetrahedra: drop) or drop" },
};

} // namespace smg
