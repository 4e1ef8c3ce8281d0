# SPDX-License-Identifier: BSD-3-Clause
"""Panels show groups as the XML lists them: what a filter is asked, how that is solved, and what that may take last."""

import glob
import os
import sys
import xml.etree.ElementTree as xml

from paraview.simple import *
from paraview import servermanager as sm

LoadPlugin(sys.argv[1], ns=globals())
PROXIES = sys.argv[2]
LAST = ["Solver", "Resources", "Last Solve"]
RESOURCES = ["MemoryLimit", "ScratchDirectory", "ScratchLimit", "CheckpointDirectory", "NumberOfPieces", "NumberOfThreads"]

manager = sm.ProxyManager().SMProxyManager
with_groups = with_resources = 0
for path in glob.glob(os.path.join(PROXIES, "*.xml")):
    for group in xml.parse(path).getroot():
        for element in group if group.get("name") in ("sources", "filters") else ():
            name = element.get("name")
            proxy = manager.NewProxy(group.get("name"), name)
            order = sm.vtkSMOrderedPropertyIterator()
            order.SetProxy(proxy)
            names = []
            order.Begin()
            while not order.IsAtEnd():
                names.append(order.GetKey())
                order.Next()
            groups = {}
            for at in range(proxy.GetNumberOfPropertyGroups()):
                one = proxy.GetPropertyGroup(at)
                groups[one.GetXMLLabel()] = [proxy.GetPropertyName(one.GetProperty(i)) for i in range(one.GetNumberOfProperties())]
            # A panel shows all of a group where the first property of it is.
            shown = sorted(groups, key=lambda label: min(map(names.index, groups[label])))
            assert shown == list(groups), (name, shown)
            own = [label for label in shown if label not in LAST]
            assert shown == own + [label for label in LAST if label in shown] and (own or not shown), (name, shown)
            with_groups += bool(shown)
            if "Resources" in groups or not groups and "MemoryLimit" in names:
                listed = sum(groups.values(), []) or [each for each in names if each != "Input"]
                settable = [each for each in listed if not proxy.GetProperty(each).GetInformationOnly()]
                first = min(settable.index(each) for each in RESOURCES if each in settable)
                assert set(settable[first:]) <= set(RESOURCES), (name, settable)
                with_resources += 1
            proxy.UnRegister(None)
assert with_groups >= 10 and with_resources >= 7, (with_groups, with_resources)
print("passed")
