# SPDX-License-Identifier: BSD-3-Clause
"""Pages that smg --report FILE.html writes, and a mesh to write them for."""

import base64
import json
import struct
from html.parser import HTMLParser

from program import run
from torus import torus

# Elements without an end.
VOID = {"meta", "link", "input", "br"}


class Page(HTMLParser):
    """Reads a page; an element that is not closed where it should be, or that loads anything, is an error."""

    def __init__(self, name):
        super().__init__()
        with open(name, encoding="utf-8", errors="strict") as file:
            self.source = file.read()
        self.open, self.ids, self.texts, self.tags = [], {}, [], []
        self.feed(self.source)
        self.close()
        assert self.open == [], self.open
        self.text = " ".join("".join(self.texts).split())
        assert self.source.startswith("<!DOCTYPE html>") and self.source.endswith("</html>\n")
        for forbidden in ("http://", "https://", "url(", "@import"):
            assert forbidden not in self.source, forbidden

    def handle_starttag(self, tag, attrs):
        names = [name for name, _ in attrs]
        assert len(names) == len(set(names)), attrs
        assert not {"src", "href", "srcset", "data", "action"} & set(names), (tag, attrs)
        assert not any(name.startswith("on") for name in names), (tag, attrs)
        self.tags.append(tag)
        if tag not in VOID:
            self.open.append((tag, dict(attrs).get("id")))
        if "id" in names:
            assert dict(attrs)["id"] not in self.ids, attrs
            self.ids[dict(attrs)["id"]] = ""

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1][0] == tag, (tag, self.open, self.getpos())
        self.open.pop()

    def handle_data(self, data):
        for _, name in self.open:
            if name:
                self.ids[name] += data
        if self.open and self.open[-1][0] not in ("script", "style"):
            self.texts.append(data)

    def report(self):
        """The report as JSON that the page ends with."""
        return json.loads(self.ids["report"])

    def surface(self):
        """The surface that the page draws: points, triangles, and columns by name."""
        data = json.loads(self.ids["surface"])

        def numbers(text, code):
            return [x for x, in struct.iter_unpack("<" + code, base64.b64decode(text, validate=True))]

        points, corners = numbers(data["positions"], "f"), numbers(data["corners"], "H")
        assert len(points) % 3 == 0
        assert len(corners) % 3 == 0 and 0 <= min(corners) and max(corners) < len(points) // 3
        columns = {column["name"]: column for column in data["columns"]}
        for column in columns.values():
            code = "B" if column["isColour"] else "H"
            column["values"] = numbers(column["values"], code)
            assert len(column["values"]) == len(points) // (1 if column["isColour"] else 3)
        assert -1 <= data["shown"] < len(columns)
        return points, corners, columns


def write_scan(name, mask="mask", nu=120, nv=60):
    """A torus with colours in two patches and a mask, as a PLY file."""
    points, quadrangles = torus(nu, nv)
    with open(name, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        file.writelines("property double %s\n" % axis for axis in "xyz")
        file.writelines("property uchar %s\n" % colour for colour in ("red", "green", "blue"))
        file.write("property int scan\nproperty int %s\nelement face %d\n" % (mask, len(quadrangles)))
        file.write("property list uchar int vertex_indices\nend_header\n")
        for x, y, z in points:
            patch = 1 if x > 0 else 2
            file.write("%r %r %r %d %d %d %d %d\n" % (
                x, y, z, 80 + 40 * patch, 120 + round(30 * y), 100, patch, x > 2.9))
        file.writelines("4 %d %d %d %d\n" % face for face in quadrangles)


def write_json(name, **members):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(members, file)
    return name


def page_of(*arguments, code=0):
    """Runs smg with a page as its report and returns it."""
    run(*arguments, "--report", "page.html", "--quiet", code=code)
    return Page("page.html")
