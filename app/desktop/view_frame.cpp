// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/view_frame.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include "app/desktop/theme.h"

namespace pellucid::app {

namespace {

struct StandardView {
    const char* letter;
    const char* tip;
    AnatomicalView view;
};
constexpr StandardView kStandardViews[] = {{"A", "From anterior", AnatomicalView::Anterior},
                                           {"P", "From posterior", AnatomicalView::Posterior},
                                           {"L", "From the patient's left", AnatomicalView::Left},
                                           {"R", "From the patient's right", AnatomicalView::Right},
                                           {"S", "From superior", AnatomicalView::Superior},
                                           {"I", "From inferior", AnatomicalView::Inferior}};

}  // namespace

ViewFrame::ViewFrame(SliceView* view, Document& document, QWidget* parent) : QFrame(parent), m_view(view) {
    const Plane plane = view->plane();
    setObjectName(QString::fromLatin1(name(plane)).toLower() + QStringLiteral("Frame"));
    view->setObjectName(QString::fromLatin1(name(plane)).toLower() + QStringLiteral("View"));
    QHBoxLayout* bar = build(tr(name(plane)), colorOf(plane));
    auto* slider = new QSlider(Qt::Horizontal, this);
    slider->setObjectName(QStringLiteral("sliceSlider"));
    slider->setFocusPolicy(Qt::NoFocus);
    bar->addWidget(slider, 1);
    connect(slider, &QSlider::valueChanged, &document,
            [&document, plane](int number) { document.setSliceNumber(plane, number); });
    connect(&document, &Document::crosshairChanged, slider, [&document, plane, slider] {
        const QSignalBlocker quiet(slider);
        slider->setRange(0, sliceRange(document.volume().grid(), plane).count - 1);
        slider->setValue(sliceNumber(document.volume().grid(), plane, document.crosshairMm()));
    });
}

ViewFrame::ViewFrame(VolumeView* view, Document&, QWidget* parent) : QFrame(parent), m_view(view) {
    setObjectName(QStringLiteral("volumeFrame"));
    view->setObjectName(QStringLiteral("volumeView"));
    QHBoxLayout* bar = build(tr("3D"), volumeViewColor());
    bar->addStretch(1);
    for (const StandardView& standard : kStandardViews) {
        auto* button = new QToolButton(this);
        button->setObjectName(QStringLiteral("view") + QLatin1String(standard.letter));
        button->setText(QLatin1String(standard.letter));
        button->setToolTip(tr(standard.tip));
        button->setFocusPolicy(Qt::NoFocus);
        connect(button, &QToolButton::clicked, view,
                [view, which = standard.view] { view->setStandardView(which); });
        bar->addWidget(button);
    }
}

QHBoxLayout* ViewFrame::build(const QString& title, const QColor& color) {
    auto* header = new QWidget(this);
    header->setObjectName(QStringLiteral("viewHeader"));
    header->setAutoFillBackground(true);
    QPalette palette = header->palette();
    palette.setColor(QPalette::Window, barColor(color));
    header->setPalette(palette);
    header->setFixedHeight(22);
    auto* bar = new QHBoxLayout(header);
    bar->setContentsMargins(8, 0, 4, 0);
    bar->setSpacing(2);
    bar->addWidget(new QLabel(title, header));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(header);
    layout->addWidget(m_view, 1);
    return bar;
}

}  // namespace pellucid::app
