// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/FormatOfBytes.h"

#include "IO/Formats/Suffix.h"
#include "IO/Import/StlLayout.h"
#include "IO/Import/TextScanner.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace smg
{

namespace
{

constexpr std::string_view Blanks = " \t\r\f\v\n";

bool isBlank(char c)
{
  return Blanks.find(c) != std::string_view::npos;
}

/** The text without a byte order mark. */
std::string_view withoutMark(std::string_view text)
{
  return text.substr(text.starts_with(ByteOrderMark) ? ByteOrderMark.size() : 0);
}

/** The text from its first character on that is no blank. */
std::string_view trimmed(std::string_view text)
{
  return text.substr(std::min(text.find_first_not_of(Blanks), text.size()));
}

/** Whether the text begins with the word OFF or one of its variants, as COFF or STN4OFF. */
bool isOff(std::string_view text)
{
  const std::size_t at = text.find("OFF");
  return at <= 6 && text.substr(0, at).find_first_not_of("STCN4n") == std::string_view::npos &&
         (at + 3 == text.size() || isBlank(text[at + 3]) || text[at + 3] == '#');
}

/** The text from its first line on that is neither empty nor a comment. */
std::string_view afterComments(std::string_view text)
{
  for (text = trimmed(text); text.starts_with('#'); text = trimmed(text))
  {
    text = text.substr(std::min(text.find('\n'), text.size()));
  }
  return text;
}

/** VTK XML by what the element VTKFile says of its type. */
MeshFormat formatOfXml(std::string_view text)
{
  const std::size_t at = text.find("<VTKFile");
  if (!text.starts_with('<') || at == std::string_view::npos)
  {
    return MeshFormat::Unknown;
  }
  const std::string_view tag = text.substr(at, text.find('>', at) - at);
  const std::size_t type = tag.find(" type=");
  constexpr std::size_t beforeValue = 7; // blank, name, equals sign and quotation mark
  const std::string_view value = tag.substr(
    type == std::string_view::npos ? tag.size() : std::min(type + beforeValue, tag.size()));
  const bool parallel = value.starts_with("PPolyData") || value.starts_with("PUnstructuredGrid");
  return parallel ? MeshFormat::VtkParallelXml : MeshFormat::VtkXml;
}

bool isObjKeyword(std::string_view word)
{
  constexpr std::string_view keywords[] = { "v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s",
    "mg", "mtllib", "usemtl", "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod",
    "shadow_obj", "trace_obj", "cstype", "deg" };
  return std::ranges::find(keywords, word) != std::end(keywords);
}

/** Whether every whole line is one of an OBJ file, and there is one. */
bool isObj(std::string_view text, bool whole)
{
  bool known = false;
  bool continued = false;
  while (!text.empty())
  {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos && !whole)
    {
      break;
    }
    const std::string_view line = trimmed(text.substr(0, end));
    const std::string_view word = line.substr(0, std::min(line.find_first_of(Blanks), line.size()));
    if (!word.empty() && !word.starts_with('#') && !continued)
    {
      if (!isObjKeyword(word))
      {
        return false;
      }
      known = true;
    }
    const std::size_t last = line.find_last_not_of(Blanks);
    continued = last != std::string_view::npos && line[last] == '\\';
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return known;
}

/** Whether the text is the beginning of an STL file: "solid", any name, then a facet or the end. */
bool isTextStl(std::string_view text)
{
  if (!text.starts_with("solid") || (text.size() > 5 && !isBlank(text[5])))
  {
    return false;
  }
  const std::string_view second = trimmed(text.substr(std::min(text.find('\n'), text.size())));
  return second.starts_with("facet") || second.starts_with("endsolid");
}

} // namespace

MeshFormat formatOfSign(std::string_view bytes)
{
  bytes = withoutMark(bytes);
  const std::string_view text = trimmed(bytes);
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r"))
  {
    return MeshFormat::Ply;
  }
  if (text.starts_with("# vtk DataFile"))
  {
    return MeshFormat::VtkLegacy;
  }
  if (text.starts_with("$MeshFormat"))
  {
    return MeshFormat::Gmsh;
  }
  if (afterComments(text).starts_with("MeshVersionFormatted"))
  {
    return MeshFormat::Medit;
  }
  return isOff(afterComments(text)) ? MeshFormat::Off : formatOfXml(text);
}

MeshFormat formatOfLooks(std::string_view bytes, std::optional<std::uint64_t> size)
{
  if ((size && isBinaryStl(bytes, *size)) || isTextStl(trimmed(withoutMark(bytes))))
  {
    return MeshFormat::Stl;
  }
  const bool whole = size && bytes.size() == *size;
  return isObj(withoutMark(bytes), whole) ? MeshFormat::Obj : MeshFormat::Unknown;
}

MeshFormat formatOfSuffix(const std::filesystem::path& path)
{
  std::string suffix = lowerSuffix(path);
  if (suffix == ".gz")
  {
    suffix = lowerSuffix(path.stem());
  }
  constexpr std::pair<std::string_view, MeshFormat> suffixes[] = { { ".ply", MeshFormat::Ply },
    { ".obj", MeshFormat::Obj }, { ".off", MeshFormat::Off }, { ".stl", MeshFormat::Stl },
    { ".mesh", MeshFormat::Medit }, { ".msh", MeshFormat::Gmsh }, { ".node", MeshFormat::TetGen },
    { ".ele", MeshFormat::TetGen }, { ".vtk", MeshFormat::VtkLegacy },
    { ".vtp", MeshFormat::VtkXml }, { ".vtu", MeshFormat::VtkXml },
    { ".pvtp", MeshFormat::VtkParallelXml }, { ".pvtu", MeshFormat::VtkParallelXml } };
  const auto found = std::ranges::find(
    suffixes, std::string_view(suffix), &std::pair<std::string_view, MeshFormat>::first);
  return found == std::end(suffixes) ? MeshFormat::Unknown : found->second;
}

} // namespace smg
