// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/ColumnHandles.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/StreamMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace smg::testing
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/** Three vertices from 100 on, the last of which is held; columns in any order, with others. */
class ColumnHandlesTest : public ::testing::Test
{
protected:
  ColumnHandlesTest()
  {
    this->Block.firstVertex = 100;
    this->Block.positions.assign(9, 0.0);
    this->Block.vertexColumns = { makeColumn<double>("Other", std::vector<double>(3, NaN)),
      makeColumn<double>(HandleLogScaleName, std::vector<double>{ NaN, 0.0, 0.5 }),
      makeColumn<float>(HandleTargetName, std::vector<float>{ 0, 0, NAN, 0, 0, 0, 1, 2, 3 }, 3),
      makeColumn<double>(HandleRotationName, std::vector<double>{ 0, 0, 0, 0, 0, 0, 4, 5, 6 }, 3),
      makeColumn<std::uint8_t>(HandleMaskName, std::vector<std::uint8_t>{ 0, 0, 2 }) };
  }

  std::vector<ColumnSpec> specs() const
  {
    std::vector<ColumnSpec> specs;
    for (const Column& column : this->Block.vertexColumns)
    {
      specs.push_back(column.spec);
    }
    return specs;
  }

  VertexHandles read() const
  {
    VertexHandles handles;
    handles.clear(3);
    ColumnHandles(this->specs()).at(this->Block, handles);
    return handles;
  }

  MeshBlock Block;
};

TEST_F(ColumnHandlesTest, ReadsTheColumnsWhateverTheirTypes)
{
  const VertexHandles handles = this->read();
  EXPECT_EQ(handles.mask, (std::vector<std::uint8_t>{ 0, 0, 2 }));
  EXPECT_EQ(handles.target[8], 3.0);
  EXPECT_EQ(handles.rotation[7], 5.0);
  EXPECT_EQ(handles.logScale[2], 0.5);
}

TEST_F(ColumnHandlesTest, MaskOfAnotherTypeCountsToo)
{
  Column& mask = this->Block.vertexColumns[4];
  mask = makeColumn<double>(HandleMaskName, std::vector<double>{ 0.0, 0.25, 1e9 });
  EXPECT_EQ(this->read().mask, (std::vector<std::uint8_t>{ 0, 1, 255 }));
  for (const double bad : { -1.0, NaN })
  {
    mask = makeColumn<double>(HandleMaskName, std::vector<double>{ 0.0, bad, 0.0 });
    expectError([this] { this->read(); }, "HandleMask has a value that is no count");
  }
}

TEST_F(ColumnHandlesTest, WhatIsNotFiniteIsAnErrorWhereAVertexIsHeld)
{
  Column& rotation = this->Block.vertexColumns[3];
  rotation = makeColumn<double>(
    HandleRotationName, std::vector<double>{ 0, 0, 0, 0, 0, 0, 0, HUGE_VAL, 0 }, 3);
  expectError([this] { this->read(); }, "HandleRotation has a value that is not a finite number");
  expectError([this] { this->read(); }, "vertex 102");
}

TEST_F(ColumnHandlesTest, AbsentOrIllShapedColumnsAreErrors)
{
  const MeshBlock good = this->Block;
  for (int column = 1; column < 5; ++column)
  {
    this->Block = good;
    Column& changed = this->Block.vertexColumns[column];
    const std::string name = changed.spec.name;
    changed.spec.components = 2;
    expectError([this] { this->read(); }, name + " has 2 components instead of");
    changed.spec.name = "Else";
    expectError([this] { this->read(); }, "no numeric point array " + name);
    expectError([this] { this->read(); }, "put a Mesh Handle before this filter");
  }
}

} // namespace
} // namespace smg::testing
