// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/cost_text.h"

#include <QCoreApplication>
#include <QStringList>

#include "renderer/automatic_quality.h"
#include "scene/names.h"

namespace pellucid::app {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("CostText", text);
}

// Two digits for what is small, whole levels above that.
QString greyLevels(double error) {
    const double levels = error * 255.0;
    return levels < 10.0 ? QString::number(levels, 'g', 2) : QString::number(levels, 'f', 0);
}

/// " (asked 1)" or " (asked 1: NOT met)" behind the number that the tolerance is about.
QString askedText(const std::optional<Quality>& chosen, ErrorNorm norm,
                  const renderer::ErrorEstimate& error) {
    if (!chosen || chosen->toleranceNorm != norm) return {};
    const QString asked = QString::number(toleranceGreyLevels(*chosen));
    return (renderer::meetsTolerance(*chosen, error) ? tr(" (asked %1)") : tr(" (asked %1: NOT met)"))
        .arg(asked);
}

QString errorText(const renderer::Frame& frame, bool isFinal) {
    const renderer::ErrorEstimate& error = *frame.error;
    const QString rmse = greyLevels(error.rmse), largest = greyLevels(error.maxError);
    if (!isFinal) return tr("refining; error about %1 grey levels RMS").arg(rmse);
    const bool sawAll = error.probedPixels == frame.image.size.x * frame.image.size.y;
    return tr("error %1 grey levels RMS%2, %3 %4%5")
        .arg(rmse, askedText(frame.chosen, ErrorNorm::Rmse, error), largest,
             sawAll ? tr("at most") : tr("at most where probed"),
             askedText(frame.chosen, ErrorNorm::Max, error));
}

QString passingText(const RenderService::Reply& reply, std::optional<double> error) {
    const renderer::Passing& passing = *reply.passing;
    QStringList parts{passing.reduction == 1.0 ? tr("moving: full size")
                                               : tr("moving: 1/%1 size").arg(passing.reduction)};
    if (passing.stepTimes != 1.0) parts += tr("%1x step").arg(passing.stepTimes);
    parts += tr("%1 ms").arg(reply.totalMs, 0, 'f', 0);
    parts += !error         ? tr("error not measured yet")
             : *error > 0.0 ? tr("about %1 grey levels RMS from the still picture").arg(greyLevels(*error))
                            : tr("the still picture's settings");
    return parts.join(QStringLiteral(", "));
}

QString settingsText(const renderer::Plan& plan, double smallestSpacingMm) {
    const Mode mode = plan.features.mode;
    const QString steps = tr("steps of %1 voxels").arg(plan.stepMm / smallestSpacingMm, 0, 'g', 2);
    if (!usesIntegrator(mode)) return steps;
    return steps + QStringLiteral(", ") + QString::fromLatin1(name(plan.features.integrator));
}

}  // namespace

QString costText(const RenderService::Reply& reply, double smallestSpacingMm,
                 std::optional<double> passingError) {
    const renderer::Frame& frame = *reply.frame;
    const double ms = frame.cost.wallMs;
    QStringList parts{reply.passing ? passingText(reply, passingError)
                                    : tr("%1 x %2, %3 ms")
                                          .arg(frame.image.size.x)
                                          .arg(frame.image.size.y)
                                          .arg(ms, 0, 'f', ms < 10.0 ? 1 : 0)};
    if (frame.error) parts += errorText(frame, reply.isFinal);
    if (!frame.unmet.empty()) parts += tr("tolerance NOT met: %1").arg(QString::fromStdString(frame.unmet));
    if (frame.plan.features.mode != Mode::Slice) parts += settingsText(frame.plan, smallestSpacingMm);
    parts += tr("%1 MB").arg(static_cast<double>(frame.plan.totalBytes) / 1e6, 0, 'f', 1);
    return parts.join(QStringLiteral("   |   "));
}

}  // namespace pellucid::app
