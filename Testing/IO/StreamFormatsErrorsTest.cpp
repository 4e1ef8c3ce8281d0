// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFile.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/IO/StreamFormatsSamples.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <utility>

namespace smg::testing
{
namespace
{

class StreamFormatsErrors : public StreamFormats
{
};

TEST_F(StreamFormatsErrors, TellsTheFormatByContent)
{
  EXPECT_EQ(detectStreamFormat(this->write("a", TwoTriangles)), StreamFormat::Sma);
  EXPECT_EQ(detectStreamFormat(this->write("a", TwoTets)), StreamFormat::Sva);
  EXPECT_EQ(detectStreamFormat(this->write("a", TwoTrianglesPost)), StreamFormat::Sma);
  EXPECT_EQ(detectStreamFormat(this->write("a.sma", twoTetsBinary())), StreamFormat::Svb);
  EXPECT_EQ(detectStreamFormat(this->write("a", twoTrianglesBinary())), StreamFormat::Smb);
  EXPECT_EQ(streamFormatOfName("x.y/Name.SVB"), StreamFormat::Svb);
  EXPECT_FALSE(streamFormatOfName("x.smb/name"));
  EXPECT_FALSE(streamFormatOfName("smb"));
}

TEST_F(StreamFormatsErrors, RefusesOtherFormatsByName)
{
  this->expectRefusal("a.smc", "\3\1\2", "compressed format SMC");
  this->expectRefusal("a", "\1\1\2", "compressed format SMC");
  this->expectRefusal("a.smb", "\2\1\2", "compressed format SMD");
  this->expectRefusal("a.svc", "\5\1\2", "compressed format SVC");
  this->expectRefusal("a.sma.gz", "\x1f\x8b\2", "gzip");
  this->expectRefusal("a.sma", "", "the file is empty");
  this->expectRefusal("a.smb", "\xff\xfe", "none of the formats");
  this->expectRefusal("a.sma", "ply\nformat ascii 1.0\n", "line 1: a line of a SMA file cannot");
  EXPECT_NE(messageOf([&] { openStreamFile(this->Folder / "none.sma"); }).find("No such file"),
    std::string::npos);
  EXPECT_NE(messageOf([&] { openStreamFile(this->Folder.path()); }).find("not a regular file"),
    std::string::npos);
}

/** The comments of a header are kept: as many as a hostile file has are not. */
TEST_F(StreamFormatsErrors, RefusesMoreCommentsThanItKeeps)
{
  const auto text = [](int lines, const std::string& comment)
  {
    std::string bytes;
    for (int k = 0; k < lines; ++k)
    {
      bytes += "# " + comment + "\n";
    }
    return bytes + TwoTriangles;
  };
  const std::string sentence = "the comments before the first vertex or cell have more than 1 MiB";
  this->expectRefusal("a.sma", text(1100, std::string(1000, 'x')), "line 1017: " + sentence);
  this->expectRefusal("a.sma", text(40000, ""), sentence);
  EXPECT_EQ(openStreamFile(this->write("a.sma", text(1000, std::string(1000, 'x'))))
              ->header()
              .comments.size(),
    1000U);

  const auto binary = [](std::uint32_t comments, std::uint32_t bytes)
  {
    std::string file = words({ 0, comments });
    for (std::uint32_t k = 0; k < comments; ++k)
    {
      file += words({ bytes }) + std::string(bytes, 'x');
    }
    return file + twoTrianglesBinary().substr(8);
  };
  for (const std::string& bytes : { binary(1, 2 << 20), binary(1100, 1000), binary(40000, 0) })
  {
    this->expectRefusal("a.smb", bytes, "byte 4: the comments of the header have more than 1 MiB");
  }
  EXPECT_EQ(
    openStreamFile(this->write("a.smb", binary(1000, 1000)))->header().comments.size(), 1000U);
}

TEST_F(StreamFormatsErrors, RefusesWrongLines)
{
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  this->expectRefusal("a.sma", "v 0 0\n", "line 1: the coordinates");
  this->expectRefusal("a.sma", "v 0 0 nan\n", "line 1: the coordinates");
  this->expectRefusal("a.sma", "v 0 0 1e999\n", "line 1: the coordinates");
  this->expectRefusal("a.sma", "v 0 0 1e39\n", "line 1: the coordinates");
  this->expectRefusal("a.sma", "v 0 0 1x\n", "line 1: the coordinates");
  this->expectRefusal("a.sma", "v 0 0 0 7\n", "line 1: there is more");
  this->expectRefusal("a.sma", three + "f 1 2\n", "line 4: the indices");
  this->expectRefusal("a.sma", three + "f 1 2 0\n", "line 4: the indices");
  this->expectRefusal("a.sma", three + "f 1/1 2 3\n", "line 4: the indices");
  this->expectRefusal("a.sma", three + "f 1 2 4\n", "line 4: index 4 is of a vertex that is not");
  this->expectRefusal("a.sma", three + "f 1 2 -4\n", "line 4: index -4 goes back");
  this->expectRefusal("a.sma", three + "f 1 2 99999999999999999999\n", "line 4: the indices");
  this->expectRefusal("a.sma", three + "f 1 2 3 1\n", "line 4: there is more");
  this->expectRefusal("a.sma", three + "g 1 2 3\n", "line 4: a line of a SMA file cannot begin");
  this->expectRefusal(
    "a.sma", three + "f 1 2 3\nc 1 2 3 1\n", "line 5: a line of a SMA file cannot begin");
  this->expectRefusal("a.sma", three + "x 4\n", "line 4: index 4 is of a vertex");
  this->expectRefusal("a.sma", three + "f -3 2 3\nf 1 2 3\n", "line 5: the cell uses vertex 1");
  this->expectRefusal("a.sma", three + "x 1\nf 1 2 3\n", "line 5: the cell uses vertex 1");
  this->expectRefusal("a.sma", three, "line 3: the file ends without a cell");
  this->expectRefusal(
    "a.sma", "# nverts 4\n" + three + "f 1 2 3\n", "line 5: the file ends with 3");
  this->expectRefusal(
    "a.sma", "# nfaces 0\n" + three + "f 1 2 3\n", "line 5: the file ends with 1");
  this->expectRefusal("a.sma", "# nverts x\n", "line 1: nverts is not followed by a number");
  this->expectRefusal("a.sma", "# bb_min 0 nan 0\n", "line 1: the bounding box");
  this->expectRefusal("a.sma", std::string(70000, ' '), "line 1 has more than 65536 characters");
  this->expectRefusal("a.sma", "# only a comment\n", "line 1: the file ends before");
  this->expectRefusal("a.sma", "f 1 2 4\nv 0 0 0\nv 0 0 0\nv 0 0 0\n", "ends with 3 vertices");
  this->expectRefusal("a.sma", "f 1 2 -3\nv 0 0 0\n", "line 1: index -3 is relative");
  this->expectRefusal("a.sma", "f 1 2 999999\nv 0 0 0\n", "line 1: index 999999 is larger");
  this->expectRefusal("a.sma", "f 1 2 3\nv 0 0 0\nf 1 2 3\n", "line 3: the cell uses vertex 1");
  this->expectRefusal("a.sva", "# svtype hex\n", "line 1: cells of type 'hex'");
  this->expectRefusal("a.sva", "# v_pnum_f 2\n", "line 1: v_pnum_f");
  this->expectRefusal("a.sva", "# v_pnum_i 1000000000000\n", "line 1: v_pnum_i");
  this->expectRefusal("a.sva", "# v_pnum_f 4\nv 0 0 0\n", "line 2: the vertex has not the 4");
}

TEST_F(StreamFormatsErrors, ShowNoUnprintableBytes)
{
  for (const char* wrong : { "\x1b]0;x\x07 1\n", "v 0 0 0\n\x1b[2J\n" })
  {
    const std::string message = this->refusal("a.sma", wrong);
    EXPECT_FALSE(message.empty());
    EXPECT_TRUE(std::ranges::all_of(message, [](unsigned char c) { return c >= 32 && c < 127; }));
  }
}

TEST_F(StreamFormatsErrors, RefusesWrongElements)
{
  const std::string good = twoTrianglesBinary();
  EXPECT_EQ(this->refusal("a.smb", good), "");
  const auto changed = [&good](std::size_t place, std::uint32_t word)
  { return std::string(good).replace(place, 4, words({ word })); };
  // The first element is at byte 45, the third cell corner of the first cell at byte 89.
  this->expectRefusal("a.smb", changed(49, 0x7fc00000), "element 0 at byte 45: a coordinate");
  this->expectRefusal("a.smb", changed(49, 0xff800000), "element 0 at byte 45: a coordinate");
  this->expectRefusal("a.smb", changed(89, 0), "element 3 at byte 81: the cell has index 0");
  this->expectRefusal("a.smb", changed(89, 4), "element 3 at byte 81: the cell has index 4");
  this->expectRefusal("a.smb", changed(89, std::uint32_t(-4)), "element 3 at byte 81: the cell");
  this->expectRefusal("a.smb", changed(8, 5), "but its header says 5");
  this->expectRefusal("a.smb", changed(12, 3), "but its header says 3");
  this->expectRefusal("a.smb", changed(41, 0x7), "element 4 at byte 93");
  this->expectRefusal("a.smb", changed(41, 0x57), "element 0 at byte 41: the block that begins");
  this->expectRefusal("a.smb", good + "x", "element 0 at byte 41: the block that begins");
  this->expectRefusal("a.smb", good.substr(0, 3), "byte 3: the file ends in its header");
  this->expectRefusal("a.smb", good.substr(0, 30), "byte 30: the file ends in its header");
  this->expectRefusal("a.smb", good.substr(0, 44), "byte 41: the file ends too early");
  this->expectRefusal("a.smb", changed(4, 77777), "byte 4: the header makes no sense");
  this->expectRefusal("a.smb", changed(0, 0x70000), "byte 1: the header of");
  std::string tets = twoTetsBinary();
  tets[16] = 2;
  this->expectRefusal("a.svb", tets, "byte 4: the header makes no sense");
  // As many integers of a vertex as do not fit beside its coordinates, in 32 bits either.
  this->expectRefusal("a.svb", twoTetsBinary().replace(20, 4, words({ 0x7fffffff })),
    "byte 4: the header makes no sense");
}

TEST_F(StreamFormatsErrors, SurvivesEveryTruncationAndEveryChangedByte)
{
  Combinations combinations;
  const std::regex place("(line [0-9]+|byte [0-9]+|is empty|none of the formats|compressed|gzip)");
  const std::pair<std::string, std::string> files[] = { { "a.sma", TwoTriangles },
    { "b.sma", TwoTrianglesPost }, { "a.smb", twoTrianglesBinary() }, { "a.sva", TwoTets },
    { "a.svb", twoTetsBinary() } };
  for (const auto& [name, good] : files)
  {
    const bool text = name.ends_with('a');
    for (std::size_t size = 0; size < good.size(); size++)
    {
      if (!combinations.next())
      {
        continue;
      }
      const std::string message = this->refusal(name, good.substr(0, size));
      // Without its last line end or digit, a text is still valid.
      if (!text || size + 3 < good.size())
      {
        EXPECT_TRUE(std::regex_search(message, place)) << name << size << ": " << message;
      }
    }
    for (std::size_t i = 0; i < good.size(); i++)
    {
      if (!combinations.next())
      {
        continue;
      }
      std::string bad = good;
      bad[i] = char(bad[i] ^ 1 << i % 8);
      const std::string message = this->refusal(name, bad);
      EXPECT_TRUE(message.empty() || std::regex_search(message, place)) << i << ": " << message;
    }
    Random random(4);
    for (int i = 0; i < 100; i++)
    {
      std::string bad = good;
      for (int k = 0; k < 6; k++)
      {
        bad[std::size_t(random.below(std::int64_t(bad.size())))] = char(random.bits());
      }
      const std::string message = this->refusal(name, bad);
      EXPECT_TRUE(message.empty() || std::regex_search(message, place)) << i << ": " << message;
    }
  }
}

} // namespace
} // namespace smg::testing
