// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/number_control.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <cmath>

namespace pellucid::app {

namespace {
constexpr int kSliderSteps = 1000;
}

NumberControl::NumberControl(double lo, double hi, int decimals, QWidget* parent)
    : QWidget(parent), m_slider(new QSlider(Qt::Horizontal, this)), m_field(new QDoubleSpinBox(this)) {
    m_slider->setObjectName(QStringLiteral("slider"));
    m_slider->setRange(0, kSliderSteps);
    m_field->setObjectName(QStringLiteral("field"));
    m_field->setKeyboardTracking(false);
    m_field->setFixedWidth(96);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_slider, 1);
    layout->addWidget(m_field);
    setRange(lo, hi, decimals);

    connect(m_slider, &QSlider::valueChanged, this, [this](int step) {
        const double value = valueAt(static_cast<double>(step) / kSliderSteps);
        {
            const QSignalBlocker quiet(m_field);
            m_field->setValue(value);
        }
        Q_EMIT edited(m_field->value());
        if (!m_slider->isSliderDown()) Q_EMIT editEnded();
    });
    connect(m_slider, &QSlider::sliderReleased, this, &NumberControl::editEnded);
    connect(m_field, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        showOnSlider(value);
        Q_EMIT edited(value);
        Q_EMIT editEnded();
    });
}

void NumberControl::setRange(double lo, double hi, int decimals) {
    const QSignalBlocker quietField(m_field);
    const double before = value();
    m_lo = lo;
    m_hi = hi;
    m_field->setDecimals(decimals);
    m_field->setRange(lo, hi);
    m_field->setSingleStep(std::max(std::pow(10.0, -decimals), (hi - lo) / 100.0));
    setValue(before);
}

void NumberControl::setValue(double value) {
    const QSignalBlocker quietField(m_field);
    m_field->setValue(value);
    showOnSlider(value);
}

void NumberControl::setSuffix(const QString& suffix) {
    m_field->setSuffix(suffix);
}

void NumberControl::setLogarithmic() {
    m_isLogarithmic = true;
    m_field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    showOnSlider(value());
}

double NumberControl::valueAt(double fraction) const {
    return m_isLogarithmic ? m_lo * std::pow(m_hi / m_lo, fraction) : m_lo + (m_hi - m_lo) * fraction;
}

double NumberControl::fractionOf(double value) const {
    if (m_hi <= m_lo) return 0.0;
    return m_isLogarithmic ? std::log(value / m_lo) / std::log(m_hi / m_lo) : (value - m_lo) / (m_hi - m_lo);
}

double NumberControl::value() const {
    return m_field->value();
}

void NumberControl::showOnSlider(double value) {
    const QSignalBlocker quiet(m_slider);
    const double fraction = fractionOf(value);
    // While the hand holds the slider it knows better than the rounded value.
    if (!m_slider->isSliderDown()) m_slider->setValue(static_cast<int>(std::lround(fraction * kSliderSteps)));
}

}  // namespace pellucid::app
