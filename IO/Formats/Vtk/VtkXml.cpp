// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkXml.h"

#include <cctype>

namespace smg
{

std::string vtkXmlTypeName(ScalarType type)
{
  std::string name(nameOf(type));
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name[0] == 'U' ? "UI" + name.substr(2) : name;
}

std::string xmlEscaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

} // namespace smg
