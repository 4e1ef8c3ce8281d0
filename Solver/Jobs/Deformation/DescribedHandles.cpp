// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedHandles.h"
#include "Solver/Problem/Coefficient.h"
#include "Solver/Problem/NearestSelection.h"
#include "Solver/Problem/Selection.h"
#include "smg/Deform.h"
#include "smg/DeformationDescription.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// The handles of a description on a mesh, block by block of the stream: what each handle selects
// (Selection) and where it puts the vertices that it holds, either by one affine map or by values
// of the mesh (Coefficient). Handles are applied in their order, so that the last one that holds a
// vertex determines it.
//
// All of this depends on the vertex alone, hence not on blocks. In memory are one block, and the
// marks of open vertices that some selections keep.

namespace smg
{

/** The handles of a description, resolved on a mesh. */
struct DescribedHandles::OnMesh
{
  /** The values of a handle at each vertex. */
  struct Values
  {
    Coefficient target, rotation, logScale;
    std::vector<std::array<double, 3>> targets; ///< one for each nearest vertex, or none
  };
  struct Handle
  {
    const Selection* where = nullptr;          ///< null: everywhere
    const NearestSelection* nearest = nullptr; ///< the same, of targets
    std::optional<NamedColumn> mask;           ///< which selects and counts
    HandleMotion motion;                       ///< if there are no values
    std::optional<Values> values;
    std::string key;
    std::int64_t following = 0; ///< vertices so far not held by a later handle
    bool moves = false;         ///< whether one that follows it is moved, rotated or scaled, so far
  };

  OnMesh(const StreamInfo& info, const std::string& name)
    : mesh(info, name)
    , selections(this->mesh)
  {
  }

  Handle compile(const HandleDescription& handle, const std::string& key);
  /** Adds the targets of nearest vertices. */
  void compileTargets(const HandleDescription& description,
    const std::vector<std::array<double, 3>>& targets, Handle& handle);
  /** Starts a block; returns whether the handle holds each of its vertices. */
  std::span<const std::uint8_t> startBlock(Handle& handle, const MeshBlock& block);
  /** Sets the values of the handle at the `held` vertices of the block. */
  void hold(const Handle& handle, const MeshBlock& block, std::span<const std::uint8_t> held,
    VertexHandles& to) const;
  void setMotion(const Handle& handle, const MeshBlock& block, std::span<const std::uint8_t> held,
    VertexHandles& to) const;
  void setValues(const Handle& handle, const MeshBlock& block, std::span<const std::uint8_t> held,
    VertexHandles& to) const;
  /** See DescribedHandles::notes(). Null: the blocks were the whole mesh. */
  std::vector<std::string> notes(MeshParts* parts) const;

  MeshColumns mesh;
  Selections selections;
  std::vector<Handle> handles;
  std::vector<std::uint8_t> everywhere; ///< 1 at each vertex of a block
  std::vector<Handle*> followed;        ///< the handle of each vertex of a block; null: free
};

DescribedHandles::DescribedHandles(
  const DeformationDescription& description, const StreamInfo& mesh, const std::string& name)
  : Data(std::make_unique<OnMesh>(mesh, name))
{
  for (std::size_t k = 0; k < description.handles.size(); ++k)
  {
    this->Data->handles.push_back(
      this->Data->compile(description.handles[k], "handles[" + std::to_string(k) + "]"));
  }
}

DescribedHandles::~DescribedHandles() = default;

std::vector<std::string> DescribedHandles::vertexColumns() const
{
  return this->Data->mesh.vertexColumns();
}

std::vector<std::string> DescribedHandles::cellColumns() const
{
  return this->Data->mesh.cellColumns();
}

void DescribedHandles::prepare(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->preparePart(mesh, scratch, memoryLimit);
  this->Data->selections.endPreparing(nullptr);
}

void DescribedHandles::preparePart(
  MeshSource& part, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->Data->selections.prepare(part, scratch, memoryLimit);
}

/** A handle without a vertex is an error, which names its place in the description. */
void DescribedHandles::endPreparing(MeshParts& parts)
{
  this->Data->selections.endPreparing(&parts);
}

std::int64_t DescribedHandles::bytes() const
{
  return this->Data->mesh.memory().used();
}

std::vector<std::string> DescribedHandles::notes() const
{
  return this->Data->notes(nullptr);
}

std::vector<std::string> DescribedHandles::notes(MeshParts& parts) const
{
  return this->Data->notes(&parts);
}

namespace
{

constexpr double MaxHandles = std::numeric_limits<std::uint8_t>::max();

ValueRules vectorRules(bool positions)
{
  return { .components = { 3 }, .positions = positions };
}

/** Whether the handles move held vertex `i`, or prescribe a rotation or scale. */
bool moves(const MeshBlock& block, std::size_t i, const VertexHandles& handles)
{
  const double* point = block.positions.data() + 3 * i;
  const double* turn = handles.rotation.data() + 3 * i;
  // Compared exactly: a handle that keeps a vertex gives back its very position.
  return !std::equal(point, point + 3, handles.target.data() + 3 * i) ||
         std::any_of(turn, turn + 3, [](double number) { return number != 0.0; }) ||
         handles.logScale[i] != 0.0;
}

} // namespace

DescribedHandles::OnMesh::Handle DescribedHandles::OnMesh::compile(
  const HandleDescription& description, const std::string& key)
{
  Handle handle;
  handle.key = key;
  handle.where = this->selections.add(
    description.where, DataPlace::Vertices, ColumnOwner::Vertices, key + ".region");
  // The mask of an earlier filter counts how many handles hold the vertex.
  const auto* mask = std::get_if<ColumnMask>(&description.where);
  if (mask && !this->mesh.isOfCells(mask->column, ColumnOwner::Vertices))
  {
    handle.mask = this->mesh.require(mask->column, ColumnOwner::Vertices, key + ".region.mask");
  }
  if (const auto* values = std::get_if<HandleDescription::Values>(&description.motion))
  {
    const auto valueOf = [&](const DataValue& value, const ValueRules& rules, const char* member)
    { return Coefficient(value, DataPlace::Vertices, rules, key + member, this->mesh); };
    handle.values.emplace(Values{ valueOf(values->target, vectorRules(true), ".target"),
      valueOf(values->rotation, vectorRules(false), ".rotation"),
      valueOf(values->logScale, { .components = { 1 } }, ".logScale"), {} });
    // Targets of nearest vertices, one for each point, take the place of the values of `target`.
    if (!values->targets.empty())
    {
      this->compileTargets(description, values->targets, handle);
    }
  }
  else
  {
    handle.motion = std::get<HandleMotion>(description.motion);
    handle.moves = !handle.motion.isIdentity();
  }
  return handle;
}

void DescribedHandles::OnMesh::compileTargets(const HandleDescription& description,
  const std::vector<std::array<double, 3>>& targets, Handle& handle)
{
  const auto* nearest = std::get_if<NearestVertices>(&description.where);
  if (!nearest || nearest->points.size() != targets.size())
  {
    const std::string points =
      nearest ? "the region " + std::to_string(nearest->points.size()) : "the region no nearest";
    this->mesh.fail(handle.key + ".target", "has " + std::to_string(targets.size()) +
                                              " positions, " + points +
                                              " points: give one position for each");
  }
  for (const std::array<double, 3>& target : targets)
  {
    if (!std::ranges::all_of(target, [](double number) { return std::isfinite(number); }))
    {
      this->mesh.fail(handle.key + ".target", "must have finite coordinates");
    }
  }
  // It has been made of the NearestVertices above.
  handle.nearest = dynamic_cast<const NearestSelection*>(handle.where);
  handle.values->targets = targets;
}

/** Starts a block in the selection and in the values, which must see every block. */
std::span<const std::uint8_t> DescribedHandles::OnMesh::startBlock(
  Handle& handle, const MeshBlock& block)
{
  if (handle.values)
  {
    handle.values->target.startBlock(block);
    handle.values->rotation.startBlock(block);
    handle.values->logScale.startBlock(block);
  }
  if (!handle.where)
  {
    this->everywhere.assign(static_cast<std::size_t>(block.vertices()), 1);
    return this->everywhere;
  }
  return handle.where->atVertices();
}

/** Applies the handles to the vertices of a block in their order. Throws Error, which names the
 * column and the vertex, if a number is not finite. */
void DescribedHandles::at(const MeshBlock& block, VertexHandles& handles)
{
  OnMesh& data = *this->Data;
  for (const OnMesh::Handle& handle : data.handles)
  {
    if (handle.where && handle.where->needsPreparing())
    {
      throw Error("What " + handle.key +
                  " holds is known only when the mesh has been read once before: call "
                  "DescribedHandles::prepare().");
    }
  }
  data.selections.startBlock(block);
  // Each vertex follows the last handle that holds it; notes() needs to know how many follow each.
  data.followed.assign(static_cast<std::size_t>(block.vertices()), nullptr);
  for (OnMesh::Handle& handle : data.handles)
  {
    const std::span<const std::uint8_t> held = data.startBlock(handle, block);
    data.hold(handle, block, held, handles);
    for (std::size_t i = 0; i < held.size(); ++i)
    {
      data.followed[i] = held[i] ? &handle : data.followed[i];
    }
  }
  for (std::size_t i = 0; i < data.followed.size(); ++i)
  {
    if (OnMesh::Handle* handle = data.followed[i])
    {
      ++handle->following;
      handle->moves = handle->moves || (handle->values && moves(block, i, handles));
    }
  }
}

/** Counts the handles that hold a vertex, which is reported, and sets what this one prescribes
 * there. */
void DescribedHandles::OnMesh::hold(const Handle& handle, const MeshBlock& block,
  std::span<const std::uint8_t> held, VertexHandles& to) const
{
  const Column* counts = handle.mask ? &handle.mask->in(block) : nullptr;
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    if (held[i])
    {
      // At least 1, however small the number in the mask is; the counter of a vertex has 8 bits.
      const double count = counts ? std::max(1.0, std::ceil(counts->value(i))) : 1.0;
      to.mask[i] = static_cast<std::uint8_t>(std::min(to.mask[i] + count, MaxHandles));
    }
  }
  handle.values ? this->setValues(handle, block, held, to)
                : this->setMotion(handle, block, held, to);
}

/** Moves held vertices by the affine map; rotation and scale are the same for all of them. */
void DescribedHandles::OnMesh::setMotion(const Handle& handle, const MeshBlock& block,
  std::span<const std::uint8_t> held, VertexHandles& to) const
{
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    if (held[i])
    {
      const std::span<const double, 3> point(block.positions.data() + 3 * i, 3);
      std::ranges::copy(handle.motion.apply(point), to.target.data() + 3 * i);
      std::ranges::copy(handle.motion.rotation(), to.rotation.data() + 3 * i);
      to.logScale[i] = handle.motion.logScale();
    }
  }
}

void DescribedHandles::OnMesh::setValues(const Handle& handle, const MeshBlock& block,
  std::span<const std::uint8_t> held, VertexHandles& to) const
{
  const Values& values = *handle.values;
  const auto set = [&](const Coefficient& value, std::vector<double>& numbers)
  {
    const Coefficient::InBlock given = value.in(block);
    const auto components = static_cast<std::size_t>(value.components());
    for (std::size_t i = 0; i < held.size(); ++i)
    {
      double* of = numbers.data() + i * components;
      if (held[i])
      {
        // Only at held vertices: elsewhere the column may have anything.
        given.atVertex(i, of);
        if (!std::all_of(of, of + components, [](double number) { return std::isfinite(number); }))
        {
          this->mesh.fail(handle.key, value.name() + " is not a finite number at " +
                                        this->mesh.vertexName(block, i) + ", which is held");
        }
      }
    }
  };
  if (handle.nearest)
  {
    for (std::size_t i = 0; i < held.size(); ++i)
    {
      if (held[i])
      {
        // Several points may have the same nearest vertex: the last one counts, see
        // NearestSelection::pointOf().
        const std::size_t point =
          handle.nearest->pointOf(block.firstVertex + static_cast<std::int64_t>(i));
        std::ranges::copy(values.targets[point], to.target.data() + 3 * i);
      }
    }
  }
  else
  {
    set(values.target, to.target);
  }
  set(values.rotation, to.rotation);
  set(values.logScale, to.logScale);
}

std::vector<std::string> DescribedHandles::OnMesh::notes(MeshParts* parts) const
{
  std::vector<std::int64_t> following, moving;
  for (const Handle& handle : this->handles)
  {
    following.push_back(handle.following);
    moving.push_back(handle.following > 0 && handle.moves ? 1 : 0);
  }
  // A handle may hold vertices of other parts only.
  if (parts)
  {
    parts->sum(following);
    parts->sum(moving);
  }
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < following.size(); ++k)
  {
    // All of its vertices follow later handles: probably not intended, but not wrong.
    if (following[k] == 0)
    {
      notes.push_back(this->handles[k].key + " holds nothing that a later handle does not hold.");
    }
  }
  if (std::ranges::count(moving, 0) == std::ssize(moving))
  {
    notes.emplace_back("No handle moves anything: OUT is IN.");
  }
  return notes;
}

} // namespace smg
