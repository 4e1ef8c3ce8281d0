// SPDX-License-Identifier: BSD-3-Clause
#include "TracedSelections.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPythonInterpreter.h"

namespace smg
{
namespace
{

/** Extends ParaView's tracing by its own means, an accessor: of a region filter, an unregistered
 * selection is traced as the expression that makes it, without a place in the Pipeline Browser.
 * It waits for the module of tracing, which connects to a server if it is imported too early. */
constexpr const char* Extension = R"python(
def _smg_trace_selections():
    import importlib.abc, importlib.util, sys

    def extend(smtrace):
        servermanager = smtrace.sm

        def written(proxy):
            values = []
            for name in proxy.ListProperties():
                value = proxy.GetProperty(name)
                if isinstance(value, servermanager.ProxyProperty):
                    values.append("%s=[%s]" % (name, ", ".join(written(x) for x in value[:])))
                elif not value.GetInformationOnly() and not value.IsValueDefault():
                    values.append("%s=%r" % (name, value))
            group, made = proxy.SMProxy.GetXMLGroup(), type(proxy).__name__
            if not hasattr(getattr(servermanager, group, None), made):
                raise smtrace.Untraceable("a selection by %s" % made)
            return "servermanager.%s.%s(%s)" % (group, made, ", ".join(values))

        class Selection(smtrace.PropertyTraceHelper):
            def get_value(self):
                for proxy in self.get_object()[:]:
                    if proxy and not smtrace.Trace.get_registered_name(proxy, "sources"):
                        try:
                            return written(proxy)
                        except smtrace.Untraceable as reason:
                            smtrace.Trace.Output.append_separated("# left out: %s" % reason.LogMessage)
                            return "None"
                return smtrace.PropertyTraceHelper.get_value(self)

        def accessor(name, proxy, *others, **named):
            if proxy.GetVTKClassName() not in ("vtkMeshRegion", "vtkMeshHandle", "vtkMeshCondition"):
                raise NotImplementedError
            made = smtrace.RealProxyAccessor(name, proxy, *others, **named)
            made.OrderedProperties = [
                Selection(x.get_property_name(), made) if x.get_property_name() == "Selection" else x
                for x in made.OrderedProperties]
            return made

        smtrace.RealProxyAccessor.register_create_callback(accessor)

    class Finder(importlib.abc.MetaPathFinder):
        def find_spec(self, name, path=None, target=None):
            if name != "paraview.smtrace":
                return None
            sys.meta_path.remove(self)
            spec = importlib.util.find_spec(name)
            if spec and spec.loader:
                execute = spec.loader.exec_module

                def exec_module(module):
                    execute(module)
                    extend(module)

                spec.loader.exec_module = exec_module
            return spec

    present = sys.modules.get("paraview.smtrace")
    if hasattr(present, "RealProxyAccessor"):
        extend(present)
    else:
        sys.meta_path.insert(0, Finder())

_smg_trace_selections()
del _smg_trace_selections
)python";

void extend(vtkObject* = nullptr, unsigned long = 0, void* = nullptr, void* = nullptr)
{
  vtkPythonInterpreter::RunSimpleString(Extension);
}

} // namespace

void traceSelections()
{
  // ParaView's window starts Python when it is first needed.
  static const vtkNew<vtkPythonInterpreter> interpreter;
  static const vtkNew<vtkCallbackCommand> command;
  command->SetCallback(extend);
  interpreter->AddObserver(vtkCommand::EnterEvent, command);
  if (vtkPythonInterpreter::IsInitialized())
  {
    extend();
  }
}

} // namespace smg
