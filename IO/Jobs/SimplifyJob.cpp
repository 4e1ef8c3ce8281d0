// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/SimplifyJob.h"

#include "IO/Jobs/JobOption.h"
#include "smg/Error.h"

namespace smg
{
namespace
{

template <class Value, auto Member>
constexpr OptionMember<Value> SimplifyTargetMember =
  memberOf<Value, SimplifyJob, &SimplifyJob::target, Member>;
template <class Value, auto Member>
constexpr OptionMember<Value> SimplifyMember =
  memberOf<Value, SimplifyJob, &SimplifyJob::options, Member>;

/** 0 stands for none. */
template <class Value, auto Member>
constexpr OptionMember<Value> AboveZero{ [](const Job& job)
  {
    const std::optional<Value> value = SimplifyTargetMember<Value, Member>.get(job);
    return *value > 0 ? value : std::nullopt;
  },
  SimplifyTargetMember<Value, Member>.set };

constexpr auto SimplifyTable = joined(
  std::array{
    JobOption{ .key = "vertices",
      .kind = CountOption{ AboveZero<std::int64_t, &SimplifyTarget::vertices>,
        SimplifyTarget::MinVertices, SimplifyTarget::MaxVertices },
      .help = "Maximum number of vertices",
      .property = "NumberOfVertices" },
    JobOption{ .key = "error",
      .kind = NumberOption{ AboveZero<double, &SimplifyTarget::error>,
        { .least = 0.0, .isOpen = true }, "the unit of the mesh" },
      .help =
        "Largest distance from the planes of the triangles that were there; at sharp edges of "
        "thin parts the surface may be farther away",
      .property = "MaximumError" },
    JobOption{ .key = "hold",
      .kind = WhereOption{ SimplifyMember<std::vector<Where>, &SimplifyOptions::hold> },
      .help = "Parts of the mesh whose points all stay" },
    JobOption{ .key = "text",
      .kind = FlagOption{ SimplifyMember<bool, &SimplifyOptions::text> },
      .help = "Write text where the format may be binary or text",
      .isCommon = true,
      .property = "" },
    JobOption{ .key = "checkpoint",
      .kind = FolderOption{ SimplifyMember<std::filesystem::path, &SimplifyOptions::checkpoint> },
      .help = "Folder from which the same job, run again, continues if it was killed",
      .isAdvanced = true,
      .isCommon = true,
      .property = "" },
  },
  LimitOptions, ScratchLimitOption);

} // namespace

std::span<const JobOption> SimplifyJob::table() const
{
  return SimplifyTable;
}

void SimplifyJob::setLimits(const JobLimits& given)
{
  this->options.memoryLimit = given.memory > 0 ? given.memory : this->options.memoryLimit;
  this->options.threads = given.threads;
  this->options.scratch = given.scratch;
  this->options.scratchLimit = given.scratchLimit;
}

void SimplifyJob::check() const
{
  if (this->target.vertices == 0 && this->target.error == 0.0)
  {
    throw Error(this->name + ": needs \"vertices\", \"error\" or both.");
  }
}

} // namespace smg
