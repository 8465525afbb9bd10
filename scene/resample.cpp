// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/resample.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstring>
#include <memory>
#include <numbers>

#include "scene/parallel.h"

namespace pellucid {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// The transition of a sinc in a Hann window of half-width w reaches 1 / w to both sides of 0.5 cycles a
/// sample. 6 is the least that leaves 0.05 at 0.6, which would come back as 0.4; 8 leaves 0.004 there and
/// 0.996 at 0.4, ripples by 0.006 beside the transition and by 4e-4 at 0.2.
constexpr double kSincHalfWidth = 8.0;
/// 0.65 of a spacing passes exp(-2 pi^2 0.65^2 0.6^2) = 0.0498 at 0.6 cycles a sample, which would come back
/// as 0.4.
constexpr double kGaussianDeviation = 0.65;
constexpr double kGaussianHalfWidth = 4.0;  // 6 deviations: 1e-9 lies beyond
constexpr std::uint64_t kMaxBytes = 16ull << 30;

/// In place, unscaled: X[k] = sum x[m] exp(sign 2 pi i k m / n), n a power of two (Cooley and Tukey 1965).
void transform(std::vector<Complex>& x, double sign) {
    const std::size_t n = x.size();
    for (std::size_t i = 1, j = 0; i < n; ++i) {
        std::size_t bit = n >> 1;
        for (; (j & bit) != 0; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(x[i], x[j]);
    }
    for (std::size_t length = 2; length <= n; length *= 2) {
        const std::size_t half = length / 2;
        for (std::size_t k = 0; k < half; ++k) {
            const Complex turn =
                std::polar(1.0, sign * 2.0 * pi * static_cast<double>(k) / static_cast<double>(length));
            for (std::size_t start = k; start < n; start += length) {
                const Complex odd = x[start + half] * turn;
                x[start + half] = x[start] - odd;
                x[start] += odd;
            }
        }
    }
}

/// What makes a new line of samples from an old one.
class LineResampler {
public:
    virtual ~LineResampler() = default;
    /// Writes newSize samples. Thread-safe.
    virtual std::vector<double> resample(std::span<const double> line) const = 0;
};

double kernel(ResampleMethod method, double x) {
    if (method == ResampleMethod::Gaussian)
        return std::exp(-0.5 * x * x / (kGaussianDeviation * kGaussianDeviation));
    const auto sinc = [](double t) { return std::abs(t) < 1e-8 ? 1.0 : std::sin(pi * t) / (pi * t); };
    if (std::abs(x) >= kSincHalfWidth) return 0.0;
    // Hann: away from the transition its ripples fall off faster than those of a sinc window.
    return sinc(x) * (0.5 + 0.5 * std::cos(pi * x / kSincHalfWidth));
}

/// Convolution in the order of distribution (Engel et al. 2006, section 9.2.5): one pass a tap adds that
/// tap's product to every new sample, so a kernel of any width is the same short loop.
class KernelLines : public LineResampler {
public:
    KernelLines(ResampleMethod method, double factor, int newSize)
        : m_first(static_cast<std::size_t>(newSize)) {
        const double stretch = std::max(1.0, 1.0 / factor);
        const double reach =
            stretch * (method == ResampleMethod::Gaussian ? kGaussianHalfWidth : kSincHalfWidth);
        const auto taps = static_cast<std::size_t>(2.0 * std::ceil(reach)) + 1;
        m_weights.assign(taps, std::vector<double>(m_first.size()));
        for (std::size_t m = 0; m < m_first.size(); ++m) {
            const double position = static_cast<double>(m) / factor;
            m_first[m] = static_cast<int>(std::floor(position) - std::ceil(reach));
            double sum = 0.0;
            for (std::size_t tap = 0; tap < taps; ++tap)
                sum += m_weights[tap][m] =
                    kernel(method, (position - m_first[m] - static_cast<double>(tap)) / stretch);
            for (auto& weights : m_weights) weights[m] /= sum;
        }
    }

    std::vector<double> resample(std::span<const double> line) const override {
        std::vector<double> result(m_first.size(), 0.0);
        const int last = static_cast<int>(line.size()) - 1;
        for (std::size_t tap = 0; tap < m_weights.size(); ++tap)
            for (std::size_t m = 0; m < result.size(); ++m)
                result[m] +=
                    m_weights[tap][m] *
                    line[static_cast<std::size_t>(std::clamp(m_first[m] + static_cast<int>(tap), 0, last))];
        return result;
    }

private:
    std::vector<int> m_first;                    ///< Old voxel of tap 0, by new sample.
    std::vector<std::vector<double>> m_weights;  ///< By tap, then by new sample; sums over taps are 1.
};

/// New samples between the old ones are the old ones shifted by parts of a voxel: what zero-padding the
/// spectrum gives.
class FourierLines : public LineResampler {
public:
    FourierLines(int factor, int newSize) : m_factor(factor), m_newSize(newSize) {}

    std::vector<double> resample(std::span<const double> line) const override {
        // Mirrored, so that the period has no jump; the last sample is repeated up to a power of two.
        const std::size_t half = std::bit_ceil(line.size() + 1);
        std::vector<double> mirrored(2 * half);
        for (std::size_t m = 0; m < half; ++m)
            mirrored[m] = mirrored[2 * half - 1 - m] = line[std::min(m, line.size() - 1)];
        std::vector<double> result(static_cast<std::size_t>(m_newSize));
        const auto step = static_cast<std::size_t>(m_factor);
        for (std::size_t part = 0; part < step; ++part) {
            const std::vector<double> shifted =
                part == 0 ? mirrored
                          : fourierShifted(mirrored, static_cast<double>(part) / static_cast<double>(step));
            for (std::size_t m = 0; m * step + part < result.size(); ++m)
                result[m * step + part] = shifted[m];
        }
        return result;
    }

private:
    int m_factor;
    int m_newSize;
};

/// As a number that may be beyond an int's range until check() has seen it.
double exactNewSize(int size, double factor) {
    return std::floor((size - 1) * factor + 1e-9) + 1.0;
}

int newSize(int size, double factor) {
    return static_cast<int>(exactNewSize(size, factor));
}

std::unique_ptr<LineResampler> linesFor(const ResampleOptions& options, int size) {
    if (options.method == ResampleMethod::Fourier)
        return std::make_unique<FourierLines>(static_cast<int>(options.factor),
                                              newSize(size, options.factor));
    return std::make_unique<KernelLines>(options.method, options.factor, newSize(size, options.factor));
}

/// Values of one component, i fastest.
struct Samples {
    glm::ivec3 size;
    std::vector<float> values;
};

/// False when it was cancelled.
bool resampleAxis(Samples& samples, int axis, const ResampleOptions& options) {
    const auto lines = linesFor(options, samples.size[axis]);
    Samples result{samples.size, {}};
    result.size[axis] = newSize(samples.size[axis], options.factor);
    std::size_t stride = 1;
    for (int lower = 0; lower < axis; ++lower) stride *= static_cast<std::size_t>(samples.size[lower]);
    const auto before = static_cast<std::size_t>(samples.size[axis]);
    const auto after = static_cast<std::size_t>(result.size[axis]);
    const std::size_t count = samples.values.size() / before;
    result.values.resize(count * after);
    const auto work = [&](std::uint64_t begin, std::uint64_t end) {
        std::vector<double> line(before);
        for (std::size_t n = begin; n < end; ++n) {
            const std::size_t outer = n / stride;
            const std::size_t inner = n % stride;
            for (std::size_t i = 0; i < before; ++i)
                line[i] = static_cast<double>(samples.values[(outer * before + i) * stride + inner]);
            const std::vector<double> made = lines->resample(line);
            for (std::size_t i = 0; i < after; ++i)
                result.values[(outer * after + i) * stride + inner] = static_cast<float>(made[i]);
        }
    };
    if (!forEachChunk(count, 64, work, options.progress, "resampling")) return false;
    samples = std::move(result);
    return true;
}

Result<void> check(const Volume& volume, const ResampleOptions& options) {
    const double factor = options.factor;
    if (!(factor >= 1.0 / 64.0 && factor <= 64.0))
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("the factor is {:g}; 1/64 to 64 is allowed", factor));
    if (options.method == ResampleMethod::Fourier &&
        !(factor >= 2.0 && factor <= 8.0 && factor == std::floor(factor)))
        return fail(
            ErrorCode::InvalidArgument,
            fmt::format("the factor is {:g}; the Fourier method takes whole factors from 2 to 8", factor));
    double bytes = 4.0 * volume.components();
    for (int axis = 0; axis < 3; ++axis) bytes *= exactNewSize(volume.grid().size[axis], factor);
    if (bytes > static_cast<double>(kMaxBytes))
        return fail(ErrorCode::TooLarge,
                    fmt::format("the resampled volume would take {:.1f} GB; the limit is {} GB",
                                bytes / (1 << 30), kMaxBytes >> 30));
    return {};
}

}  // namespace

std::vector<double> fourierShifted(std::span<const double> periodic, double shift) {
    const std::size_t n = periodic.size();
    PELLUCID_CHECK(n >= 2 && std::has_single_bit(n));
    std::vector<Complex> spectrum(periodic.begin(), periodic.end());
    transform(spectrum, -1.0);
    for (std::size_t k = 1; k < n / 2; ++k) {
        const Complex turn =
            std::polar(1.0, 2.0 * pi * static_cast<double>(k) * shift / static_cast<double>(n));
        spectrum[k] *= turn;
        spectrum[n - k] *= std::conj(turn);
    }
    spectrum[n / 2] *= std::cos(pi * shift);
    transform(spectrum, 1.0);
    std::vector<double> result(n);
    for (std::size_t m = 0; m < n; ++m) result[m] = spectrum[m].real() / static_cast<double>(n);
    return result;
}

Result<VolumePtr> resampled(const Volume& volume, const ResampleOptions& options) {
    if (auto allowed = check(volume, options); !allowed) return tl::unexpected(allowed.error());
    const auto components = static_cast<std::size_t>(volume.components());
    Grid grid = volume.grid();
    for (int axis = 0; axis < 3; ++axis) {
        grid.size[axis] = newSize(grid.size[axis], options.factor);
        grid.patientFromIndex[axis] /= options.factor;
    }
    std::vector<std::byte> voxels;
    for (std::size_t component = 0; component < components; ++component) {
        Samples samples{volume.grid().size, physicalValues<float>(volume, static_cast<int>(component))};
        for (int axis = 0; axis < 3; ++axis)
            if (!resampleAxis(samples, axis, options))
                return fail(ErrorCode::Cancelled, "the resampling was cancelled");
        voxels.resize(samples.values.size() * components * sizeof(float));
        for (std::size_t n = 0; n < samples.values.size(); ++n)
            std::memcpy(&voxels[(n * components + component) * sizeof(float)], &samples.values[n],
                        sizeof(float));
    }
    return Volume::make(grid, VoxelType::Float32, volume.components(), std::move(voxels),
                        {1.0, 0.0, volume.mapping().unit}, volume.info());
}

}  // namespace pellucid
