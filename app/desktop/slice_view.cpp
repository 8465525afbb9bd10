// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/slice_view.h"

#include <fmt/format.h>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "app/desktop/theme.h"

namespace pellucid::app {

namespace {

// A drag over this many pixels changes width or level by the whole width it began with, so that narrow and
// wide windows, and data of any range, feel alike.
constexpr double kWindowDragPx = 256.0;
// A drag of this many pixels zooms by e.
constexpr double kZoomDragPx = 150.0;
constexpr double kWheelZoom = 1.15;
constexpr int kWheelNotch = 120;  // QWheelEvent: eighths of a degree.
constexpr int kPageSlices = 10;
constexpr double kMinZoom = 0.1, kMaxZoom = 100.0;

}  // namespace

SliceView::SliceView(Plane plane, Document& document, RenderService& service, QWidget* parent)
    : ViewWidget(static_cast<int>(plane), document, service, parent), m_plane(plane) {
    connect(&document, &Document::replaced, this, [this] {
        m_placement = {};
        m_askedScene = {};
    });
    connect(&document, &Document::sceneChanged, this, &SliceView::refresh);
    connect(&document, &Document::crosshairChanged, this, &SliceView::refresh);
}

Scene SliceView::shownScene() const {
    return sliceScene(document().scene(), document().volume().grid(), m_plane, document().crosshairMm(),
                      m_placement, pixelSize());
}

void SliceView::resetView() {
    m_placement = {};
    refresh();
}

void SliceView::setShowsCrosshair(bool shows) {
    m_showsCrosshair = shows;
    update();
}

void SliceView::refresh() {
    update();
    if (document().isEmpty() || !isVisible()) return;
    Scene scene = shownScene();
    if (scene == m_askedScene) return;
    m_askedScene = scene;
    ask({.scene = std::move(scene), .priority = RenderService::Priority::Slice});
}

RayFrame SliceView::frame() const {
    return rayFrame(shownScene().camera, document().volume().grid(), pixelSize());
}

glm::dvec3 SliceView::patientAt(QPointF position) const {
    return patientFromPicture(frame(), {position.x() / width(), position.y() / height()});
}

QPointF SliceView::positionOf(glm::dvec3 patientMm) const {
    const glm::dvec2 picture = pictureFromPatient(frame(), patientMm);
    return {picture.x * width(), picture.y * height()};
}

QString SliceView::probeText(QPointF position) const {
    if (document().isEmpty()) return {};
    const Volume& volume = document().volume();
    const glm::dvec3 patient = patientAt(position);
    const glm::dvec3 index = glm::round(transformPoint(indexFromPatient(volume.grid()), patient));
    for (int axis = 0; axis < 3; ++axis)
        if (index[axis] < 0.0 || index[axis] >= volume.grid().size[axis]) return {};
    const glm::ivec3 voxel(index);
    const double value = volume.physical(voxel, document().item().component);
    const std::string& unit = volume.mapping().unit;
    return QString::fromStdString(fmt::format("{:.6g}{}{}   {}   voxel {}, {}, {}", value,
                                              unit.empty() ? "" : " ", unit, positionText(patient), voxel.x,
                                              voxel.y, voxel.z));
}

void SliceView::beginDrag(const QMouseEvent& event) {
    m_windowAtPress = document().item().window.value_or(Window{});
    m_placementAtPress = m_placement;
    if (drag() == Drag::Crosshair) document().setCrosshairMm(patientAt(event.position()));
}

void SliceView::continueDrag(QPointF position) {
    const QPointF moved = position - pressedAt();
    switch (drag()) {
        case Drag::Primary:
            dragWindow(moved);
            return;
        case Drag::Crosshair:
            document().setCrosshairMm(patientAt(position));
            return;
        case Drag::Pan: {
            const RayFrame rays = frame();
            m_placement.panMm =
                m_placementAtPress.panMm + glm::dvec2(-moved.x() * 2.0 * glm::length(rays.right) / width(),
                                                      moved.y() * 2.0 * glm::length(rays.up) / height());
            break;
        }
        case Drag::Zoom:
            m_placement.zoom =
                std::clamp(m_placementAtPress.zoom * std::exp(-moved.y() / kZoomDragPx), kMinZoom, kMaxZoom);
            break;
        case Drag::Roll:
        case Drag::None:
            return;
    }
    refresh();
}

void SliceView::dragWindow(QPointF moved) {
    const double perPixel = m_windowAtPress.width / kWindowDragPx;
    // Upwards lowers the level, so the picture gets brighter.
    const Window window{m_windowAtPress.level + moved.y() * perPixel,
                        std::max(m_windowAtPress.width + moved.x() * perPixel, m_windowAtPress.width * 1e-3)};
    document().changeItem("Window and level", "window drag", [&](VolumeItem& item) { item.window = window; });
}

void SliceView::mouseMoveEvent(QMouseEvent* event) {
    ViewWidget::mouseMoveEvent(event);
    if (document().isEmpty()) return;
    if (event->buttons() == Qt::NoButton && event->modifiers() == Qt::ShiftModifier)
        document().setCrosshairMm(patientAt(event->position()));
    Q_EMIT probed(probeText(event->position()));
}

void SliceView::wheelEvent(QWheelEvent* event) {
    if (document().isEmpty()) return;
    const int turn = event->angleDelta().y();
    if (event->modifiers() & Qt::ControlModifier) {
        m_placement.zoom =
            std::clamp(m_placement.zoom * std::pow(kWheelZoom, static_cast<double>(turn) / kWheelNotch),
                       kMinZoom, kMaxZoom);
        refresh();
        return;
    }
    m_wheelRest += turn;
    document().stepSlice(m_plane, m_wheelRest / kWheelNotch);
    m_wheelRest %= kWheelNotch;
    Q_EMIT probed(probeText(event->position()));
}

void SliceView::keyPressEvent(QKeyEvent* event) {
    const bool isKeypad = event->modifiers() & Qt::KeypadModifier;
    switch (isKeypad ? 0 : event->key()) {
        case Qt::Key_Up:
            document().stepSlice(m_plane, 1);
            return;
        case Qt::Key_Down:
            document().stepSlice(m_plane, -1);
            return;
        case Qt::Key_PageUp:
            document().stepSlice(m_plane, kPageSlices);
            return;
        case Qt::Key_PageDown:
            document().stepSlice(m_plane, -kPageSlices);
            return;
        case Qt::Key_R:
            resetView();
            return;
        default:
            ViewWidget::keyPressEvent(event);
    }
}

void SliceView::leaveEvent(QEvent*) {
    Q_EMIT probed({});
}

void SliceView::paintOverlay(QPainter& painter) {
    if (m_showsCrosshair) paintCrosshair(painter);
    const QRectF inside = QRectF(rect()).adjusted(8, 6, -8, -6);
    drawOverlayText(painter, inside, Qt::AlignLeft | Qt::AlignTop, cornerText());
    const Window window = document().item().window.value_or(Window{});
    const auto text = fmt::format("W {:.4g}\nL {:.4g}", window.width, window.level);
    drawOverlayText(painter, inside, Qt::AlignRight | Qt::AlignTop, QString::fromStdString(text));
}

QString SliceView::cornerText() const {
    const Grid& grid = document().volume().grid();
    const glm::dvec3 crosshair = document().crosshairMm();
    return QString::fromStdString(fmt::format("{}\n{} / {}", sliceText(m_plane, crosshair),
                                              sliceNumber(grid, m_plane, crosshair) + 1,
                                              sliceRange(grid, m_plane).count));
}

void SliceView::paintCrosshair(QPainter& painter) const {
    constexpr double kGap = 10.0;
    // The vertical line is the plane whose normal runs along the picture's right, the horizontal one along
    // its up.
    const Plane vertical = m_plane == Plane::Sagittal ? Plane::Coronal : Plane::Sagittal;
    const Plane horizontal = m_plane == Plane::Axial ? Plane::Coronal : Plane::Axial;
    const QPointF centre = positionOf(document().crosshairMm());
    const auto pen = [](Plane plane) {
        QColor color = colorOf(plane);
        color.setAlpha(170);
        return QPen(color, 1.0);
    };
    painter.setPen(pen(vertical));
    painter.drawLine(QPointF(centre.x(), 0), QPointF(centre.x(), centre.y() - kGap));
    painter.drawLine(QPointF(centre.x(), centre.y() + kGap), QPointF(centre.x(), height()));
    painter.setPen(pen(horizontal));
    painter.drawLine(QPointF(0, centre.y()), QPointF(centre.x() - kGap, centre.y()));
    painter.drawLine(QPointF(centre.x() + kGap, centre.y()), QPointF(width(), centre.y()));
}

}  // namespace pellucid::app
