# SPDX-License-Identifier: BSD-3-Clause
"""said_output.py SOURCE COMMAND... : expects a lesson to print the output in its first comment (of
a script: anywhere), except for the memory, which depends on the number of threads."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

source, *command = sys.argv[1:]
said = Path(source).read_text(encoding="utf-8").split("*/")[0]
with tempfile.TemporaryDirectory() as folder:
    printed = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout
for line in printed.splitlines():
    assert re.sub(r", [0-9.]+ MiB of memory$|[0-9.]+ MiB \|$", "", line.strip()) in said, f"{source} does not say: {line}"
assert printed, command
