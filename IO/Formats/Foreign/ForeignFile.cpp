// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Foreign/ForeignFile.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/TextScanner.h"
#include "IO/Mesh/Format.h"
#include "smg/Error.h"

#include <algorithm>
#include <cctype>

namespace smg
{

namespace
{

using namespace std::string_view_literals;

/** What a file is that begins with `sign`. */
struct ForeignSign
{
  std::string_view sign; ///< of texts in lower case
  std::string_view what; ///< "it begins with ..., as WHAT does"
  std::string_view advice = {};
};

constexpr ForeignSign ForeignTexts[] = {
  { "<!doctype html", "a web page", "download the file itself" },
  { "<html", "a web page", "download the file itself" },
  { "version https://git-lfs", "a pointer of Git LFS", "fetch the file itself (git lfs pull)" },
  { "mfem nurbs", "a mesh of MFEM of another kind", "save it as 'MFEM mesh v1.0'" },
  { "mfem nc", "a mesh of MFEM of another kind", "save it as 'MFEM mesh v1.0'" },
  { "mfem inline", "a mesh of MFEM of another kind", "save it as 'MFEM mesh v1.0'" },
  { "iso-10303-21", "a STEP file", "mesh it first, for instance with Gmsh" },
  { "{\\rtf", "a text document", "save it as plain text" },
  { "%pdf", "a PDF document" },
  { "; fbx", "an FBX scene", "export it as PLY or OBJ" },
  { "kaydara fbx", "an FBX scene", "export it as PLY or OBJ" },
  { "#vrml", "a VRML scene", "export it as PLY or OBJ" },
  { "<x3d", "an X3D scene", "export it as PLY or OBJ" },
  { "<collada", "a COLLADA scene", "export it as PLY or OBJ" },
};

constexpr ForeignSign ForeignBytes[] = {
  { "PK\x03\x04"sv, "a ZIP archive", "unpack it first" },
  { "7z\xbc\xaf\x27\x1c"sv, "a 7z archive", "unpack it first" },
  { "Rar!"sv, "a RAR archive", "unpack it first" },
  { "BZh"sv, "a file compressed by bzip2", "unpack it first, or compress it by gzip, xz or zstd" },
  { "\x04\x22\x4d\x18"sv, "a file compressed by LZ4",
    "unpack it first, or compress it by gzip, xz or zstd" },
  { "glTF"sv, "a glTF scene", "export it as PLY or OBJ" },
  { "\x89PNG"sv, "a picture" },
  { "\xff\xd8\xff"sv, "a picture" },
  { "\x7f\x45LF"sv, "a program" },
};

constexpr ForeignSign Utf16{ {}, "text in UTF-16", "save it as UTF-8" };

/** Whether the file begins with a byte order mark of UTF-16 and an ASCII character. */
bool isUtf16(std::string_view start)
{
  const auto isAscii = [](char c) { return c > 0; };
  return start.size() >= 4 && ((start.starts_with("\xff\xfe") && isAscii(start[2]) && !start[3]) ||
                                (start.starts_with("\xfe\xff") && !start[2] && isAscii(start[3])));
}

const ForeignSign* findForeign(std::string_view start)
{
  if (isUtf16(start))
  {
    return &Utf16;
  }
  const auto* const binary = std::ranges::find_if(
    ForeignBytes, [&](const ForeignSign& sign) { return start.starts_with(sign.sign); });
  if (binary != std::end(ForeignBytes))
  {
    return binary;
  }
  constexpr std::size_t Longest = 64;
  std::string lower(textStart(start).substr(0, Longest));
  std::ranges::transform(
    lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const text = std::ranges::find_if(
    ForeignTexts, [&](const ForeignSign& sign) { return lower.starts_with(sign.sign); });
  return text == std::end(ForeignTexts) ? nullptr : text;
}

/** The beginning of a file in quotes: of its first line. */
std::string beginningOf(std::string_view start)
{
  constexpr std::size_t Most = 60;
  const std::string_view text = trimmed(start);
  const std::string_view line = text.substr(0, text.find_first_of(LineEnds));
  return inQuotes(line.substr(0, Most));
}

/** The format with its article. */
std::string kindOf(const Format& format)
{
  // Names that are spelt: ess-tee-ell.
  const bool isSpelt = format.name == "STL" || format.name == "OBJ" || format.name == "OFF";
  // "VTK XML in pieces": what a file is comes before how it is divided.
  const std::size_t end = std::min(format.name.find(" in "), format.name.size());
  return (isSpelt ? "an " : "a ") + std::string(format.name.substr(0, end)) + " file" +
         std::string(format.name.substr(end));
}

} // namespace

void refuseForeign(const std::string& name, std::string_view start, const std::string& kind)
{
  if (const ForeignSign* foreign = findForeign(start))
  {
    throw Error(name + ": is not " + kind + ": it begins with " + beginningOf(start) + ", as " +
                std::string(foreign->what) + " does" +
                (foreign->advice.empty() ? "" : ": " + std::string(foreign->advice)) + '.');
  }
}

void refuseForeign(const std::string& name, std::string_view start, const Format* wanted)
{
  refuseForeign(name, start, wanted ? kindOf(*wanted) : std::string("a mesh that is read"));
  const char first = wanted ? wanted->firstCharacter : '\0';
  if (wanted && (wanted->alwaysHasMagic || (first != '\0' && !textStart(start).starts_with(first))))
  {
    throw Error(
      name + ": is not " + kindOf(*wanted) + ": it begins with " + beginningOf(start) + '.');
  }
}

} // namespace smg
