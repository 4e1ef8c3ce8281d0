// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyPlan.h"

#include "IO/Mesh/AttributeNames.h"

#include <algorithm>
#include <array>
#include <utility>

namespace smg
{

namespace
{

/** The column of a property, and its component in it. */
std::pair<ColumnSpec, int> columnOf(const PlyElement& element, const PlyProperty& property)
{
  struct Group
  {
    const char* column;
    std::array<const char*, 4> names;
  };
  constexpr Group groups[] = { { NormalsName, { "nx", "ny", "nz", "" } },
    { ColorsName, { "red", "green", "blue", "alpha" } } };
  constexpr int LeastMembers = 3;
  for (const Group& candidate : groups)
  {
    int components = 0;
    int component = -1;
    for (const char* name : candidate.names)
    {
      const PlyProperty* member = findNumber(element, name);
      if (!member || member->type != property.type)
      {
        break;
      }
      component = member == &property ? components : component;
      ++components;
    }
    if (component >= 0 && components >= LeastMembers)
    {
      return { { candidate.column, property.type, components }, component };
    }
  }
  return { { property.name, property.type, 1 }, 0 };
}

/** Makes the columns of an element, each at its first component. */
class ColumnMaker
{
public:
  ColumnMaker(PlyPlan& plan, const std::function<int(const ColumnSpec&)>& add)
    : Plan(plan)
    , Add(add)
  {
  }

  /** The step of a component of a column. */
  PlyStep step(const ColumnSpec& spec, int component)
  {
    auto known = std::ranges::find(this->Columns, spec, &Known::spec);
    if (known == this->Columns.end())
    {
      known = this->Columns.insert(known, { spec, this->Plan.attributeBytes, this->Add(spec) });
      if (known->number >= 0)
      {
        this->Plan.tuples.push_back(
          { known->number, this->Plan.attributeBytes, spec.tupleBytes() });
        this->Plan.attributeBytes += spec.tupleBytes();
      }
    }
    PlyStep step;
    step.type = spec.type;
    step.kind = known->number >= 0 ? PlyStep::Attribute : PlyStep::Skip;
    step.place = known->begin + sizeOf(spec.type) * static_cast<std::size_t>(component);
    return step;
  }

private:
  struct Known
  {
    ColumnSpec spec;
    std::size_t begin; ///< in the record's attributes
    int number;
  };

  PlyPlan& Plan;
  const std::function<int(const ColumnSpec&)>& Add;
  std::vector<Known> Columns;
};

bool isAxis(const PlyProperty& property)
{
  return property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
}

PlyStep stepOfList(const PlyProperty& property, bool mayBeCorners)
{
  const bool corners =
    mayBeCorners && (property.name == "vertex_indices" || property.name == "vertex_index");
  PlyStep step;
  step.kind = corners ? PlyStep::Corners : PlyStep::SkipList;
  step.type = property.type;
  step.lengthType = property.lengthType;
  return step;
}

} // namespace

const PlyProperty* findNumber(const PlyElement& element, std::string_view name)
{
  const auto found = std::ranges::find_if(element.properties,
    [name](const PlyProperty& property) { return property.name == name && !property.list; });
  return found == element.properties.end() ? nullptr : &*found;
}

PlyPlan planOf(
  const PlyElement& element, PlyRole role, const std::function<int(const ColumnSpec&)>& addColumn)
{
  PlyPlan plan;
  ColumnMaker columns(plan, addColumn);
  bool hasCorners = false;
  for (const PlyProperty& property : element.properties)
  {
    PlyStep step;
    step.type = property.type;
    if (property.list)
    {
      step = stepOfList(property, role == PlyRole::Cells && !hasCorners);
      hasCorners |= step.kind == PlyStep::Corners;
    }
    else if (role == PlyRole::Vertices && isAxis(property))
    {
      step.kind = PlyStep::Coordinate;
      step.place = static_cast<std::size_t>(property.name[0] - 'x');
    }
    else if (role != PlyRole::Others && addColumn)
    {
      const auto [spec, component] = columnOf(element, property);
      step = columns.step(spec, component);
    }
    const bool more = !plan.steps.empty() && step.kind == PlyStep::Skip &&
                      plan.steps.back().kind == PlyStep::Skip &&
                      plan.steps.back().type == step.type;
    more ? void(++plan.steps.back().count) : plan.steps.push_back(step);
  }
  return plan;
}

} // namespace smg
