# SPDX-License-Identifier: BSD-3-Clause
"""Plays what a user does in the real ParaView, on a virtual screen, and takes pictures of it.

A session is a list of events, of ParaView's own test player (names of widgets, not places on the
screen), and of checkpoints between them: functions in Python that run inside ParaView, as macros.
"""

import argparse
import os
import shutil
import signal
import struct
import subprocess
import sys
import zlib
from xml.sax.saxutils import quoteattr


def paraview_version():
    """Such as "5.11"."""
    import paraview
    return ".".join(paraview.__version__.split(".")[:2])


WINDOW = "pqClientMainWindow"
PANEL = WINDOW + "/propertiesDock/propertiesPanel"
PROPERTIES = PANEL + ("/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents"
                      "/PropertiesFrame/ProxyPanel")
VIEW = WINDOW + ("/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget"
                 "/MultiViewWidget1/Container/Frame.0/CentralWidgetFrame/Viewport"
                 "/1QVTKOpenGLNativeWidget0")
# Buttons without names: Auto Apply, where it has none, and Select Points On.
AUTO_APPLY = WINDOW + "/MainControlsToolbar/" + (
    "1QToolButton10" if paraview_version() == "5.11" else "actionAutoApply")
SELECT_POINTS = VIEW.split("/CentralWidgetFrame")[0] + "/TitleBar/ToolBar/1QToolButton9"
SCREEN = (1400, 900)


class Session:
    """Collects events; run() plays them. `module` is the Python file with the checkpoints."""

    def __init__(self, folder, plugin, module, pictures=None):
        self.folder = os.path.abspath(folder)
        self.pictures = pictures and os.path.abspath(pictures)
        self.plugin = plugin
        self.module = module
        self.events = []
        self.macros = {}
        self.menu("View/Toolbars", "Macros Toolbars")

    def event(self, widget, command, arguments=""):
        self.events.append(f"  <pqevent object={quoteattr(widget)} command={quoteattr(command)}"
                           f" arguments={quoteattr(str(arguments))}/>")

    def check(self, widget, name, value):
        """That a property of a widget of the panel has this value; otherwise ParaView fails."""
        self.events.append(f"  <pqcheck object={quoteattr(f'{PROPERTIES}/{widget}')} property={quoteattr(name)}"
                           f" arguments={quoteattr(str(value))}/>")

    def menu(self, path, action):
        names = {"File": "menu_File", "View": "menu_View", "Macros": "menu_Macros"}
        menus = [names.get(name, "menu" + name if i == 0 else name)
                 for i, name in enumerate(path.split("/"))]
        self.event("/".join([WINDOW, "menubar", *menus]), "activate", action)

    def filter(self, name):
        self.proxy("Filters", name)

    def source(self, name):
        self.proxy("Sources", name)

    def proxy(self, menu, name):
        """Of the category Streaming Multigrid of a menu."""
        if paraview_version() == "5.11":
            self.menu(menu + "/Streaming Multigrid", name)
        else:
            # A menu that opens updates which of its entries are enabled.
            self.event(f"{WINDOW}/menubar", "activate", "menu" + menu)
            self.event(f"{WINDOW}/menubar/menu{menu}/pqProxyGroupMenuManager0/{name}", "activate")

    def apply(self):
        self.event(PANEL + "/Accept", "activate")

    def open(self, path):
        self.menu("File", "actionFileOpen")
        self.event(WINDOW + "/FileOpenDialog", "filesSelected", path)

    def save_data(self, path):
        if os.path.exists(path):
            os.remove(path)
        self.menu("File", "actionFileSaveData")
        self.event(WINDOW + "/FileSaveDialog", "filesSelected", path)
        self.event(WINDOW + "/WriterSettingsDialog/widget/OKButton", "activate")

    def write(self, widget, text):
        """Into a line of the panel, ended by Return."""
        self.event(f"{PROPERTIES}/{widget}", "set_string", text)
        self.event(f"{PROPERTIES}/{widget}", "key", 16777220)

    def write_vector(self, widget, ends, numbers):
        for end, number in zip(ends, numbers):
            self.write(widget + end, number)

    def name_file(self, widget, path):
        self.write(widget + "/FileChooser/FileLineEdit", path)

    def scroll_panel(self, pixels):
        self.event(PANEL + "/scrollArea/qt_scrollarea_vcontainer/1QScrollBar0", "set_int", pixels)

    def choose(self, widget, entry):
        self.event(f"{PROPERTIES}/{widget}/ComboBox", "set_string", entry)

    def drag(self, begin, end, steps=8):
        """With the left button in the view; positions from (0, 0) at the top left to (1, 1)."""
        place = lambda t: tuple(b + t * (e - b) for b, e in zip(begin, end))
        at = lambda command, t, button, buttons: self.event(
            VIEW, command, "(%.5f,%.5f,%d,%d,0)" % (*place(t), button, buttons))
        at("mouseMove", 0.0, 0, 0)
        at("mousePress", 0.0, 1, 1)
        for step in range(1, steps + 1):
            at("mouseMove", step / steps, 0, 1)
        at("mouseRelease", 1.0, 1, 0)

    def checkpoint(self, function):
        self.macros[function] = (f"import sys\nsys.path.insert(0, {os.path.dirname(self.module)!r})\n"
                                 f"import {os.path.basename(self.module)[:-3]} as checkpoints\n"
                                 f"checkpoints.{function}()\n")
        self.menu("Macros", function)

    def picture(self, name):
        """Of the whole screen, if pictures are requested."""
        if self.pictures:
            path = os.path.join(self.pictures, name + ".png")
            self.macros["picture_" + name] = (
                f"import sys\nsys.path.insert(0, {os.path.dirname(__file__)!r})\n"
                f"import paraview_gui\nparaview_gui.take_picture({path!r})\n")
            self.menu("Macros", "picture_" + name)

    def run(self, timeout=2000):
        """Plays the session; returns the messages of ParaView. Raises RuntimeError if they contain errors."""
        settings = os.path.join(self.folder, "settings")
        screen = os.path.join(self.folder, "screen")
        macros = os.path.join(settings, "ParaView", "Macros")
        shutil.rmtree(settings, ignore_errors=True)
        for path in (macros, screen):
            os.makedirs(path, exist_ok=True)
        os.chmod(settings, 0o700)
        for name, text in self.macros.items():
            with open(os.path.join(macros, name + ".py"), "w") as file:
                file.write(text)
        # A wide panel, and no welcome dialog; the name is without a release from 6.1 on.
        for release in ("", *(f"{paraview_version()}.{patch}" for patch in range(9))):
            shutil.copy(os.path.join(os.path.dirname(__file__), "layout.ini"),
                        os.path.join(settings, "ParaView", f"ParaView{release}.ini"))
        script = os.path.join(self.folder, "session.xml")
        with open(script, "w") as file:
            file.write("<?xml version=\"1.0\" ?>\n<pqevents>\n" + "\n".join(self.events) +
                       "\n</pqevents>\n")
        environment = dict(os.environ, HOME=self.folder, XDG_CONFIG_HOME=settings,
                           XDG_RUNTIME_DIR=settings, PV_PLUGIN_PATH=os.path.dirname(self.plugin),
                           SMG_GUI_SCREEN=os.path.join(screen, "Xvfb_screen0"))
        width, height = SCREEN
        command = ["xvfb-run", "-a", "-n", os.environ.get("SMG_DISPLAY", "99"),
                   "-s", f"-screen 0 {width}x{height}x24 -noreset -nocursor -fbdir {screen}",
                   "paraview", "-qwindowgeometry", f"{width}x{height}+0+0",
                   "--test-script=" + script, "--exit"]
        # In its own process group, so that it can be ended completely if it hangs in a dialog.
        process = subprocess.Popen(command, env=environment, text=True, start_new_session=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        try:
            said, _ = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            said = process.communicate()[0] + "\ncritical: it took too long"
        bad = [word for word in ("critical:", "Traceback", "ERR|", "WARN|", "Warning:", "ERROR:")
               if word in said]
        if process.returncode != 0 or bad:
            raise RuntimeError(f"ParaView ended with {process.returncode}, said {bad}:\n{said}")
        return said


def take_picture(path):
    """Saves the whole virtual screen as PNG; inside ParaView."""
    with open(os.environ["SMG_GUI_SCREEN"], "rb") as file:
        data = file.read()
    header = struct.unpack(">25I", data[:100])
    begin, width, height, stride = header[0] + 12 * header[19], header[4], header[5], header[12]
    lines = bytearray()
    above = bytes(3 * width)
    for y in range(height):
        line = data[begin + y * stride:begin + y * stride + 4 * width]
        rgb = bytearray(3 * width)
        rgb[0::3], rgb[1::3], rgb[2::3] = line[2::4], line[1::4], line[0::4]
        # Filter 2 of PNG: the difference to the line above.
        lines += b"\2" + bytes((a - b) & 255 for a, b in zip(rgb, above))
        above = rgb
    chunk = lambda kind, body: (struct.pack(">I", len(body)) + kind + body +
                                struct.pack(">I", zlib.crc32(kind + body)))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" +
                   chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(bytes(lines), 9)) + chunk(b"IEND", b""))


def read_arguments():
    """PLUGIN MESH FOLDER and options. Ends the program with SKIPPED: without a GUI."""
    for program in ("paraview", "xvfb-run"):
        if not shutil.which(program):
            print("SKIPPED: there is no", program)
            sys.exit(0)
    parser = argparse.ArgumentParser()
    parser.add_argument("plugin")
    parser.add_argument("mesh")
    parser.add_argument("folder", help="for what the session writes")
    parser.add_argument("--pictures", help="folder for pictures of the screen")
    parser.add_argument("--guard", type=int, default=10000, help="Maximum Points In Memory")
    parser.add_argument("--timeout", type=int, default=200, help="seconds")
    arguments = parser.parse_args()
    for folder in (arguments.folder, arguments.pictures):
        if folder:
            os.makedirs(folder, exist_ok=True)
    return arguments
