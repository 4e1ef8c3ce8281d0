// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/JobProperties.h"
#include "IO/Vtk/PropertyNames.h"
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Testing/Support/TestFolders.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

// Whoever sees a panel knows no options of the program smg.

namespace smg::testing
{
namespace
{

TEST(VtkPropertyNames, EveryOptionThatTheLibrariesNameIsAProperty)
{
  const std::regex named(R"(option (--[a-z-]+))");
  int found = 0;
  for (const char* folder : { "Solver", "IO" })
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / folder))
    {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".cxx")
      {
        continue;
      }
      std::ifstream file(entry.path());
      const std::string text{ std::istreambuf_iterator<char>(file), {} };
      for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at, ++found)
      {
        EXPECT_FALSE(propertyOf((*at)[1].str()).empty()) << entry.path() << ": " << (*at)[1];
      }
    }
  }
  EXPECT_GT(found, 8);
}

/** The texts between quotes of a source, each with those that follow it at once. */
std::vector<std::string> quotedTexts(const std::string& source)
{
  static const std::regex comment(R"((^|\n)\s*(//|/?\*)[^\n]*)");
  static const std::regex between(R"x("\s*")x");
  static const std::regex quoted(R"x("((?:[^"\\\n]|\\.)*)")x");
  const std::string code =
    std::regex_replace(std::regex_replace(source, comment, "\n"), between, "");
  std::vector<std::string> texts;
  for (std::sregex_iterator at(code.begin(), code.end(), quoted), end; at != end; ++at)
  {
    texts.push_back((*at)[1].str());
  }
  return texts;
}

/** Whatever else a sentence says for the program, for C++ or of JSON. */
TEST(VtkPropertyNames, NoSentenceOfTheLibrariesIsForOthers)
{
  const vtkNew<vtkStreamingMeshConverter> converter;
  const std::regex ofOthers(R"(--[a-z]|\bsmg [a-z]+ -|in C\+\+|ConversionOptions|in ParaView)");
  std::size_t sentences = 0;
  for (const char* folder : { "Solver", "IO", "Filters" })
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / folder))
    {
      const std::string suffix = entry.path().extension();
      if ((suffix != ".cpp" && suffix != ".cxx") || entry.path().filename() == "PropertyNames.cxx")
      {
        continue;
      }
      std::ifstream file(entry.path());
      for (const std::string& text : quotedTexts({ std::istreambuf_iterator<char>(file), {} }))
      {
        sentences += text.find(' ') != std::string::npos ? 1 : 0;
        EXPECT_FALSE(std::regex_search(withProperties(text, *converter), ofOthers))
          << entry.path() << ": " << withProperties(text, *converter);
      }
    }
  }
  EXPECT_GT(sentences, 1000U);
}

/** As the names of the panels are. */
TEST(VtkPropertyNames, AreWordsInSentences)
{
  const vtkNew<vtkStreamingMeshReader> reader;
  const std::regex property(R"x(<\w+Property name="(\w+)")x");
  const std::set<std::string> unsaid{ "DummyInput", "UseReferenceBounds", "ReferenceBounds",
    "PositionInfo", "RotationInfo", "ScaleInfo", "TimestepValues", "CellArrayInfo",
    "PointArrayInfo", "CellArrayStatus", "PointArrayStatus" };
  int found = 0;
  for (const auto& entry :
    std::filesystem::directory_iterator(sourceFolder() / "ParaViewPlugin" / "StreamingMultigrid"))
  {
    if (entry.path().extension() != ".xml")
    {
      continue;
    }
    std::ifstream file(entry.path());
    const std::string text{ std::istreambuf_iterator<char>(file), {} };
    for (std::sregex_iterator at(text.begin(), text.end(), property), end; at != end; ++at)
    {
      const std::string name = (*at)[1].str();
      const std::string words = std::regex_replace(name, std::regex("([a-z])([A-Z])"), "$1 $2");
      if (!unsaid.contains(name))
      {
        EXPECT_EQ(withProperties("set " + name + ", or (" + name + ")", *reader),
          "set " + words + ", or (" + words + ")");
        ++found;
      }
    }
  }
  for (const auto& [option, name] : propertiesOfOptions())
  {
    const std::string words = std::regex_replace(name, std::regex("([a-z])([A-Z])"), "$1 $2");
    EXPECT_EQ(withProperties("(option " + option + ')', *reader).find("(property " + words), 0U);
    EXPECT_EQ(withProperties("set " + name, *reader), "set " + words);
    ++found;
  }
  EXPECT_GT(found, 100);
  for (const char* stays : { "the array 'RegionName'", "/tmp/MemoryLimit", "{\"Region\": 1}",
         "the point 34834 and", "at 1234.5 points", "vertex 21000 is" })
  {
    EXPECT_EQ(withProperties(stays, *reader), stays);
  }
  EXPECT_EQ(withProperties("34834 vertices of 1234567 cells (1113 points)", *reader),
    "34,834 vertices of 1,234,567 cells (1,113 points)");
}

TEST(VtkPropertyNames, ReplaceOptions)
{
  vtkNew<vtkStreamingMeshConverter> converter;
  vtkNew<vtkStreamingMeshReader> reader;
  const std::string limit = "raise the memory limit (option --memory), or convert it.";
  EXPECT_EQ(withProperties(limit, *converter),
    "raise the memory limit (property Memory Limit), or convert it.");
  EXPECT_EQ(withProperties(limit, *reader), "raise the memory limit (property Memory Limit of the "
                                            "Streaming Mesh Converter), or convert it.");
  EXPECT_EQ(withProperties("no triangles (option --cells)", *reader),
    "no triangles (property Cells of the Streaming Mesh Converter)");
  EXPECT_EQ(
    withProperties("(option --scratch-limit, property ScratchLimit) (option --scratch)", *reader),
    "(property Scratch Limit) (property Scratch Directory)");
  EXPECT_EQ(withProperties("an option --other stays", *reader), "an option --other stays");
  const std::string both = std::string("merge them ") + HowToWeld + ".\nOr these " + HowToWeld;
  const std::string own = "(Clean or Clean to Grid, or Weld of the Streaming Mesh Converter)";
  EXPECT_EQ(withProperties(both, *reader), "merge them " + own + ".\nOr these " + own);
}

} // namespace
} // namespace smg::testing
