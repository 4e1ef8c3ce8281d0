// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/HandleFile.h"

#include "IO/Problem/ParseWhere.h"
#include "IO/Problem/WeightsName.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace smg
{

namespace
{

constexpr std::int64_t MostCycles = 1000000;

std::array<double, 3> parseVector(const JsonNode& node)
{
  const std::vector<double> numbers = node.numbers(3);
  return { numbers[0], numbers[1], numbers[2] };
}

void parseRotation(const JsonNode& node, HandleMotion::Parameters& motion)
{
  node.requireObject({ "axis", "degrees", "center" });
  const JsonNode axis = node.member("axis");
  motion.axis = parseVector(axis);
  if (motion.axis == std::array<double, 3>{})
  {
    axis.fail("must have a direction: its numbers must not all be 0");
  }
  const JsonNode degrees = node.member("degrees");
  motion.degrees = degrees.number();
  if (!HandleMotion::isAngle(motion.degrees))
  {
    degrees.fail(HandleMotion::DegreesRule);
  }
}

/** What a handle turns and grows about. */
std::array<double, 3> parseCenter(const JsonNode& handle, const Region& region)
{
  const bool inRotation = handle.has("rotate") && handle.member("rotate").has("center");
  if (inRotation && handle.has("center"))
  {
    handle.member("center").fail("stands here and in rotate: leave one out");
  }
  if (inRotation || handle.has("center"))
  {
    return parseVector((inRotation ? handle.member("rotate") : handle).member("center"));
  }
  const std::optional<std::array<double, 3>> middle = region.center();
  if (!middle)
  {
    handle.fail("turns or grows about no point: add \"center\": [x, y, z]");
  }
  return *middle;
}

HandleMotion parseMotion(const JsonNode& handle, const Region& region)
{
  HandleMotion::Parameters motion;
  if (handle.has("translate"))
  {
    motion.translation = parseVector(handle.member("translate"));
  }
  if (handle.has("rotate"))
  {
    parseRotation(handle.member("rotate"), motion);
  }
  if (handle.has("scale"))
  {
    const JsonNode scale = handle.member("scale");
    motion.scale = scale.number();
    if (!HandleMotion::isScale(motion.scale))
    {
      scale.fail(HandleMotion::ScaleRule);
    }
  }
  if (handle.has("rotate") || handle.has("scale"))
  {
    motion.center = parseCenter(handle, region);
  }
  else if (handle.has("center"))
  {
    handle.member("center").fail("needs something that is done about it: rotate or scale");
  }
  return HandleMotion(motion);
}

void parseHandle(const JsonNode& handle, HandleFileData& data)
{
  handle.requireObject({ "region", "fixed", "translate", "rotate", "scale", "center" });
  const JsonNode place = handle.member("region");
  place.requireObject(RegionKeys);
  data.regions.push_back(parseRegion(place));

  const bool moves = handle.has("translate") || handle.has("rotate") || handle.has("scale");
  if (handle.has("fixed"))
  {
    const JsonNode fixed = handle.member("fixed");
    if (!fixed.isTrue())
    {
      fixed.fail("can only be true: leave it out for a handle that moves");
    }
    if (moves)
    {
      fixed.fail("goes with no translate, rotate or scale: leave it or these out");
    }
  }
  else if (!moves)
  {
    handle.fail("must be fixed, or have at least one of translate, rotate and scale");
  }
  data.motions.push_back(parseMotion(handle, data.regions.back()));
}

HandleFileData parseHandles(const JsonNode& node)
{
  node.requireObject({ "handles", "weights", "cycles", "tolerance" });
  HandleFileData data;
  const JsonNode handles = node.member("handles");
  for (const JsonNode& handle : handles.elements())
  {
    parseHandle(handle, data);
  }
  if (data.regions.empty())
  {
    handles.fail("must have at least one handle");
  }
  data.weights = parseWeights(node);
  if (node.has("cycles"))
  {
    data.cycles = static_cast<int>(node.member("cycles").integer(1, MostCycles));
  }
  if (node.has("tolerance"))
  {
    const JsonNode tolerance = node.member("tolerance");
    data.tolerance = tolerance.number();
    if (*data.tolerance <= 0.0 || *data.tolerance >= 1.0)
    {
      tolerance.fail("must be between 0 and 1, both excluded");
    }
    if (data.cycles)
    {
      tolerance.fail("does not go with cycles: leave one out");
    }
  }
  return data;
}

} // namespace

HandleFile::HandleFile(HandleFileData data, const StreamInfo& mesh, std::string file)
  : Data(std::move(data))
  , OfMesh(mesh, std::move(file))
{
  for (std::size_t k = 0; k < this->Data.regions.size(); ++k)
  {
    this->Regions.push_back(Selection::make(this->Data.regions[k], DataPlace::Vertices,
      ColumnOwner::Vertices, "handles[" + std::to_string(k) + "].region", this->OfMesh));
  }
}

void HandleFile::at(const MeshBlock& block, VertexHandles& handles)
{
  constexpr std::uint8_t Most = std::numeric_limits<std::uint8_t>::max();
  for (std::size_t k = 0; k < this->Regions.size(); ++k)
  {
    this->Regions[k]->startBlock(block);
    const std::span<const std::uint8_t> selected = this->Regions[k]->atVertices();
    const HandleMotion& motion = this->Data.motions[k];
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      if (selected[i])
      {
        const std::span<const double, 3> point(block.positions.data() + 3 * i, 3);
        const std::array<double, 3> target = motion.apply(point);
        handles.mask[i] = handles.mask[i] < Most ? handles.mask[i] + 1 : Most;
        std::ranges::copy(target, handles.target.data() + 3 * i);
        std::ranges::copy(motion.rotation(), handles.rotation.data() + 3 * i);
        handles.logScale[i] = motion.logScale();
      }
    }
  }
}

std::vector<std::string> HandleFile::check(MeshSource& mesh)
{
  // How many vertices follow each handle: that no later one holds.
  std::vector<std::int64_t> following(this->Regions.size(), 0);
  std::vector<bool> follows;
  for (MeshBlock block; mesh.next(block);)
  {
    follows.assign(static_cast<std::size_t>(block.vertices()), false);
    for (std::size_t k = this->Regions.size(); k-- > 0;)
    {
      this->Regions[k]->prepare(block, {});
      const std::span<const std::uint8_t> selected = this->Regions[k]->atVertices();
      for (std::size_t i = 0; i < selected.size(); ++i)
      {
        following[k] += selected[i] && !follows[i] ? 1 : 0;
        follows[i] = follows[i] || selected[i];
      }
    }
  }
  std::ranges::for_each(
    this->Regions, [](const std::unique_ptr<Selection>& region) { region->endPreparing(); });
  std::vector<std::string> notes;
  bool moves = false;
  for (std::size_t k = 0; k < following.size(); ++k)
  {
    if (following[k] == 0)
    {
      notes.push_back(
        "handles[" + std::to_string(k) + "] holds nothing that a later handle does not hold.");
    }
    else
    {
      moves = moves || !this->Data.motions[k].isIdentity();
    }
  }
  if (!moves)
  {
    notes.emplace_back("No handle moves anything: OUT is IN.");
  }
  return notes;
}

void HandleFile::applyTo(DeformOptions& options) const
{
  options.weights = this->Data.weights.value_or(options.weights);
  if (this->Data.cycles)
  {
    options.cycles = *this->Data.cycles;
  }
  if (this->Data.tolerance)
  {
    options.cycles = 0;
    options.tolerance = *this->Data.tolerance;
  }
}

HandleFileData readHandleFileData(const std::filesystem::path& path)
{
  const nlohmann::json json = readJsonFile(path.string());
  return parseHandles(JsonNode(json, path.string()));
}

std::unique_ptr<HandleFile> readHandleFile(
  const std::filesystem::path& path, const StreamInfo& mesh)
{
  return std::make_unique<HandleFile>(readHandleFileData(path), mesh, path.string());
}

} // namespace smg
