// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/preintegration.h"

#include <algorithm>
#include <cmath>

#include "scene/parallel.h"

namespace pellucid::renderer {

namespace {

constexpr int kFinePerEntry = 8;  // sub-segments of the shortest pair
constexpr int kMostSubsegments = 64;
constexpr int kLayers = 8;

bool is8Bit(VoxelType type) {
    return type == VoxelType::Int8 || type == VoxelType::UInt8;
}

RunningIntegrals::Value operator-(const RunningIntegrals::Value& a, const RunningIntegrals::Value& b) {
    return {a.emission - b.emission, a.extinction - b.extinction};
}

/// tau * c and tau at a place of the piece between two points.
RunningIntegrals::Value integrand(const TransferPoint& a, const TransferPoint& b, double f) {
    const double extinction = a.extinction + f * (b.extinction - a.extinction);
    return {extinction * (a.color + f * (b.color - a.color)), extinction};
}

/// Integral over the first part `f` of the piece; Simpson's rule is exact for the quadratic.
RunningIntegrals::Value integralOfPiece(const TransferPoint& a, const TransferPoint& b, double f) {
    const auto front = integrand(a, b, 0.0), middle = integrand(a, b, 0.5 * f), back = integrand(a, b, f);
    const double sixth = f * (b.value - a.value) / 6.0;
    return {sixth * (front.emission + 4.0 * middle.emission + back.emission),
            sixth * (front.extinction + 4.0 * middle.extinction + back.extinction)};
}

/// Colour and mean tau of segments, from integrals at evenly spaced values.
class SegmentTable {
public:
    SegmentTable(const TransferFunction1D& function, const PreintegrationLayout& layout)
        : m_function(function),
          m_layout(layout),
          m_integrals(static_cast<std::size_t>((layout.size - 1) * kFinePerEntry + 1)) {
        const RunningIntegrals running(function);
        for (std::size_t i = 0; i < m_integrals.size(); ++i)
            m_integrals[i] = running.at(valueAt(static_cast<double>(i) / kFinePerEntry));
    }

    [[nodiscard]] glm::vec4 entry(int front, int back, double depthOfLength, TableQuality quality) const {
        if (front == back || !(m_layout.hi > m_layout.lo)) return diagonal(front);
        const int cells = kFinePerEntry * std::abs(back - front);
        // Where nothing hides anything, the parts of a segment add up to the difference of its ends.
        const bool hides = quality == TableQuality::Exact && depthOfLength > 0.0;
        const int stride = hides ? (cells + kMostSubsegments - 1) / kMostSubsegments : cells;
        return integrate(kFinePerEntry * front, kFinePerEntry * back, stride, depthOfLength);
    }

private:
    [[nodiscard]] double valueAt(double entry) const {
        return m_layout.lo + (m_layout.hi - m_layout.lo) * entry / (m_layout.size - 1);
    }

    [[nodiscard]] glm::vec4 diagonal(int at) const {
        if (at == 0 || at == m_layout.size - 1) {
            const auto optics = evaluate(m_function, valueAt(at));
            return glm::vec4(optics.extinction * optics.color, optics.extinction);
        }
        constexpr int kHalf = kFinePerEntry / 2;
        const auto around = m_integrals[static_cast<std::size_t>(kFinePerEntry * at + kHalf)] -
                            m_integrals[static_cast<std::size_t>(kFinePerEntry * at - kHalf)];
        const double width = valueAt(at + 0.5) - valueAt(at - 0.5);
        return glm::vec4(around.emission / width, around.extinction / width);
    }

    [[nodiscard]] glm::vec4 integrate(int from, int to, int stride, double depthOfLength) const {
        const double extent = valueAt(static_cast<double>(to) / kFinePerEntry) -
                              valueAt(static_cast<double>(from) / kFinePerEntry);
        const int direction = to > from ? 1 : -1;
        glm::dvec3 shown(0.0), emission(0.0);
        double depth = 0.0, through = 1.0, extinction = 0.0;
        for (int at = from; at != to;) {
            const int next = direction > 0 ? std::min(at + stride, to) : std::max(at - stride, to);
            const auto part =
                m_integrals[static_cast<std::size_t>(next)] - m_integrals[static_cast<std::size_t>(at)];
            at = next;
            const double share = std::max(part.extinction / extent, 0.0);  // of the mean tau
            if (share <= 0.0) continue;
            depth += share * depthOfLength;
            const double after = std::exp(-depth);
            shown += (through - after) * (part.emission / part.extinction);
            through = after;
            emission += part.emission / extent;
            extinction += share;
        }
        // Too thin to show in double: the weights are those of the emission.
        const double opacity = 1.0 - through;
        const glm::dvec3 seen = opacity > 1e-12 ? extinction / opacity * shown : emission;
        return glm::vec4(seen, extinction);
    }

    const TransferFunction1D& m_function;
    const PreintegrationLayout& m_layout;
    std::vector<RunningIntegrals::Value> m_integrals;
};

/// Width of the narrowest piece between two points that lies in the table.
double narrowestPiece(const TransferFunction1D& function, const PreintegrationLayout& layout) {
    double narrowest = layout.hi - layout.lo;
    for (std::size_t i = 1; i < function.points.size(); ++i) {
        const double lo = function.points[i - 1].value, hi = function.points[i].value;
        if (hi > lo && hi > layout.lo && lo < layout.hi) narrowest = std::min(narrowest, hi - lo);
    }
    return narrowest;
}

}  // namespace

RunningIntegrals::RunningIntegrals(const TransferFunction1D& function)
    : m_function(function), m_atPoints(function.points.size()) {
    for (std::size_t i = 1; i < m_atPoints.size(); ++i) {
        const auto piece = integralOfPiece(function.points[i - 1], function.points[i], 1.0);
        m_atPoints[i] = {m_atPoints[i - 1].emission + piece.emission,
                         m_atPoints[i - 1].extinction + piece.extinction};
    }
}

RunningIntegrals::Value RunningIntegrals::at(double value) const {
    const auto& points = m_function.points;
    const auto beyond = [&](const TransferPoint& end, const Value& integral) {
        const double way = value - end.value;
        return Value{integral.emission + way * end.extinction * end.color,
                     integral.extinction + way * end.extinction};
    };
    if (value <= points.front().value) return beyond(points.front(), m_atPoints.front());
    if (value >= points.back().value) return beyond(points.back(), m_atPoints.back());
    const auto above = std::upper_bound(points.begin(), points.end(), value,
                                        [](double v, const TransferPoint& p) { return v < p.value; });
    const auto i = static_cast<std::size_t>(above - points.begin());
    const double f = (value - points[i - 1].value) / (points[i].value - points[i - 1].value);
    const auto piece = integralOfPiece(points[i - 1], points[i], f);
    return {m_atPoints[i - 1].emission + piece.emission, m_atPoints[i - 1].extinction + piece.extinction};
}

PreintegrationLayout layoutPreintegration(const Scene& scene, const Plan& plan, const VolumeFacts& facts) {
    PreintegrationLayout layout{plan.table.lo, plan.table.hi, is8Bit(facts.type) ? 256 : 512, 2,
                                plan.longestStepMm / *scene.unitLengthMm * scene.densityScale};
    if (plan.features.integrator == Integrator::Preintegrated3D ||
        plan.features.integrator == Integrator::Importance) {
        layout.size = 256;
        layout.layers = kLayers;
    } else if (narrowestPiece(*scene.volumes.front().transferFunction, layout) * (layout.size - 1) <
               4.0 * (layout.hi - layout.lo)) {
        layout.size *= 2;
    }
    if (!(layout.hi > layout.lo)) layout.size = 2;
    return layout;
}

std::vector<glm::vec4> preintegrate(const TransferFunction1D& function, const PreintegrationLayout& layout,
                                    TableQuality quality) {
    const SegmentTable segments(function, layout);
    const auto size = static_cast<std::size_t>(layout.size);
    std::vector<glm::vec4> table(size * size * static_cast<std::size_t>(layout.layers));
    const auto fillRow = [&](std::size_t row) {
        const auto back = static_cast<int>(row % size);
        const double layer = static_cast<double>(row / size) / (layout.layers - 1);
        for (int front = 0; front < layout.size; ++front)
            table[row * size + static_cast<std::size_t>(front)] =
                segments.entry(front, back, layer * layer * layout.depthOfStep, quality);
    };
    forEachChunk(size * static_cast<std::size_t>(layout.layers), 8,
                 [&](std::uint64_t begin, std::uint64_t end) {
                     for (std::uint64_t row = begin; row < end; ++row) fillRow(row);
                 });
    return table;
}

std::vector<glm::vec4> tabulateIntegrals(const TransferFunction1D& function, double lo, double hi, int size) {
    const RunningIntegrals running(function);
    const auto first = running.at(lo);
    const double entryLength = hi > lo ? (hi - lo) / (size - 1) : 1.0;
    std::vector<glm::vec4> table(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) {
        const auto sum = running.at(lo + (hi - lo) * i / (size - 1)) - first;
        table[static_cast<std::size_t>(i)] = glm::vec4(glm::vec3(sum.emission / entryLength),
                                                       static_cast<float>(sum.extinction / entryLength));
    }
    return table;
}

int integralTableSize(VoxelType type) {
    return is8Bit(type) ? 1024 : 4096;
}

}  // namespace pellucid::renderer
