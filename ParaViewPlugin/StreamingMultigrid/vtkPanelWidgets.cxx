// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPanelWidgets.h"

#include "pqApplicationCore.h"
#include "pqIntVectorPropertyWidget.h"
#include "pqInterfaceTracker.h"
#include "pqPropertyWidget.h"
#include "pqPropertyWidgetInterface.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>

#include <string>

namespace
{

/** A string that cannot be edited. */
class TextWidget : public pqPropertyWidget
{
public:
  TextWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
    : pqPropertyWidget(proxy, parent)
  {
    auto* text = new QLabel(this);
    text->setObjectName("Text");
    text->setWordWrap(true);
    text->setTextFormat(Qt::PlainText);
    text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(text);
    // A link needs a signal of changes by the user, of which there are none.
    this->addPropertyLink(text, "text", SIGNAL(linkActivated(QString)), property);
  }
};

pqPropertyWidget* newNumber(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
{
  auto* widget = new pqIntVectorPropertyWidget(property, proxy, parent);
  vtkPVXMLElement* hints = property->GetHints();
  vtkPVXMLElement* unit = hints ? hints->FindNestedElementByName("Unit") : nullptr;
  if (unit && widget->layout())
  {
    auto* label = new QLabel(unit->GetAttributeOrEmpty("text"), widget);
    label->setObjectName("Unit");
    widget->layout()->addWidget(label);
  }
  return widget;
}

class PanelWidgets : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  using QObject::QObject;

  pqPropertyWidget* createWidgetForProperty(
    vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent) override
  {
    const char* name = property ? property->GetPanelWidget() : nullptr;
    const std::string kind = name ? name : "";
    return kind == "smg_text"     ? new TextWidget(proxy, property, parent)
           : kind == "smg_number" ? newNumber(proxy, property, parent)
                                  : nullptr;
  }
};

void addTo(pqApplicationCore* application)
{
  if (application)
  {
    application->interfaceTracker()->addInterface(new PanelWidgets(application));
  }
}

} // namespace

void smg::addPanelWidgets()
{
  if (pqApplicationCore* application = pqApplicationCore::instance())
  {
    addTo(application);
  }
  else if (qApp)
  {
    // Plugins of PV_PLUGIN_PATH are loaded while ParaView starts.
    QTimer::singleShot(0, qApp, [] { addTo(pqApplicationCore::instance()); });
  }
}

#include "vtkPanelWidgets.moc"
