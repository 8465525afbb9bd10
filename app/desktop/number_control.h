// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

namespace pellucid::app {

/// A slider and a field for one number. Edits by the user are signalled, values set by the program are not.
/// The slider and the field are children named "slider" and "field".
class NumberControl : public QWidget {
    Q_OBJECT

public:
    NumberControl(double lo, double hi, int decimals, QWidget* parent = nullptr);

    /// Range of the slider; the field accepts the same.
    void setRange(double lo, double hi, int decimals);
    void setValue(double value);
    void setSuffix(const QString& suffix);
    /// Equal ways of the slider multiply the value by the same. Precondition: the range is above 0.
    void setLogarithmic();
    [[nodiscard]] double value() const;

Q_SIGNALS:
    /// While the slider moves and for each value that is typed.
    void edited(double value);
    /// The hand has left the slider, or a typed value is final.
    void editEnded();

private:
    void showOnSlider(double value);
    [[nodiscard]] double valueAt(double fraction) const;
    [[nodiscard]] double fractionOf(double value) const;

    QSlider* m_slider;
    QDoubleSpinBox* m_field;
    double m_lo = 0.0;
    double m_hi = 1.0;
    bool m_isLogarithmic = false;
};

}  // namespace pellucid::app
