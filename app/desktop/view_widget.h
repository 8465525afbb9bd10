// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QString>
#include <QWidget>
#include <glm/vec2.hpp>
#include <optional>

#include "app/desktop/document.h"
#include "app/desktop/render_service.h"

namespace pellucid::app {

/// A picture from the render service with text painted over it. What the two kinds of view share: asking for
/// pictures, showing replies, the edge letters, and the bookkeeping of a mouse drag.
class ViewWidget : public QWidget {
    Q_OBJECT

public:
    ViewWidget(int channel, Document& document, RenderService& service, QWidget* parent = nullptr);

    /// The scene that the view shows at its size. Precondition: the document is not empty.
    [[nodiscard]] virtual Scene shownScene() const = 0;
    /// The way the picture is placed in its view when the view is reset.
    virtual void resetView() = 0;

    /// Device pixels: what is rendered.
    [[nodiscard]] glm::ivec2 pixelSize() const;
    /// The newest picture, null before the first.
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    [[nodiscard]] const std::optional<RenderService::Reply>& lastReply() const { return m_lastReply; }
    [[nodiscard]] EdgeLetters letters() const;
    [[nodiscard]] bool showsOverlay() const { return m_showsOverlay; }
    void setShowsOverlay(bool shows);
    /// True when the newest request has been answered: the picture shown is that of the scene.
    [[nodiscard]] bool isSettled() const { return m_answered == m_asked; }

Q_SIGNALS:
    void pictureShown(const pellucid::app::RenderService::Reply& reply);
    /// What is under the cursor; empty when nothing is.
    void probed(const QString& text);
    void maximiseAsked();

protected:
    enum class Drag { None, Primary, Pan, Zoom, Roll, Crosshair };
    /// Which drag a press begins; the same for both kinds of view but for the primary one.
    [[nodiscard]] static Drag dragOf(const QMouseEvent& event, Drag withControl);
    [[nodiscard]] Drag drag() const { return m_drag; }
    [[nodiscard]] QPointF pressedAt() const { return m_pressedAt; }

    /// Requests what the view is to show; the channel and the volumes are filled in.
    void ask(RenderService::Request request);
    /// Asks for a picture if the scene to show differs from the one asked for last.
    virtual void refresh() = 0;
    /// Paints over the picture, in logical pixels.
    virtual void paintOverlay(QPainter& painter) = 0;
    virtual void beginDrag(const QMouseEvent& event) = 0;
    virtual void continueDrag(QPointF position) = 0;
    virtual Drag dragFor(const QMouseEvent& event) const = 0;
    virtual void received(const RenderService::Reply& reply);

    Document& document() const { return m_document; }

    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    void take(const RenderService::Reply& reply);
    void paintLetters(QPainter& painter) const;

    int m_channel;
    Document& m_document;
    RenderService& m_service;
    QImage m_picture;
    std::optional<RenderService::Reply> m_lastReply;
    std::uint64_t m_asked = 0;
    std::uint64_t m_answered = 0;
    QString m_error;
    bool m_showsOverlay = true;
    Drag m_drag = Drag::None;
    Qt::MouseButton m_dragButton = Qt::NoButton;
    QPointF m_pressedAt;
};

}  // namespace pellucid::app
