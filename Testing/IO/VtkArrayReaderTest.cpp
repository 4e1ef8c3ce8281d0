// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkArrayReader.h"

#include "Testing/IO/MeshText.h"
#include "Testing/IO/VtkXmlWriter.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace smg::testing
{
namespace
{

class VtkArrays : public ::testing::Test
{
protected:
  std::filesystem::path write(const std::string& name, std::string_view bytes)
  {
    writeBytes(this->Folder / name, bytes);
    return this->Folder / name;
  }

  /** The bytes of the .vsm file. */
  std::string converted(const std::filesystem::path& in, ConversionOptions options)
  {
    const std::filesystem::path out = this->Folder / "out.vsm";
    options.scratch = this->Folder.path();
    convert(in, out, options);
    std::ifstream file(out, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  TemporaryFolder Folder;
};

/** A surface whose arrays are longer than what is decoded at once. */
IndexedTestMesh longSurface()
{
  return shuffled(torus(260, 100, 0.1));
}

std::string gridText(VtkXmlWriter writer, const IndexedTestMesh& mesh)
{
  const auto cells = static_cast<std::size_t>(mesh.cells());
  std::vector<std::int64_t> offsets(cells);
  std::generate(offsets.begin(), offsets.end(), [end = 0]() mutable { return end += 3; });
  std::string piece = "<Piece NumberOfPoints=\"" + std::to_string(mesh.vertices()) +
                      "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n<Points>";
  piece += writer.array("Points", "Float64", mesh.positions, 3);
  piece += "</Points>\n<Cells>" + writer.array("connectivity", "Int64", mesh.corners);
  piece += writer.array("offsets", "Int64", offsets);
  piece +=
    writer.array("types", "UInt8", std::vector<std::uint8_t>(cells, 5)) + "</Cells>\n</Piece>\n";
  return writer.file("UnstructuredGrid", piece);
}

std::string legacyText(const IndexedTestMesh& mesh)
{
  std::string text = "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS " +
                     std::to_string(mesh.vertices()) + " double\n";
  for (const double x : mesh.positions)
  {
    text += exact(x) + ' ';
  }
  text += "\nPOLYGONS " + std::to_string(mesh.cells()) + ' ' + std::to_string(4 * mesh.cells());
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
  {
    text += (i % 3 == 0 ? "\n3 " : " ") + std::to_string(mesh.corners[i]);
  }
  return text + '\n';
}

TEST_F(VtkArrays, AreTheSameInEveryEncodingOnAnyThreads)
{
  const IndexedTestMesh mesh = longSurface();
  ConversionOptions options;
  options.memoryLimit = std::int64_t(16) << 20; // the least one
  const std::string expected = this->converted(this->write("mesh.off", meshText(mesh)), options);
  std::vector<std::filesystem::path> files{ this->write("mesh.vtk", legacyText(mesh)) };
  for (const Way way : { Way::Ascii, Way::Inline, Way::AppendedBase64, Way::AppendedRaw })
  {
    for (const char* compressor : { "", "vtkZLibDataCompressor" })
    {
      VtkXmlWriter writer;
      writer.way = way;
      writer.compressor = compressor;
      files.push_back(this->write(std::to_string(files.size()) + ".vtu", gridText(writer, mesh)));
    }
  }
  for (const std::filesystem::path& file : files)
  {
    for (const int threads : { 1, 3 })
    {
      options.threads = threads;
      EXPECT_EQ(this->converted(file, options), expected) << file << ", " << threads << " threads";
    }
  }
}

TEST_F(VtkArrays, TellProgressOnTheThreadOfTheCaller)
{
  const std::filesystem::path in = this->write("a.vtu", gridText({}, longSurface()));
  std::vector<double> told;
  ConversionOptions options;
  options.threads = 4;
  options.progress = [&, caller = std::this_thread::get_id()](double done)
  {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    told.push_back(done);
    return true;
  };
  this->converted(in, options);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  constexpr double ImportEnd = 0.15;
  const auto asked = std::ranges::upper_bound(told, ImportEnd + 0.001) - told.begin();
  EXPECT_GT(asked, 50); // also from the file, so a request to stop is seen soon
  for (const std::ptrdiff_t calls : { asked / 4, asked / 2, asked - 2 })
  {
    options.progress = [calls, call = std::ptrdiff_t(0)](double) mutable { return ++call < calls; };
    EXPECT_THROW(this->converted(in, options), Cancelled) << calls;
  }
}

TEST_F(VtkArrays, SayWhichWordIsNoNumber)
{
  std::string text = legacyText(longSurface());
  const std::size_t place = text.rfind("\n3 ") + 1;
  text[place] = 'x';
  const std::filesystem::path in = this->write("a.vtk", text);
  for (const int threads : { 1, 4 })
  {
    ConversionOptions options;
    options.threads = threads;
    expectError([&] { this->converted(in, options); },
      "a.vtk, byte " + std::to_string(place) + ": 'x' is not a number");
  }
}

/** All bytes of a file of base64. */
std::string decoded(const std::filesystem::path& path, std::size_t size, std::size_t part)
{
  InputFile file(path);
  Base64Bytes source(file, 0);
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; i += part)
  {
    source.read(std::as_writable_bytes(std::span(bytes)).subspan(i, std::min(part, size - i)));
  }
  return bytes;
}

TEST_F(VtkArrays, Base64IsDecodedInAnyParts)
{
  std::string bytes, text;
  Base64Encoder encoder;
  for (const int unit : { 1000, 2, 1, 3, 500 }) // with padding in the text
  {
    const std::size_t begin = bytes.size();
    for (int i = 0; i < unit; ++i)
    {
      bytes += static_cast<char>(i * i / 7 + unit);
    }
    encoder.append(std::as_bytes(std::span(bytes)).subspan(begin), text);
    encoder.finish(text);
  }
  std::string broken; // into lines whose ends are inside of groups, too
  for (std::size_t i = 0; i < text.size(); i += 61)
  {
    broken += text.substr(i, 61) + "\r\n";
  }
  for (const std::string& each : { text, broken })
  {
    const std::filesystem::path path = this->write("text", each);
    for (const std::size_t part : { 1, 2, 3, 7, 100, 1000 })
    {
      EXPECT_EQ(decoded(path, bytes.size(), part), bytes) << part;
    }
  }
  for (std::size_t i = 400; i < 412; ++i)
  {
    std::string damaged = text;
    damaged[i] = '*';
    expectError([&] { decoded(this->write("text", damaged), bytes.size(), 1000); },
      "byte " + std::to_string(i) + ": ");
  }
}

} // namespace
} // namespace smg::testing
