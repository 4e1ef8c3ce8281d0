# SPDX-License-Identifier: BSD-3-Clause
"""A number that is out of its range is an error that names the property as the panel does: for every numeric
property of every proxy of the plugin, by its XML."""

import glob
import os
import sys
import xml.etree.ElementTree as xml

import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkOutputWindow, vtkStringOutputWindow

vtkOutputWindow.SetInstance(vtkStringOutputWindow())  # the errors are wanted
LoadPlugin(sys.argv[1], ns=globals())
PROXIES = sys.argv[2]

# What makes a property count.
MODES = {"Coefficient": {"Condition": 2}, "Scale": {"Motion": 1}, "RotationAxis": {"Motion": 1}, "Center": {"Motion": 1},
         "Translation": {"Motion": 1}, "RotationAngle": {"Motion": 1}, "EdgeAngle": {"KeepEdges": 1},
         "WeldDistance": {"Weld": 1}, "Ids": {"Region": 2}, "Points": {"Region": 3}, "Radius": {"Region": 2},
         "Tag": {"Region": 4}, "PointTargets": {"Region": 3}}
NAN = float("nan")


def is_number(element):
    # The numbers of ParaView's own classes are not ours to check: HandleTransform is one.
    return (element.tag in ("IntVectorProperty", "DoubleVectorProperty", "IdTypeVectorProperty")
            and element.get("information_only") != "1" and element.find("BooleanDomain") is None)


def proxies():
    """(group, name in Python) of each proxy that a user can make, and its numbers, with those of its bases."""
    found, bases, labels = {}, {}, {}
    for path in glob.glob(os.path.join(PROXIES, "*.xml")):
        for group in xml.parse(path).getroot():
            for proxy in group:
                key = group.get("name"), proxy.get("name")
                bases[key] = proxy.get("base_proxygroup"), proxy.get("base_proxyname")
                labels[key] = group.get("name"), (proxy.get("label") or proxy.get("name")).replace(" ", "")
                found[key] = [element for element in proxy if is_number(element)]
    for key in found:
        if key[0] in ("sources", "filters", "writers"):
            numbers, at = [], key
            while at in found:
                numbers += found[at]
                at = bases[at]
            yield labels[key], numbers


def error_of(proxy):
    try:
        proxy.UpdatePipeline()
    except RuntimeError:
        pass
    proxy.UpdatePropertyInformation()
    return proxy.GetPropertyValue("Error") or ""


def make(key):
    """A proxy that works as it is, at least until its numbers are looked at."""
    group, name = key
    made = getattr(getattr(servermanager, group), name)()
    if group == "filters":
        made.Input = reader
    elif made.SMProxy.GetProperty("FileName"):
        made.FileName = t.BUNNY
    if made.SMProxy.GetProperty("OutputFileName"):
        made.OutputFileName = os.path.join(folder, "converted.vsm")
    return made


folder = t.make_folder()
reader = StreamingMeshReader(FileName=t.BUNNY)
reader.UpdatePipeline()
messages = {}
checked = 0
for key, numbers in proxies():
    for element in numbers:
        name = element.get("name")
        if key[0] == "writers":
            proxy = getattr(servermanager.writers, key[1])(Input=reader, FileName=os.path.join(folder, "written.pvtp"))
        else:
            proxy = make(key)
        for mode, value in MODES.get(name, {}).items():
            servermanager.vtkSMPropertyHelper(proxy.SMProxy, mode).Set(value)
        helper = servermanager.vtkSMPropertyHelper(proxy.SMProxy, name)
        is_real = element.tag == "DoubleVectorProperty"
        size = int(element.get("number_of_elements_per_command") or element.get("number_of_elements") or 1)
        for k in range(max(size, 1)):
            helper.Set(k, NAN if is_real else -1000)
        proxy.SMProxy.UpdateVTKObjects()
        if key[0] == "writers":
            proxy.UpdatePipeline()
            error = vtkOutputWindow.GetInstance().GetOutput()
            vtkOutputWindow.SetInstance(vtkStringOutputWindow())
        else:
            error = error_of(proxy)
        expected = f"{element.get('label') or name} is {'nan' if is_real else -1000}: set it to "
        if expected not in error:
            messages[key[1], name] = error
        checked += 1
        Delete(proxy)
assert checked > 90, checked
assert not messages, "\n".join(f"{key}: {text}" for key, text in messages.items())
os.write(1, b"passed\n")
