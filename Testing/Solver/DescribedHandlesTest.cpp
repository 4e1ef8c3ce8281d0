// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedHandles.h"
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

/** Three vertices, the last of which is held; columns in any order, with others. */
class DescribedHandlesTest : public ::testing::Test
{
protected:
  DescribedHandlesTest()
  {
    this->Block.positions.assign(9, 0.0);
    this->Block.vertexColumns = { makeColumn<double>("Other", std::vector<double>(3, NaN)),
      makeColumn<double>(HandleLogScaleName, std::vector<double>{ NaN, 0.0, 0.5 }),
      makeColumn<float>(HandleTargetName, std::vector<float>{ 0, 0, NAN, 0, 0, 0, 1, 2, 3 }, 3),
      makeColumn<double>(HandleRotationName, std::vector<double>{ 0, 0, 0, 0, 0, 0, 4, 5, 6 }, 3),
      makeColumn<std::uint8_t>(HandleMaskName, std::vector<std::uint8_t>{ 0, 0, 2 }) };
  }

  VertexHandles read(const DeformationDescription& description) const
  {
    StreamInfo info;
    for (const Column& column : this->Block.vertexColumns)
    {
      info.vertexColumns.push_back(column.spec);
    }
    VertexHandles handles;
    handles.clear(3);
    DescribedHandles(description, info, "it").at(this->Block, handles);
    return handles;
  }
  VertexHandles read() const { return this->read(DeformationDescription::byColumns()); }

  MeshBlock Block;
};

TEST_F(DescribedHandlesTest, ReadsTheColumnsWhateverTheirTypes)
{
  const VertexHandles handles = this->read();
  EXPECT_EQ(handles.mask, (std::vector<std::uint8_t>{ 0, 0, 2 }));
  EXPECT_EQ(handles.target[8], 3.0);
  EXPECT_EQ(handles.rotation[7], 5.0);
  EXPECT_EQ(handles.logScale[2], 0.5);
}

TEST_F(DescribedHandlesTest, MaskOfAnotherTypeCountsToo)
{
  Column& mask = this->Block.vertexColumns[4];
  mask = makeColumn<double>(HandleMaskName, std::vector<double>{ 0.0, 0.25, 1e9 });
  EXPECT_EQ(this->read().mask, (std::vector<std::uint8_t>{ 0, 1, 255 }));
  mask = makeColumn<double>(HandleMaskName, std::vector<double>{ 0.0, NaN, 0.0 });
  expectError([this] { this->read(); }, "it: handles[0].region.mask: is not a number at vertex 1");
}

TEST_F(DescribedHandlesTest, WhatIsNotFiniteIsAnErrorWhereAVertexIsHeld)
{
  Column& rotation = this->Block.vertexColumns[3];
  rotation = makeColumn<double>(
    HandleRotationName, std::vector<double>{ 0, 0, 0, 0, 0, 0, 0, HUGE_VAL, 0 }, 3);
  expectError([this] { this->read(); },
    "it: handles[0]: the column 'HandleRotation' is not a finite number at vertex 2");
}

TEST_F(DescribedHandlesTest, AbsentOrIllShapedColumnsAreErrors)
{
  const MeshBlock good = this->Block;
  for (int column = 1; column < 5; ++column)
  {
    this->Block = good;
    Column& changed = this->Block.vertexColumns[column];
    const std::string name = changed.spec.name;
    changed.spec.components = 2;
    expectError([this] { this->read(); }, "the column" + std::string(column < 4 ? " '" : ""));
    changed.spec.name = "Else";
    expectError([this] { this->read(); }, "the mesh has no column '" + name + "'");
  }
}

TEST_F(DescribedHandlesTest, LaterHandlesWinAndNumbersHoldEverywhere)
{
  DeformationDescription description = DeformationDescription::byColumns();
  HandleDescription::Values grown;
  grown.logScale = 0.25;
  description.handles.insert(description.handles.begin(), { Everywhere{}, grown });
  HandleMotion::Parameters aside;
  aside.translation = { 1, 0, 0 };
  description.handles.push_back({ Region(Region::Vertices{ { 0 } }), HandleMotion(aside) });
  const VertexHandles handles = this->read(description);
  EXPECT_EQ(handles.mask, (std::vector<std::uint8_t>{ 2, 1, 3 }));
  EXPECT_EQ(handles.target, (std::vector<double>{ 1, 0, 0, 0, 0, 0, 1, 2, 3 }));
  EXPECT_EQ(handles.logScale, (std::vector<double>{ 0.0, 0.25, 0.5 }));
}

TEST_F(DescribedHandlesTest, WhatIsKnownOnlyAtTheEndIsPreparedOrRefused)
{
  DeformationDescription description;
  description.handles = { { NearestVertices{ { { 0, 0, 0 } } }, HandleMotion() } };
  expectError([&] { this->read(description); },
    "What handles[0] holds is known only when the mesh has been read once before");
}

} // namespace
} // namespace smg::testing
