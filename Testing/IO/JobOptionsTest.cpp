// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/DeformJob.h"
#include "IO/Jobs/DistanceJob.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Jobs/ReadOptions.h"
#include "IO/Jobs/SmoothJob.h"
#include "IO/Jobs/SolveJob.h"
#include "Testing/Support/ErrorMessage.h"
#include "smg/Area.h"
#include "smg/Blend.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace smg::testing
{
namespace
{

/** The value that an option has in a job, as a text. */
struct TextOfValue
{
  const Job& job;

  template <class Value>
  static nlohmann::json jsonOf(const Value& value)
  {
    if constexpr (std::is_same_v<Value, std::vector<Where>>)
    {
      return value.size();
    }
    else if constexpr (std::is_same_v<Value, SmoothingSize>)
    {
      return std::pair(value.value, static_cast<int>(value.unit));
    }
    else if constexpr (std::is_same_v<Value, std::filesystem::path>)
    {
      return value.string();
    }
    else
    {
      return value;
    }
  }

  std::string operator()(const auto& option) const
  {
    const auto value = option.member.get(this->job);
    return value ? jsonOf(*value).dump() : "none";
  }
  std::string operator()(const DescriptionOption& /*option*/) const { return "description"; }
};

/** Values of which one at least is allowed, and is not the default. */
std::vector<nlohmann::json> candidates(const JobOption& option)
{
  if (const auto* choice = std::get_if<ChoiceOption>(&option.kind))
  {
    return { choice->names.front(), choice->names.back() };
  }
  if (const auto* count = std::get_if<CountOption>(&option.kind))
  {
    return { count->least + 1, count->least + 2 };
  }
  return { 0.5, 2.25, true, false, "7edges", "/tmp/folder", "5MiB",
    nlohmann::json::array({ "c", "d" }), { { "boundary", true } } };
}

/** All values of the options of a job. */
std::vector<std::string> valuesIn(const Job& job)
{
  std::vector<std::string> values;
  for (const JobOption& option : job.table())
  {
    values.push_back(std::visit(TextOfValue{ job }, option.kind));
  }
  return values;
}

TEST(JobOptions, EachSetsItsMemberAlone)
{
  for (const JobKind& kind : jobKinds())
  {
    const std::span<const JobOption> table = kind.make()->table();
    for (std::size_t k = 0; k < table.size(); ++k)
    {
      if (isKind<DescriptionOption>(table[k]))
      {
        continue;
      }
      SCOPED_TRACE(std::string(kind.name) + " " + table[k].key);
      bool isSet = false;
      for (const nlohmann::json& value : candidates(table[k]))
      {
        const std::unique_ptr<Job> job = kind.make();
        const std::vector<std::string> before = valuesIn(*job);
        if (!messageOf([&] { readOption(JsonNode(value, "test"), table[k], *job); }).empty())
        {
          continue;
        }
        const std::vector<std::string> after = valuesIn(*job);
        for (std::size_t other = 0; other < table.size(); ++other)
        {
          EXPECT_TRUE(other == k || before[other] == after[other]) << table[other].key;
        }
        isSet = isSet || before[k] != after[k];
      }
      EXPECT_TRUE(isSet);
    }
  }
}

TEST(JobOptions, ChoicesAreInTheOrderOfTheirEnumerations)
{
  const auto set = [](const char* kind, const char* key, const char* value)
  {
    std::unique_ptr<Job> job = makeJob(kind);
    const auto option = std::ranges::find(job->table(), std::string_view(key), &JobOption::key);
    const nlohmann::json json(value);
    readOption(JsonNode(json, "test"), *option, *job);
    return job;
  };
  const auto smooth = set("smooth", "boundary", "fixed");
  EXPECT_EQ(static_cast<SmoothJob&>(*smooth).smoothing.boundary, SmoothedBoundary::Fixed);
  EXPECT_EQ(static_cast<SmoothJob&>(*set("smooth", "normals", "drop")).normals, MovedNormals::Drop);
  EXPECT_EQ(static_cast<DistanceJob&>(*set("distance", "accuracy", "exact")).description.accuracy,
    PathAccuracy::Exact);
  EXPECT_EQ(static_cast<SolveJob&>(*set("solve", "acceleration", "cg")).solving.acceleration,
    AccelerationKind::ConjugateGradients);
  EXPECT_EQ(static_cast<DeformJob&>(*set("deform", "weights", "cotangent")).deforming.weights,
    Weights::Cotangent);
  EXPECT_EQ(static_cast<DeformJob&>(*set("deform", "weights", "raw-cotangent")).deforming.weights,
    Weights::Cotangent);
  // Of two the default says it.
  const auto usual = [](const char* kind, std::string_view key)
  {
    const nlohmann::json rows = describe(*makeJob(kind));
    return std::ranges::find(rows, key, [](const auto& row) { return row["key"]; })->at("default");
  };
  EXPECT_EQ(usual("blend", "seam"), "zero");
  EXPECT_EQ(usual("area", "share"), "equal");
  EXPECT_EQ(static_cast<int>(SeamGradient::Zero) + static_cast<int>(AreaShare::Equal), 0);
}

TEST(JobOptions, KeysAreUniqueAndDescribed)
{
  for (const JobKind& kind : jobKinds())
  {
    std::set<std::string> keys;
    for (const auto& row : describe(*kind.make()))
    {
      EXPECT_TRUE(keys.insert(row["key"]).second) << row;
      EXPECT_GT(row["help"].get<std::string>().size(), 8U);
    }
    EXPECT_GE(keys.size(), 7U) << kind.name;
  }
}

TEST(JobOptions, ATableRefusesWhatItDoesNotHave)
{
  const auto message = [](const char* kind, const char* text)
  {
    const nlohmann::json json = nlohmann::json::parse(text);
    const std::unique_ptr<Job> job = makeJob(kind);
    return messageOf([&] { readOptions(JsonNode(json, kind), *job); });
  };
  EXPECT_TRUE(contains(message("smooth", R"({"sise": 1})"), "smooth: sise: is not known here"));
  EXPECT_TRUE(contains(message("blend", R"({"patch": "p"})"), "blend: has no 'columns'"));
  EXPECT_TRUE(contains(
    message("distance", R"({"from": []})"), "distance: from: must have at least one place"));
  EXPECT_TRUE(contains(message("distance", R"({"from": [{}]})"), "not and everywhere"));
  EXPECT_EQ(message("distance", R"({"from": {"boundary": true}, "wall": false, "within": 1})"), "");
  EXPECT_TRUE(contains(message("smooth", R"({"column": "c", "keep_volume": false})"),
    "column: does not go with keep_volume"));
  EXPECT_TRUE(contains(messageOf([] { makeJob("melt"); }), "'melt': the jobs are solve, deform"));
}

} // namespace
} // namespace smg::testing
