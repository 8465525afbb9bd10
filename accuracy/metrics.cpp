// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pellucid::accuracy {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One channel of a picture in double, row by row.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values;
};

Plane lumaOf(const ImageF& image) {
    Plane plane{image.size.x, image.size.y, {}};
    plane.values.reserve(image.pixels.size());
    for (const glm::vec4& p : image.pixels)
        plane.values.push_back(0.2126 * static_cast<double>(p.r) + 0.7152 * static_cast<double>(p.g) +
                               0.0722 * static_cast<double>(p.b));
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane result{a.width, a.height, a.values};
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

/// Normalised Gaussian of sigma 1.5 and 11 taps; fewer where the picture is smaller than the window.
std::vector<double> gaussianTaps(int extent) {
    constexpr int kTaps = 11;
    constexpr double kSigma = 1.5;
    std::vector<double> taps(static_cast<std::size_t>(std::min(kTaps, extent)));
    const double middle = (static_cast<double>(taps.size()) - 1.0) / 2.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        const double x = static_cast<double>(i) - middle;
        taps[i] = std::exp(-x * x / (2.0 * kSigma * kSigma));
        sum += taps[i];
    }
    for (double& tap : taps) tap /= sum;
    return taps;
}

/// Windowed mean, only where the window lies inside the picture (as Wang's own implementation does).
Plane windowedMean(const Plane& plane) {
    const std::vector<double> tapsX = gaussianTaps(plane.width);
    const std::vector<double> tapsY = gaussianTaps(plane.height);
    Plane rows{plane.width - static_cast<int>(tapsX.size()) + 1, plane.height, {}};
    rows.values.resize(static_cast<std::size_t>(rows.width) * rows.height);
    for (int y = 0; y < rows.height; ++y) {
        for (int x = 0; x < rows.width; ++x) {
            double sum = 0.0;
            for (std::size_t k = 0; k < tapsX.size(); ++k)
                sum += tapsX[k] * plane.values[static_cast<std::size_t>(y) * plane.width + x + k];
            rows.values[static_cast<std::size_t>(y) * rows.width + x] = sum;
        }
    }
    Plane result{rows.width, plane.height - static_cast<int>(tapsY.size()) + 1, {}};
    result.values.resize(static_cast<std::size_t>(result.width) * result.height);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            double sum = 0.0;
            for (std::size_t k = 0; k < tapsY.size(); ++k)
                sum += tapsY[k] * rows.values[(static_cast<std::size_t>(y) + k) * rows.width + x];
            result.values[static_cast<std::size_t>(y) * result.width + x] = sum;
        }
    }
    return result;
}

/// Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural
/// similarity", IEEE TIP 13(4), 2004, eq. 13 with K1 = 0.01, K2 = 0.03, L = 1; the mean over all windows.
double meanSsim(const ImageF& a, const ImageF& b) {
    constexpr double kC1 = 0.01 * 0.01;
    constexpr double kC2 = 0.03 * 0.03;
    const Plane lumaA = lumaOf(a);
    const Plane lumaB = lumaOf(b);
    const Plane meanA = windowedMean(lumaA);
    const Plane meanB = windowedMean(lumaB);
    const Plane meanAA = windowedMean(product(lumaA, lumaA));
    const Plane meanBB = windowedMean(product(lumaB, lumaB));
    const Plane meanAB = windowedMean(product(lumaA, lumaB));
    double sum = 0.0;
    for (std::size_t i = 0; i < meanA.values.size(); ++i) {
        const double muA = meanA.values[i];
        const double muB = meanB.values[i];
        const double varianceA = meanAA.values[i] - muA * muA;
        const double varianceB = meanBB.values[i] - muB * muB;
        const double covariance = meanAB.values[i] - muA * muB;
        sum += (2.0 * muA * muB + kC1) * (2.0 * covariance + kC2) /
               ((muA * muA + muB * muB + kC1) * (varianceA + varianceB + kC2));
    }
    return sum / static_cast<double>(meanA.values.size());
}

bool hasNaN(const glm::vec4& p) {
    return std::isnan(p.r) || std::isnan(p.g) || std::isnan(p.b) || std::isnan(p.a);
}

}  // namespace

Result<ImageDifference> difference(const ImageF& a, const ImageF& b) {
    if (a.size != b.size)
        return fail(ErrorCode::Inconsistent,
                    fmt::format("pictures of different size: {} x {} against {} x {} pixels", a.size.x,
                                a.size.y, b.size.x, b.size.y));
    ImageDifference result;
    result.psnr = std::numeric_limits<double>::infinity();
    if (a.pixels.empty()) return result;

    double sum = 0.0;
    double sumOfSquares = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::ivec2 pixel(static_cast<int>(i % a.size.x), static_cast<int>(i / a.size.x));
        if (hasNaN(a.pixels[i]) || hasNaN(b.pixels[i]))
            return ImageDifference{kNaN, pixel, kNaN, kNaN, kNaN, kNaN};
        for (int channel = 0; channel < 3; ++channel) {
            const double error = std::abs(static_cast<double>(a.pixels[i][channel]) -
                                          static_cast<double>(b.pixels[i][channel]));
            sum += error;
            sumOfSquares += error * error;
            if (error > result.maxError) {
                result.maxError = error;
                result.worstPixel = pixel;
            }
        }
    }
    const double count = 3.0 * static_cast<double>(a.pixels.size());
    result.meanError = sum / count;
    result.rmse = std::sqrt(sumOfSquares / count);
    if (result.rmse > 0.0) result.psnr = -20.0 * std::log10(result.rmse);
    result.ssim = meanSsim(a, b);
    return result;
}

}  // namespace pellucid::accuracy
