# SPDX-License-Identifier: BSD-3-Clause
"""What may be on the disk after a power cut, from a record of the calls that changed files
(Testing/Faults/Recorder.cpp), as in LevelDB's fault_injection_test and in ALICE [1].

Durable is what POSIX promises: the content of a file up to its last fsync, and the names of a folder up
to the last fsync of the folder. What came later may be lost or kept:
  names     each creation, link, renaming and removal by itself, in any combination; a renaming of a
            file may also leave both names (it puts the new name before it removes the old one)
  contents  each page of 4 KiB by itself; the size may be kept without the pages, whose new bytes are
            then zeros, or arbitrary ones. Bytes beside those that were written stay, as SQLite assumes

[1] Pillai et al., All File Systems Are Not Created Equal: On the Complexity of Crafting Crash-Consistent
    Applications, OSDI 2014.
"""

import hashlib
import os
import shutil

PAGE = 4096


def apply(content, changes):
    """The content of a file after these writes and changes of its size."""
    content = bytearray(content)
    for change in changes:
        if isinstance(change, int):
            del content[change:]
            content.extend(bytes(change - len(content)))
        else:
            offset, written = change
            content.extend(bytes(max(0, offset - len(content))))
            content[offset:offset + len(written)] = written
    return bytes(content)


class File:
    """Its durable content, and the changes since."""

    def __init__(self, content=b""):
        self.durable = content
        self.changes = []

    def now(self):
        return apply(self.durable, self.changes)

    def sync(self):
        self.durable = self.now()
        self.changes = []

    def content(self, how, rng):
        """What a power cut leaves: of the changes `none`, `all`, the `size` without the pages, a
        `prefix` of the bytes, or each page by itself, the others as before, as `zeros` or `garbage`."""
        if not self.changes or how == "none":
            return self.durable
        new = self.now()
        if how == "all":
            return new
        if how == "prefix":
            # Whole changes, then a part of a write, cut off at a page.
            count = rng.randrange(len(self.changes))
            part = self.changes[count]
            if not isinstance(part, int):
                offset, written = part
                part = (offset, written[:rng.randrange(0, len(written) + 1, PAGE)])
            return apply(self.durable, self.changes[:count] + [part])
        found = bytearray(new)
        for begin, end in self.changed_parts(len(new)):
            if how != "size" and rng.random() < 0.5:
                continue
            lost = rng.randbytes(end - begin) if how == "garbage" else bytes(end - begin)
            old = self.durable[begin:end] if how == "size" or rng.random() < 0.5 else b""
            found[begin:end] = old + lost[len(old):]
        return bytes(found)

    def changed_parts(self, size):
        """The bytes of each change, or of the growth to this size, in each page."""
        old = len(self.durable)
        written = [(offset, offset + len(data)) for offset, data in
                   (change for change in self.changes if not isinstance(change, int))]
        for first, last in [*written, (old, size)]:
            last = min(last, size)
            while first < last:
                end = min(last, first - first % PAGE + PAGE)
                yield first, end
                first = end


CONTENTS = ("none", "all", "size", "prefix", "zeros", "garbage")


class Folder:
    """Its durable names, and the changes since, which may each be lost: lists of (name, file or folder,
    or None where it is removed)."""

    def __init__(self):
        self.durable = {}
        self.changes = []

    def now(self):
        names = dict(self.durable)
        for change in self.changes:
            put(names, change)
        return names

    def sync(self):
        self.durable = self.now()
        self.changes = []


def put(names, change):
    for name, entry in change:
        if entry is None:
            names.pop(name, None)
        else:
            names[name] = entry


class Disk:
    """The files below a folder, which are durable at first, and the calls that change them."""

    def __init__(self, top):
        self.top = os.path.abspath(top)
        self.root = read_tree(self.top)
        self.open = {}

    def inside(self, path):
        return path == self.top or path.startswith(self.top + "/")

    def place(self, path):
        """The folder of a path and the last name."""
        folder = self.root
        *folders, name = os.path.relpath(path, self.top).split("/")
        for each in folders:
            folder = folder.now()[each]
        return folder, name

    def find(self, path):
        if path == self.top:
            return self.root
        folder, name = self.place(path)
        return folder.now().get(name)

    def call(self, words, data):
        """Does a call of the record."""
        kind, *rest = words.split(" ", 1)
        if hasattr(self, "call_" + kind):
            getattr(self, "call_" + kind)(rest[0], data)
        else:
            raise ValueError("unknown call: " + words)

    def call_open(self, rest, _):
        file, flags, path = rest.split(" ", 2)
        flags = int(flags)
        self.open.pop(file, None)
        if not self.inside(path):
            return
        if flags & os.O_TMPFILE == os.O_TMPFILE:
            self.open[file] = File()
            return
        found = self.find(path)
        if found is None:
            assert flags & os.O_CREAT, path
            found = File()
            folder, name = self.place(path)
            folder.changes.append([(name, found)])
        if flags & os.O_TRUNC:
            found.changes.append(0)
        self.open[file] = found

    def call_close(self, file, _):
        self.open.pop(file, None)

    def call_fsync(self, file, _):
        if file in self.open:
            self.open[file].sync()

    def call_pwrite(self, rest, data):
        file, offset, _ = rest.split(" ")
        if file in self.open:
            self.open[file].changes.append((int(offset), data))

    def call_ftruncate(self, rest, _):
        file, size = rest.split(" ")
        if file in self.open:
            self.open[file].changes.append(int(size))

    def call_link(self, rest, _):
        file, path = rest.split(" ", 1)
        folder, name = self.place(path)
        folder.changes.append([(name, self.open[file])])

    def call_rename(self, rest, _):
        source, target = rest.split("\t")
        if not self.inside(target):
            return
        folder, name = self.place(source)
        other, new = self.place(target)
        assert folder is other, "a renaming between folders: " + rest
        folder.changes.append([(new, folder.now()[name]), (name, None)])

    def remove(self, path, _):
        if self.inside(path):
            folder, name = self.place(path)
            folder.changes.append([(name, None)])

    call_unlink = call_rmdir = remove

    def call_mkdir(self, path, _):
        if self.inside(path):
            folder, name = self.place(path)
            folder.changes.append([(name, Folder())])

    def tree(self, choose, content, folder=None):
        """The files after a power cut, by path, with None for folders. `choose` gets the changes of the
        names of a folder and returns those that are kept, `content` a file and returns its content."""
        folder = folder or self.root
        names = dict(folder.durable)
        for change in choose(folder.changes):
            put(names, change)
        found = {}
        for name, entry in names.items():
            if isinstance(entry, File):
                found[name] = content(entry)
            else:
                found[name] = None
                for below, each in self.tree(choose, content, entry).items():
                    found[name + "/" + below] = each
        return found

    def changes(self, folder=None):
        """The numbers of changes of names and of files that may be lost."""
        folder = folder or self.root
        names, files = len(folder.changes), 0
        for entry in folder.now().values():
            if isinstance(entry, File):
                files += bool(entry.changes)
            else:
                more = self.changes(entry)
                names, files = names + more[0], files + more[1]
        return names, files

    def states(self, rng, samples):
        """Trees after a power cut: the extreme ones, all combinations of names where they are few, and
        so many random ones of names, in any order and as prefixes, and contents."""
        everything, nothing = list, lambda changes: []
        for choose in (everything, nothing):
            for how in CONTENTS[:3]:
                yield self.tree(choose, lambda file, how=how: file.content(how, rng))
        names, files = self.changes()
        if 2 <= names <= 3:
            for kept in range(1, 2 ** names - 1):
                numbers = iter(range(names))
                choose = lambda changes: [each for each in changes if kept >> next(numbers, 0) & 1]
                yield self.tree(choose, lambda file: file.content("all", rng))
        if names + files > 0:
            for number in range(samples):
                choose = self.prefix(rng) if number % 3 == 2 else self.subset(rng)
                yield self.tree(choose, lambda file: file.content(rng.choice(CONTENTS), rng))

    @staticmethod
    def prefix(rng):
        """File systems with an ordered journal."""
        return lambda changes: changes[:rng.randint(0, len(changes))]

    @staticmethod
    def subset(rng):
        """File systems that promise nothing; a renaming may leave both names."""
        likely = rng.choice((0.1, 0.5, 0.9))

        def choose(changes):
            kept = [each for each in changes if rng.random() < likely]
            return [each[:1] if isinstance(each[0][1], File) and rng.random() < 0.2 else each
                    for each in kept]
        return choose


def read_record(name):
    """The calls: words and data."""
    with open(name, "rb") as file:
        while line := file.readline():
            words = line[:-1].decode()
            data = None
            if words.startswith("pwrite "):
                data = file.read(int(words.rsplit(" ", 1)[1]))
                assert file.read(1) == b"\n", "a damaged record"
            yield words, data


def read_tree(path):
    folder = Folder()
    for name in os.listdir(path):
        below = os.path.join(path, name)
        if os.path.isdir(below):
            folder.durable[name] = read_tree(below)
        else:
            with open(below, "rb") as file:
                folder.durable[name] = File(file.read())
    return folder


def flat(top):
    """The files below a folder as they are now, as Disk.tree() has them."""
    return Disk(top).tree(list, File.now)


def write_tree(top, tree):
    """Replaces what is below a folder."""
    for name in os.listdir(top):
        path = os.path.join(top, name)
        if os.path.isdir(path):
            shutil.rmtree(path)
        else:
            os.remove(path)
    for name, content in tree.items():
        path = os.path.join(top, name)
        if content is None:
            os.mkdir(path)
        else:
            with open(path, "wb") as file:
                file.write(content)


def digest(tree):
    """Equal for equal trees."""
    found = hashlib.sha256()
    for name in sorted(tree):
        content = tree[name]
        found.update(repr((name, content is None or len(content))).encode())
        found.update(content or b"")
    return found.digest()
