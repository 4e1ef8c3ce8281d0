// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkPropertyNames.h"
#include "IO/vtkStreamingMeshConverter.h"
#include "IO/vtkStreamingMeshReader.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Testing/Support/TestFolders.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

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

TEST(VtkPropertyNames, ReplaceOptions)
{
  vtkNew<vtkStreamingMeshConverter> converter;
  vtkNew<vtkStreamingMeshReader> reader;
  const std::string limit = "raise the memory limit (option --memory), or convert it.";
  EXPECT_EQ(withProperties(limit, *converter),
    "raise the memory limit (property MemoryLimit), or convert it.");
  EXPECT_EQ(withProperties(limit, *reader), "raise the memory limit (property MemoryLimit of the "
                                            "Streaming Mesh Converter), or convert it.");
  EXPECT_EQ(withProperties("no triangles (option --cells)", *reader),
    "no triangles (property Cells of the Streaming Mesh Converter)");
  EXPECT_EQ(
    withProperties("(option --scratch-limit, property ScratchLimit) (option --scratch)", *reader),
    "(property ScratchLimit) (property ScratchDirectory)");
  EXPECT_EQ(withProperties("an option --other stays", *reader), "an option --other stays");
  const std::string both = std::string("merge them ") + HowToWeld + ".\nOr these " + HowToWeld;
  const std::string own = "(Clean or Clean to Grid, or Weld of the Streaming Mesh Converter)";
  EXPECT_EQ(withProperties(both, *reader), "merge them " + own + ".\nOr these " + own);
}

} // namespace
} // namespace smg::testing
