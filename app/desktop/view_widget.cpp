// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/view_widget.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "app/desktop/theme.h"

namespace pellucid::app {

ViewWidget::ViewWidget(int channel, Document& document, RenderService& service, QWidget* parent)
    : QWidget(parent), m_channel(channel), m_document(document), m_service(service) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(120, 90);
    setAttribute(Qt::WA_OpaquePaintEvent);
    connect(&service, &RenderService::replied, this, &ViewWidget::take);
    connect(&document, &Document::replaced, this, [this] {
        m_picture = {};
        m_lastReply.reset();
        m_error.clear();
    });
}

glm::ivec2 ViewWidget::pixelSize() const {
    const double ratio = devicePixelRatioF();
    return {std::max(1, static_cast<int>(std::lround(width() * ratio))),
            std::max(1, static_cast<int>(std::lround(height() * ratio)))};
}

EdgeLetters ViewWidget::letters() const {
    if (m_document.isEmpty()) return {};
    const double aspect = static_cast<double>(width()) / std::max(1, height());
    return edgeLetters(resolvedPose(shownScene().camera, m_document.volume().grid(), aspect));
}

void ViewWidget::setShowsOverlay(bool shows) {
    m_showsOverlay = shows;
    update();
}

void ViewWidget::ask(RenderService::Request request) {
    request.channel = m_channel;
    request.volumes = m_document.volumes();
    m_asked = m_service.request(std::move(request));
}

void ViewWidget::take(const RenderService::Reply& reply) {
    if (reply.channel != m_channel) return;
    m_answered = std::max(m_answered, reply.number);
    m_error = reply.error ? QString::fromStdString(reply.error->text()) : QString{};
    if (!reply.error) m_picture = reply.picture;
    m_lastReply = reply;
    received(reply);
    update();
    Q_EMIT pictureShown(reply);
}

void ViewWidget::received(const RenderService::Reply&) {}

void ViewWidget::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), Qt::black);
    if (m_document.isEmpty()) return;
    if (!m_picture.isNull()) {
        const glm::ivec2 size = pixelSize();
        painter.setRenderHint(QPainter::SmoothPixmapTransform, m_picture.size() != QSize(size.x, size.y));
        painter.drawImage(QRectF(rect()), m_picture);
    }
    painter.setRenderHint(QPainter::Antialiasing);
    if (m_showsOverlay) {
        paintOverlay(painter);
        paintLetters(painter);
    }
    if (!m_error.isEmpty())
        drawOverlayText(painter, QRectF(rect()).adjusted(24, 24, -24, -24),
                        Qt::AlignCenter | Qt::TextWordWrap, m_error);
}

void ViewWidget::paintLetters(QPainter& painter) const {
    const EdgeLetters edges = letters();
    QFont font = painter.font();
    font.setBold(true);
    font.setPointSizeF(font.pointSizeF() * 1.2);
    painter.setFont(font);
    const QRectF inside = QRectF(rect()).adjusted(6, 4, -6, -4);
    drawOverlayText(painter, inside, Qt::AlignLeft | Qt::AlignVCenter, QString::fromStdString(edges.left));
    drawOverlayText(painter, inside, Qt::AlignRight | Qt::AlignVCenter, QString::fromStdString(edges.right));
    drawOverlayText(painter, inside, Qt::AlignTop | Qt::AlignHCenter, QString::fromStdString(edges.top));
    drawOverlayText(painter, inside, Qt::AlignBottom | Qt::AlignHCenter,
                    QString::fromStdString(edges.bottom));
}

ViewWidget::Drag ViewWidget::dragOf(const QMouseEvent& event, Drag withControl) {
    const auto modifiers = event.modifiers();
    if (event.button() == Qt::MiddleButton) return Drag::Pan;
    if (event.button() == Qt::RightButton) return Drag::Zoom;
    if (event.button() != Qt::LeftButton) return Drag::None;
    if (modifiers & Qt::ShiftModifier) return Drag::Pan;
    return modifiers & Qt::ControlModifier ? withControl : Drag::Primary;
}

void ViewWidget::mousePressEvent(QMouseEvent* event) {
    if (m_document.isEmpty() || m_drag != Drag::None) return;
    m_drag = dragFor(*event);
    m_dragButton = event->button();
    m_pressedAt = event->position();
    beginDrag(*event);
}

void ViewWidget::mouseMoveEvent(QMouseEvent* event) {
    if (m_drag != Drag::None && !m_document.isEmpty()) continueDrag(event->position());
}

void ViewWidget::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != m_dragButton) return;
    m_drag = Drag::None;
    m_dragButton = Qt::NoButton;
    m_document.endGesture();
}

void ViewWidget::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && event->modifiers() == Qt::NoModifier) Q_EMIT maximiseAsked();
}

void ViewWidget::enterEvent(QEnterEvent*) {
    // Keys go to the view under the mouse, but never away from a field that is being typed in.
    const QWidget* focus = window()->focusWidget();
    if (!focus || qobject_cast<const ViewWidget*>(focus)) setFocus(Qt::MouseFocusReason);
}

void ViewWidget::resizeEvent(QResizeEvent*) {
    refresh();
}

void ViewWidget::showEvent(QShowEvent*) {
    refresh();
}

}  // namespace pellucid::app
