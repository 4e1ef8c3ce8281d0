# SPDX-License-Identifier: BSD-3-Clause
"""The Python that documents show."""

import os
import re

from testing import SOURCE


def blocks(document, word):
    """The Python blocks of a document that contain a word, as one text."""
    with open(os.path.join(SOURCE, document), encoding="utf-8") as file:
        found = re.findall(r"^```python\n(.*?)^```", file.read(), re.S | re.M)
    return "".join(block for block in found if word in block)
