# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=... -DOUT=... -P Embed.cmake : writes the source that defines the strings of
# Resources.h, each the content of a file in FOLDER.
set(source "// Made by Embed.cmake.\n#include \"HtmlReport/Resources.h\"\n\nnamespace html\n{\n")
foreach (resource "PageStyle page.css" "ViewerScript viewer.js")
  string(REPLACE " " ";" resource "${resource}")
  list(GET resource 0 name)
  list(GET resource 1 file)
  file(READ "${FOLDER}/${file}" text)
  string(FIND "${text}" ")resource\"" end)
  if (NOT end EQUAL -1)
    message(FATAL_ERROR "${file}: the string cannot hold the mark of its end")
  endif ()
  string(APPEND source "const char* const ${name} = R\"resource(${text})resource\";\n")
endforeach ()
file(WRITE "${OUT}" "${source}} // namespace html\n")
