// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "smg/Column.h"
#include "smg/Export.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace smg
{

/** A tag of an XML file. */
struct XmlTag
{
  std::string name;
  bool closes = false; ///< </name>
  bool alone = false;  ///< <name/>
  std::vector<std::pair<std::string, std::string>> attributes;
  std::size_t begin = 0; ///< byte of the '<'
  std::size_t end = 0;   ///< byte after the '>'

  /** The value of an attribute; null without. */
  const std::string* attribute(const char* name) const;
  /** The value of an attribute, or `otherwise` without. */
  std::string value(const char* name, const char* otherwise = "") const
  {
    const std::string* value = this->attribute(name);
    return value ? *value : otherwise;
  }
};

/**
 * Goes from tag to tag of an XML file, over text, comments and declarations. Not a full XML
 * parser: holds one tag in memory, and stops before raw appended data.
 */
class XmlTags
{
public:
  explicit XmlTags(InputFile& file)
    : File(file)
  {
  }

  /** The next tag; false at the end of the file. Throws Error where a tag does not end. */
  bool next(XmlTag& tag);

private:
  /** The '<' at or after `At`; false without. */
  bool find();
  /** Goes behind the next `text`. */
  void skipPast(std::string_view text);
  void parse(std::string_view text, XmlTag& tag) const;

  InputFile& File;
  std::size_t At = 0;
};

/** The names of the scalar types in VTK's XML files. */
inline constexpr std::string_view VtkXmlTypeNames[] = { "Int8", "UInt8", "Int16", "UInt16", "Int32",
  "UInt32", "Int64", "UInt64", "Float32", "Float64" };
constexpr std::string_view vtkXmlTypeName(ScalarType type)
{
  return VtkXmlTypeNames[static_cast<int>(type)];
}
/** The text with an underscore for each character that a name in XML cannot have: control
 * characters, and bytes that are not UTF-8. */
SMG_EXPORT std::string xmlText(std::string_view text);
/** The same with the characters that mean something in XML written as entities. */
SMG_EXPORT std::string xmlEscaped(const std::string& text);

/**
 * The tag <VTKFile>, which comes first. Throws Error if it does not, or if the file does not end
 * with its closing tag.
 */
XmlTag vtkXmlRoot(InputFile& file, XmlTags& tags);

} // namespace smg
