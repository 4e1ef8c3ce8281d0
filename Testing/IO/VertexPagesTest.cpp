// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/VertexPages.h"

#include "IO/External/Relabelling.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

namespace smg::testing
{

namespace
{

using Ranks = std::vector<std::uint32_t>;

/** The bytes of a whole page, or of its adjacency part. */
Buffer load(Workspace& workspace, VertexPages& pages, std::int64_t page, bool whole)
{
  Buffer bytes(workspace.pool(), whole ? pages.bytes(page) : pages.adjacencyBytes(page));
  pages.read(page, bytes.bytes());
  return bytes;
}

Ranks neighboursOf(const PageView& view, std::uint32_t vertex)
{
  Ranks ranks;
  view.neighbours(vertex, [&ranks](std::uint32_t rank) { ranks.push_back(rank); });
  return ranks;
}

VertexPages::Vertex vertexOf(std::uint32_t id, const Ranks& neighbours)
{
  return { { id + 0.1, id + 0.2, -double(id) }, id, NoIndex, neighbours };
}

class VertexPagesTest : public ::testing::TestWithParam<bool>
{
protected:
  Workspace Space{ {}, Workspace::MinMemory };
};

TEST_P(VertexPagesTest, WhatIsAppendedIsRead)
{
  VertexPages pages(this->Space, 3, this->GetParam());
  const std::vector<Ranks> neighbours = { { 1, 2, 6 }, {}, { 0, 4294967293u }, { 0, 200, 20000, 3 },
    { 5 }, { 4, 1u << 31, 3000000, 0 }, { 0 } };
  for (std::uint32_t first = 0; first < 7; first += 3)
  {
    std::vector<VertexPages::Vertex> page;
    for (std::uint32_t i = first; i < std::min(first + 3, 7u); ++i)
    {
      page.push_back(vertexOf(i, neighbours[i]));
    }
    page[0].place = first;
    pages.append(page);
  }
  pages.close();

  ASSERT_EQ(pages.pages(), 3);
  ASSERT_EQ(pages.vertices(), 7);
  EXPECT_EQ(pages.verticesOf(1), 3u);
  EXPECT_EQ(pages.verticesOf(2), 1u);
  EXPECT_EQ(pages.unplaced(0), 2u);
  EXPECT_EQ(pages.unplaced(2), 0u);
  for (std::uint32_t i = 0; i < 7; ++i)
  {
    const std::uint32_t page = pages.pageOf(i);
    const Buffer part = load(this->Space, pages, page, false);
    EXPECT_EQ(neighboursOf(pages.view(page, part.data()), i % 3), neighbours[i]);

    const Buffer whole = load(this->Space, pages, page, true);
    const PageView view = pages.view(page, whole.data());
    EXPECT_EQ(neighboursOf(view, i % 3), neighbours[i]);
    EXPECT_EQ(view.ids()[i % 3], i);
    EXPECT_EQ(view.places()[i % 3], i % 3 == 0 ? i : NoIndex);
    double x[3] = {};
    if (this->GetParam())
    {
      std::memcpy(x, view.position(i % 3, pages.positionBytes()), sizeof x);
      EXPECT_EQ(x[1], i + 0.2);
    }
    else
    {
      float y[3];
      std::memcpy(y, view.position(i % 3, pages.positionBytes()), sizeof y);
      EXPECT_EQ(y[1], static_cast<float>(i + 0.2));
      x[2] = y[2];
    }
    EXPECT_EQ(x[2], -double(i));
  }
}

TEST_P(VertexPagesTest, PlacesAreWrittenBackAlone)
{
  VertexPages pages(this->Space, 4, this->GetParam());
  const Ranks neighbours = { 0, 1, 2, 3, 4, 5, 6, 7 };
  for (std::uint32_t first = 0; first < 8; first += 4)
  {
    std::vector<VertexPages::Vertex> page;
    for (std::uint32_t i = first; i < first + 4; ++i)
    {
      page.push_back(vertexOf(i, neighbours));
    }
    pages.append(page);
  }
  pages.close();
  const Buffer before = load(this->Space, pages, 1, true);
  Buffer bytes = load(this->Space, pages, 0, true);
  const std::span<std::uint32_t> places = pages.view(0, bytes.data()).places();
  std::iota(places.begin(), places.end(), 40u);
  std::memset(bytes.data(), 0xee, pages.adjacencyBytes(0));
  pages.writePlaces(0, bytes.bytes());

  const Buffer again = load(this->Space, pages, 0, true);
  const PageView view = pages.view(0, again.data());
  EXPECT_EQ(view.places()[3], 43u);
  EXPECT_EQ(view.ids()[0], 0u);
  EXPECT_EQ(neighboursOf(view, 3), neighbours);
  const Buffer after = load(this->Space, pages, 1, true);
  EXPECT_EQ(std::memcmp(before.data(), after.data(), before.size()), 0);
}

/** Lists of about 64 KiB, where offsets stop fitting into 16 bits. */
TEST_P(VertexPagesTest, LongListsAreRead)
{
  for (const std::uint32_t vertices : { 1u, 2u, 5u })
  {
    for (std::uint32_t degree = 65516 / vertices; degree < 65550 / vertices; ++degree)
    {
      // Differences to one's own rank below 64: one byte each.
      const Ranks neighbours(degree, vertices + 3);
      std::vector<VertexPages::Vertex> page;
      for (std::uint32_t i = 0; i < vertices; ++i)
      {
        page.push_back(vertexOf(i, neighbours));
      }
      VertexPages pages(this->Space, 8, this->GetParam());
      pages.append(page);
      pages.close();
      const Buffer bytes = load(this->Space, pages, 0, true);
      const PageView view = pages.view(0, bytes.data());
      for (std::uint32_t i = 0; i < vertices; ++i)
      {
        ASSERT_EQ(neighboursOf(view, i), neighbours) << vertices << " x " << degree;
        ASSERT_EQ(view.ids()[i], i);
      }
    }
  }
}

TEST_P(VertexPagesTest, AnEnormousDegree)
{
  Ranks neighbours(500000);
  std::iota(neighbours.begin(), neighbours.end(), 1u);
  const Ranks back = { 0 };
  VertexPages pages(this->Space, 8, this->GetParam());
  pages.append(std::vector<VertexPages::Vertex>{ vertexOf(0, neighbours), vertexOf(1, back) });
  pages.close();
  const Buffer bytes = load(this->Space, pages, 0, false);
  EXPECT_EQ(neighboursOf(pages.view(0, bytes.data()), 0), neighbours);
  EXPECT_EQ(neighboursOf(pages.view(0, bytes.data()), 1), back);
}

TEST(VertexPages, MemoryIsAccountedFor)
{
  Workspace space({}, Workspace::MinMemory);
  const std::int64_t before = space.pool().used();
  {
    VertexPages pages(space, 1, false);
    const Ranks none;
    for (std::uint32_t i = 0; i < 10000; ++i)
    {
      pages.append(std::vector<VertexPages::Vertex>{ vertexOf(i, none) });
    }
    pages.close();
    EXPECT_GE(space.pool().used() - before, 10000 * 16);
    EXPECT_LT(space.pool().used() - before, 10000 * 64);
  }
  EXPECT_EQ(space.pool().used(), before);
}

INSTANTIATE_TEST_SUITE_P(Precisions, VertexPagesTest, ::testing::Bool());

} // namespace

} // namespace smg::testing
