// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkPropertyNames.h"

#include "vtkAlgorithm.h"

#include <algorithm>

namespace smg
{
namespace
{

struct NamedOption
{
  std::string_view option, property;
  bool isOfConverter; ///< whether only the Streaming Mesh Converter has it
};

constexpr NamedOption NamedOptions[] = {
  { "--memory", "MemoryLimit", false },
  { "--scratch", "ScratchDirectory", false },
  { "--scratch-limit", "ScratchLimit", false },
  { "--checkpoint", "CheckpointDirectory", false },
  { "--in-core", "InCore", false },
  { "--size", "Size", false },
  { "--cells", "Cells", true },
  { "--weld", "WeldDistance", true },
  { "--time-step", "TimeStep", true },
  { "--partition", "Partition", true },
};

const NamedOption* find(std::string_view option)
{
  const auto* found = std::ranges::find(NamedOptions, option, &NamedOption::option);
  return found == std::end(NamedOptions) ? nullptr : found;
}

void replace(std::string& text, std::string_view from, std::string_view to)
{
  if (const std::size_t at = text.find(from); at != std::string::npos)
  {
    text.replace(at, from.size(), to);
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

/** As "property MemoryLimit". */
std::string nameOf(const NamedOption& named, vtkAlgorithm& algorithm)
{
  const bool isConverter = algorithm.IsA("vtkStreamingMeshConverter");
  // A reader has no limit of memory: those of its conversion are set there.
  const bool isElsewhere =
    !isConverter && (named.isOfConverter ||
                      (algorithm.IsA("vtkStreamingMeshReader") && named.property == "MemoryLimit"));
  return "property " + std::string(named.property) +
         (isElsewhere ? " of the Streaming Mesh Converter" : "");
}

} // namespace

std::string_view propertyOf(std::string_view option)
{
  const NamedOption* named = find(option);
  return named ? named->property : std::string_view();
}

std::string withProperties(std::string sentence, vtkAlgorithm& algorithm)
{
  // Sentences that name both, for whoever reads them.
  replace(sentence, "option --scratch-limit, property", "property");
  keepOwnPart(sentence);
  replace(sentence, "without --in-core", "without InCore");
  constexpr std::string_view word = "option --";
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz-";
  for (std::size_t at = sentence.find(word); at != std::string::npos;
       at = sentence.find(word, at + 1))
  {
    const std::size_t begin = at + word.size() - 2;
    const std::size_t end = std::min(sentence.find_first_not_of(letters, begin), sentence.size());
    if (const NamedOption* named = find(std::string_view(sentence).substr(begin, end - begin)))
    {
      sentence.replace(at, end - at, nameOf(*named, algorithm));
    }
  }
  return sentence;
}

} // namespace smg
