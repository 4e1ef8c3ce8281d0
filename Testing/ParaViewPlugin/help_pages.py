# SPDX-License-Identifier: BSD-3-Clause
"""The help of the plugin has the page that the button "?" of each panel asks for, with every property of the panel.

    help_pages.py HELP_FILE

whose folder is in that of the server-manager XML. ParaView looks for GROUP.NAME.html in the folder that is named as the help file itself is.
"""

import os
import sqlite3
import sys
import xml.etree.ElementTree as xml
import zlib

PROXIES = os.path.dirname(os.path.dirname(sys.argv[1]))

help_file = sqlite3.connect(sys.argv[1])
(namespace,), (folder,) = (help_file.execute(f"SELECT Name FROM {table}").fetchone()
                           for table in ("NamespaceTable", "FolderTable"))
assert namespace.split(".")[0] == folder, (namespace, folder)
# Qt compresses: the first four bytes are the size.
pages = {name: zlib.decompress(data[4:]).decode() for name, data in help_file.execute(
    "SELECT FileNameTable.Name, FileDataTable.Data FROM FileNameTable JOIN FileDataTable "
    "ON FileNameTable.FileId = FileDataTable.Id WHERE FileNameTable.Name LIKE '%.html'")}

found = 0
for file in sorted(os.listdir(PROXIES)):
    if not file.endswith(".xml"):
        continue
    for group in xml.parse(os.path.join(PROXIES, file)).getroot():
        for proxy in group:
            if proxy.find("Hints/ShowInMenu") is None and proxy.find("Hints/ReaderFactory") is None:
                continue
            name = f"{group.get('name')}.{proxy.get('name')}.html"
            assert name in pages, (name, sorted(pages))
            for one in proxy:
                is_shown = one.tag.endswith("VectorProperty") and one.get("panel_visibility") != "never"
                if is_shown and one.get("is_internal") != "1" and one.get("information_only") != "1":
                    label = one.get("label", one.get("name"))
                    assert f"<th>{label}</th>" in pages[name], (name, label)
            found += 1
assert found >= 10, found
print("passed")
