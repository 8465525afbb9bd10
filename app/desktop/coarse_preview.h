// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QWidget>

#include "app/desktop/render_service.h"

namespace pellucid::app {

/// The whole as it will look by default, of its coarse copy: voxels are further apart, the optical density of
/// a mm is that of the whole.
[[nodiscard]] Scene sceneOfCoarse(const VolumePtr& coarse);

/// A picture of a coarse copy of what is being opened, over the views, until the first picture of the whole
/// is there. It belongs to no document: whatever becomes of the opening, what was shown before is untouched.
class CoarsePreview : public QWidget {
    Q_OBJECT

public:
    CoarsePreview(RenderService& service, QWidget* parent);

    /// Has it drawn as the volume will look by default; appears over `place` with the picture.
    void begin(const VolumePtr& coarse, const QRect& place);
    void end();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void take(const RenderService::Reply& reply);

    RenderService& m_service;
    QImage m_picture;
    std::uint64_t m_asked = 0;  ///< 0: nothing is wanted.
};

}  // namespace pellucid::app
