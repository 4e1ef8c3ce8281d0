// SPDX-License-Identifier: BSD-3-Clause
#include "PanelWidgets.h"

#include "IO/Files/Decompressor.h"

#include "pqApplicationCore.h"
#include "pqDoubleVectorPropertyWidget.h"
#include "pqIntVectorPropertyWidget.h"
#include "pqInterfaceTracker.h"
#include "pqPropertyWidget.h"
#include "pqPropertyWidgetInterface.h"
#include "vtkCommand.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSmartPointer.h"

#include <QApplication>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>

#include <filesystem>
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
    this->Text->setObjectName("Text");
    this->Text->setWordWrap(true);
    this->Text->setTextFormat(Qt::PlainText);
    this->Text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(this->Text);
    // A link needs a signal of changes by the user, of which there are none.
    this->addPropertyLink(this->Text, "text", SIGNAL(linkActivated(QString)), property);
  }

protected:
  QLabel* Text = new QLabel(this);
};

/** The estimate of a conversion for the file that is chosen, before that is applied, and what it
 * has made of it after. An Output File Name that the user has not chosen follows the file. */
class ConversionWidget : public TextWidget
{
public:
  ConversionWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
    : TextWidget(proxy, property, parent)
    , Input(proxy->GetProperty("FileName"))
    , Output(proxy->GetProperty("OutputFileName"))
  {
    this->Observer = this->Input->AddObserver(
      vtkCommand::UncheckedPropertyModifiedEvent, this, &ConversionWidget::update);
    this->Applied =
      proxy->AddObserver(vtkCommand::UpdateDataEvent, this, &ConversionWidget::update);
    // The other widgets of the panel, which show what is suggested, are made after this one.
    QTimer::singleShot(0, this, [this] { this->update(); });
  }
  ~ConversionWidget() override
  {
    this->Input->RemoveObserver(this->Observer);
    this->proxy()->RemoveObserver(this->Applied);
  }

private:
  void update()
  {
    const std::string name = vtkSMUncheckedPropertyHelper(this->Input).GetAsString();
    if (name.empty())
    {
      return;
    }
    const std::string chosen = vtkSMUncheckedPropertyHelper(this->Output).GetAsString();
    if (chosen.empty() || chosen == this->Suggested)
    {
      std::filesystem::path beside = name;
      beside.replace_extension(smg::isCompressedSuffix(beside.extension().string()) ? "" : ".vsm");
      beside.replace_extension(".vsm");
      this->Suggested = beside.string() == name ? "" : beside.string();
      vtkSMUncheckedPropertyHelper(this->Output).Set(this->Suggested.c_str());
    }
    // Only the server knows the file: another converter, which converts nothing, is asked there.
    vtkSMProxy* self = this->proxy();
    const auto other = vtkSmartPointer<vtkSMProxy>::Take(
      self->GetSessionProxyManager()->NewProxy(self->GetXMLGroup(), self->GetXMLName()));
    other->Copy(self);
    vtkSMPropertyHelper(other, "FileName").Set(name.c_str());
    vtkSMPropertyHelper(other, "OutputFileName")
      .Set(vtkSMUncheckedPropertyHelper(this->Output).GetAsString());
    other->UpdateVTKObjects();
    other->UpdatePropertyInformation();
    this->Text->setText(vtkSMPropertyHelper(other, "Estimate").GetAsString());
  }

  vtkSmartPointer<vtkSMProperty> Input, Output;
  unsigned long Observer = 0, Applied = 0;
  std::string Suggested;
};

pqPropertyWidget* newNumber(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
{
  pqPropertyWidget* widget = nullptr;
  if (property->IsA("vtkSMDoubleVectorProperty"))
  {
    widget = new pqDoubleVectorPropertyWidget(property, proxy, parent);
  }
  else
  {
    widget = new pqIntVectorPropertyWidget(property, proxy, parent);
  }
  vtkPVXMLElement* hints = property->GetHints();
  vtkPVXMLElement* unit = hints ? hints->FindNestedElementByName("Unit") : nullptr;
  if (unit && widget->layout())
  {
    auto* label = new QLabel(unit->GetAttributeOrEmpty("text"), widget);
    label->setObjectName("Unit");
    auto* grid = qobject_cast<QGridLayout*>(widget->layout());
    grid ? grid->addWidget(label, 0, grid->columnCount()) : widget->layout()->addWidget(label);
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
    return kind == "smg_text"         ? new TextWidget(proxy, property, parent)
           : kind == "smg_conversion" ? new ConversionWidget(proxy, property, parent)
           : kind == "smg_number"     ? newNumber(proxy, property, parent)
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

#include "PanelWidgets.moc"
