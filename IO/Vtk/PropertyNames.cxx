// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PropertyNames.h"

#include "IO/Jobs/JobProperties.h"

#include "vtkAlgorithm.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <span>
#include <utility>

namespace smg
{
namespace
{

struct NamedOption
{
  std::string_view option, property;
};

/** Those of the Streaming Mesh Converter. */
constexpr NamedOption OptionsOfConverter[] = {
  { "--cells", "Cells" },
  { "--weld", "WeldDistance" },
  { "--time-step", "TimeStep" },
  { "--partition", "Partition" },
};

/** Those whose properties are more than their values. */
constexpr NamedOption OtherOptions[] = { { "--in-core", "InCore" }, { "--size", "Size" } };

/** The properties that are no options of jobs and whose names are several words, which a panel
 * shows apart from each other. */
constexpr std::string_view SeveralWords[] = { "CellDataArrays", "ChooseArraysToWrite",
  "ConductivityArray", "DirichletMask", "DirichletValues", "DragPoints", "EdgeAngle", "FieldArray",
  "FileName", "FullNumberOfCells", "FullNumberOfPoints", "GradientAtPoints", "HeldBounds", "IdType",
  "InCore", "InitialGuess", "InsideOut", "InteractivePoints", "KeepEdges", "KeepHandleArrays",
  "MaskArray", "MaximumPointsInMemory", "NumberOfBuilds", "NumberOfHeldPoints", "NumberOfPieces",
  "OutputFileName", "PeakMemory", "PointDataArrays", "PointTargets", "PreviewCells",
  "PreviewPoints", "ProblemFileName", "ReachedError", "RegionFunction", "RegionName",
  "RestoreOrder", "ResultArrayName", "RotationAngle", "RotationAxis", "ScreeningArray", "SizeUnit",
  "StreamFileName", "TagArray", "TimeStep", "ValueIsPosition", "WeldDistance", "WriteText" };

/** Parts of sentences for whoever reads them at any of the doors, and what the window says. */
constexpr std::pair<std::string_view, std::string_view> Sayings[] = {
  { "option --scratch-limit, property", "property" },
  { "without --in-core", "without InCore" },
  { "shortest paths (to) are", "shortest paths (property To) are" },
  { "name a column of the vertices to smooth instead",
    "choose a point array to smooth instead (property Array)" },
};

/** Empty: there is none. */
std::string_view find(std::span<const NamedOption> options, std::string_view option)
{
  const auto found = std::ranges::find(options, option, &NamedOption::option);
  return found == options.end() ? std::string_view() : found->property;
}

bool isSeveralWords(const std::string& word)
{
  const auto isIt = [&word](const auto& named) { return named.second == word; };
  return std::ranges::find(SeveralWords, word) != std::end(SeveralWords) ||
         std::ranges::any_of(propertiesOfOptions(), isIt);
}

void replace(std::string& text, std::string_view from, std::string_view to)
{
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
  {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

/** "(option --weld 0; in ParaView Clean; in C++ ...)" becomes "(Clean)". */
void keepOwnPart(std::string& text)
{
  constexpr std::string_view word = "; in ParaView ";
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
  {
    const std::size_t begin = text.rfind('(', at), end = text.find(')', at);
    if (begin != std::string::npos && end != std::string::npos)
    {
      const std::size_t own = at + word.size();
      const std::size_t length = std::min(text.find(';', own), end) - own;
      text.replace(begin + 1, end - begin - 1, text.substr(own, length));
      at = begin;
    }
  }
}

bool isLetter(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/** Calls `take(begin, end)` for each word or number of a text, from the last one on. */
template <class Take>
void forWordsFromTheEnd(const std::string& text, Take&& take)
{
  for (std::size_t end = text.size(); end > 0; --end)
  {
    if (!isLetter(text[end - 1]))
    {
      continue;
    }
    const std::size_t stop = end;
    while (end > 0 && isLetter(text[end - 1]))
    {
      --end;
    }
    take(end, stop);
    ++end;
  }
}

/** "Region Name" for "RegionName", and "34,834 vertices" for "34834 vertices". */
void separateWords(std::string& text)
{
  constexpr std::string_view Counted[] = { "vertices", "points", "cells", "triangles", "tetrahedra",
    "edges", "faces", "bodies", "places" };
  forWordsFromTheEnd(text,
    [&](std::size_t begin, std::size_t end)
    {
      const std::string word = text.substr(begin, end - begin);
      // Not what is part of a path, of a text of JSON or of a number with a fraction.
      const char before = begin > 0 ? text[begin - 1] : ' ';
      const bool isPlain = before == ' ' || before == '(';
      if (isPlain && isSeveralWords(word))
      {
        for (std::size_t k = end - 1; k > begin; --k)
        {
          if (std::isupper(static_cast<unsigned char>(text[k])) != 0)
          {
            text.insert(k, " ");
          }
        }
      }
      else if (isPlain && word.size() > 3 &&
               word.find_first_not_of("0123456789") == std::string::npos && text[end] == ' ')
      {
        const std::size_t next = end + 1;
        const std::size_t stop = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz", next);
        const std::string noun = text.substr(next, stop - next);
        const bool isCount = std::ranges::find(Counted, noun) != std::end(Counted);
        for (std::ptrdiff_t k = std::ssize(word) - 3; isCount && k > 0; k -= 3)
        {
          text.insert(begin + static_cast<std::size_t>(k), ",");
        }
      }
    });
}

/** As "property MemoryLimit". */
std::string nameOf(std::string_view option, vtkAlgorithm& algorithm)
{
  const std::string_view property = propertyOf(option);
  const bool isConverter = algorithm.IsA("vtkStreamingMeshConverter");
  // A reader has no limit of memory: those of its conversion are set there.
  const bool isElsewhere =
    !isConverter && (!find(OptionsOfConverter, option).empty() ||
                      (algorithm.IsA("vtkStreamingMeshReader") && property == "MemoryLimit"));
  return "property " + std::string(property) +
         (isElsewhere ? " of the Streaming Mesh Converter" : "");
}

} // namespace

std::string_view propertyOf(std::string_view option)
{
  const auto of = propertiesOfOptions().find(option);
  const std::string_view other = find(OtherOptions, option);
  return of != propertiesOfOptions().end() ? std::string_view(of->second)
         : !other.empty()                  ? other
                                           : find(OptionsOfConverter, option);
}

std::string withProperties(std::string sentence, vtkAlgorithm& algorithm)
{
  for (const auto& [from, to] : Sayings)
  {
    replace(sentence, from, to);
  }
  keepOwnPart(sentence);
  constexpr std::string_view word = "option --";
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz-";
  for (std::size_t at = sentence.find(word); at != std::string::npos;
       at = sentence.find(word, at + 1))
  {
    const std::size_t begin = at + word.size() - 2;
    const std::size_t end = std::min(sentence.find_first_not_of(letters, begin), sentence.size());
    const std::string option = sentence.substr(begin, end - begin);
    if (!propertyOf(option).empty())
    {
      sentence.replace(at, end - at, nameOf(option, algorithm));
    }
  }
  separateWords(sentence);
  return sentence;
}

} // namespace smg
