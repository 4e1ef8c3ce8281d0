# SPDX-License-Identifier: BSD-3-Clause
"""Builds wheels and source archives of the package streamingmultigrid (PEP 517), with CMake.

A wheel has the package, the library behind it, and the libraries that this needs beyond those of C and
C++, by names of their own (own_names.py); it serves every Python 3, and systems whose C library is not older than that of the machine that
built it. Nothing is downloaded: ``pip install --no-index --no-build-isolation .`` needs the packages of
`smg_build_packages` in cmake/packages.sh.

Config settings (``pip wheel --config-settings build-dir=build .``):
  build-dir   a build folder of this tree, in which the libraries are brought up to date; default:
              build-wheel, which is made and kept
  jobs        parallel compilations; default: as many as the generator likes

The HDF5 library is not carried, since Debian's needs thirty others: VTKHDF files are read and written
where the system has it. The libraries that are carried keep their licences, which the wheel has in its
folder licenses. Debian's CHOLMOD contains its modules under the GPL, which are never called; a wheel
with it may be passed on under the terms of the GPL.
"""

import base64
import hashlib
import importlib.util
import io
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

from own_names import own_name, renamed

_TREE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
_PACKAGE = "streamingmultigrid"
# Of the C and C++ libraries, which every Linux with Python has.
_SYSTEM = re.compile(r"(linux-vdso|ld-linux|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)\.so)")


def is_of_system(name):
    """Whether a library of this name is one of those that a wheel does not carry."""
    return _SYSTEM.match(name) is not None


def _toml():
    """A module that reads TOML; None: there is none, and a front end has to install one. Python has it
    from 3.11 on, and pip brings one along where it is a module of this environment."""
    for name in ("tomllib", "tomli", "pip._vendor.tomli"):
        try:
            return importlib.import_module(name)
        except ImportError:
            pass
    return None


def _project():
    with open(os.path.join(_TREE, "pyproject.toml"), "rb") as file:
        return _toml().load(file)["project"]


def _version():
    with open(os.path.join(_TREE, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(StreamingMultigrid VERSION ([0-9.]+)", file.read()).group(1)


def _metadata():
    project = _project()
    lines = [
        "Metadata-Version: 2.1",
        "Name: " + project["name"],
        "Version: " + _version(),
        "Summary: " + project["description"],
        "Requires-Python: " + project["requires-python"],
        "License: " + project["license"]["text"],
        "Keywords: " + ",".join(project["keywords"]),
    ]
    lines += ["Classifier: " + name for name in project["classifiers"]]
    lines += ["Requires-Dist: " + name for name in project["dependencies"]]
    for extra, names in project["optional-dependencies"].items():
        lines.append("Provides-Extra: " + extra)
        lines += ["Requires-Dist: %s; extra == '%s'" % (name, extra) for name in names]
    return "\n".join(lines) + "\n"


def _entry_points():
    lines = []
    for group, entries in _project()["entry-points"].items():
        lines.append("[%s]" % group)
        lines += ["%s = %s" % entry for entry in entries.items()]
    return "\n".join(lines) + "\n"


def _tag():
    return "py3-none-" + re.sub("[-.]", "_", sysconfig.get_platform())


def _wheel_file():
    return "Wheel-Version: 1.0\nGenerator: %s %s\nRoot-Is-Purelib: false\nTag: %s\n" % (
        _PACKAGE,
        _version(),
        _tag(),
    )


def _dist_info():
    return "%s-%s.dist-info" % (_PACKAGE, _version())


def _run(*command):
    subprocess.run(command, check=True, cwd=_TREE)


def _build(settings):
    """Builds the libraries; returns the build folder."""
    folder = os.path.join(_TREE, settings.get("build-dir", "build-wheel"))
    if not os.path.exists(os.path.join(folder, "CMakeCache.txt")):
        options = ["-GNinja"] if shutil.which("ninja") else []
        options += ["-DSMG_BUILD_%s=OFF" % part for part in ("VTK", "EXAMPLES", "TESTING")]
        options += ["-DSMG_USE_HYPRE=OFF", "-DCMAKE_BUILD_TYPE=Release"]
        options += ["-DSMG_PYTHON=" + sys.executable]  # for what type checkers read: it has NumPy
        options += ["-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=24"]
        _run("cmake", "-S", _TREE, "-B", folder, *options)
    targets = ("smgC", "smgVtkHdf", "smgPython")
    _run("cmake", "--build", folder, "--target", *targets, "--parallel", *settings.get("jobs", "").split())
    return folder


def _installed(build, prefix):
    """The files of the package with its libraries, as {path in the wheel: file}."""
    _run("cmake", "--install", build, "--component", "wheel", "--prefix", prefix, "--strip")
    found = {}
    for folder, _, names in os.walk(prefix):
        for name in names:
            # A wheel has no links: each library is there once, by the name that others ask for.
            if not re.search(r"\.so\.[0-9]+\.[0-9.]+$", name):
                path = os.path.join(folder, name)
                found[os.path.relpath(path, prefix)] = path
    return found


def _needed(library):
    """The libraries of the system that a library needs, and these need: {name: file}."""
    done = subprocess.run(["ldd", library], check=True, capture_output=True, text=True)
    missing = re.findall(r"^\s*(\S+) => not found", done.stdout, re.M)
    if missing:
        raise RuntimeError("%s needs %s, not found." % (library, ", ".join(missing)))
    pairs = re.findall(r"^\s*(\S+) => (/\S+)", done.stdout, re.M)
    return {
        name: os.path.realpath(path)
        for name, path in pairs
        if not is_of_system(name) and not name.startswith("libsmg")
    }


def _licences(files):
    """The licences of libraries of Debian packages: {package: file}."""
    found = {}
    if shutil.which("dpkg"):
        for file in files:
            # Debian knows some files by their names before /lib became a link to /usr/lib.
            names = [file, file.replace("/usr/lib/", "/lib/", 1)]
            done = subprocess.run(["dpkg", "-S", *names], capture_output=True, text=True)
            package = done.stdout.split(":")[0]
            path = "/usr/share/doc/%s/copyright" % package
            if package and os.path.exists(path):
                found[package] = path
    return found


def _bytes(path):
    with open(path, "rb") as file:
        return file.read()


def _libraries(installed, needed):
    """The libraries of a wheel, as {path in the wheel: bytes}: those of the package, and the libraries of
    the system that these need. All but those that the package opens by name have a name of their own."""
    data = {os.path.basename(inside): _bytes(file) for inside, file in installed.items()}
    data.update((soname, _bytes(file)) for soname, file in needed.items())
    opened = re.compile("libstreamingmultigrid|libsmgVtkHdf")
    names = {name: own_name(name, content) for name, content in data.items() if not opened.match(name)}
    return {
        "%s/lib/%s" % (_PACKAGE, names.get(name, name)): renamed(content, names)
        for name, content in data.items()
    }


class _Wheel:
    """A wheel that is written; its last file lists the others with their checksums."""

    def __init__(self, path):
        self._zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self._records = []

    def add(self, name, data, executable=False):
        if not isinstance(data, bytes):
            data = data.encode()
        entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes every time
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = (0o100755 if executable else 0o100644) << 16
        self._zip.writestr(entry, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self._records.append("%s,sha256=%s,%d" % (name, digest, len(data)))

    def add_file(self, name, path):
        self.add(name, _bytes(path))

    def close(self):
        record = _dist_info() + "/RECORD"
        self.add(record, "\n".join([*self._records, record + ",,"]) + "\n")
        self._zip.close()


def get_requires_for_build_wheel(config_settings=None):
    return get_requires_for_build_sdist() + ([] if importlib.util.find_spec("numpy") else ["numpy"])


def get_requires_for_build_sdist(config_settings=None):
    return [] if _toml() else ["tomli"]


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = os.path.join(metadata_directory, _dist_info())
    os.mkdir(folder)
    for name, text in (
        ("METADATA", _metadata()),
        ("WHEEL", _wheel_file()),
        ("entry_points.txt", _entry_points()),
    ):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    return _dist_info()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = _build(config_settings or {})
    name = "%s-%s-%s.whl" % (_PACKAGE, _version(), _tag())
    path = os.path.join(wheel_directory, name)
    wheel = _Wheel(path)
    with tempfile.TemporaryDirectory() as prefix:
        files = _installed(build, prefix)
        installed = {inside: file for inside, file in files.items() if ".so" in inside}
        library = next(file for file in installed.values() if "/libstreamingmultigrid.so" in file)
        needed = _needed(library)
        libraries = _libraries(installed, needed)
        for inside, file in sorted(files.items()):
            if inside not in installed:
                wheel.add_file(inside, file)
        for inside, content in sorted(libraries.items()):
            wheel.add(inside, content, executable=True)
    licences = _dist_info() + "/licenses/"
    wheel.add_file(licences + "LICENSE", os.path.join(_TREE, "LICENSE"))
    for package, file in sorted(_licences(needed.values()).items()):
        wheel.add_file("%s%s/copyright" % (licences, package), file)
    wheel.add(_dist_info() + "/METADATA", _metadata())
    wheel.add(_dist_info() + "/entry_points.txt", _entry_points())
    wheel.add(_dist_info() + "/WHEEL", _wheel_file())
    wheel.close()
    return name


def _source_files():
    """The files of the tree: those of git, or of an unpacked archive all."""
    if os.path.exists(os.path.join(_TREE, ".git")):
        done = subprocess.run(["git", "ls-files", "-z"], cwd=_TREE, check=True, capture_output=True)
        return sorted(name for name in done.stdout.decode().split("\0") if name)
    found = []
    for folder, folders, names in os.walk(_TREE):
        if folder == _TREE:
            folders[:] = [name for name in folders if not name.startswith("build")]
        folders[:] = [name for name in folders if name != "__pycache__"]
        found += [os.path.relpath(os.path.join(folder, name), _TREE) for name in names]
    return sorted(name for name in found if name != "PKG-INFO")


def build_sdist(sdist_directory, config_settings=None):
    stem = "%s-%s" % (_PACKAGE, _version())
    with tarfile.open(os.path.join(sdist_directory, stem + ".tar.gz"), "w:gz") as archive:
        for name in _source_files():
            archive.add(os.path.join(_TREE, name), "%s/%s" % (stem, name), recursive=False)
        text = _metadata().encode()
        entry = tarfile.TarInfo(stem + "/PKG-INFO")
        entry.size = len(text)
        archive.addfile(entry, io.BytesIO(text))
    return stem + ".tar.gz"
