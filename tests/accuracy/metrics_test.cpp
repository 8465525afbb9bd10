// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pellucid::accuracy {
namespace {

ImageF filled(glm::ivec2 size, float value) {
    return {size, std::vector<glm::vec4>(static_cast<std::size_t>(size.x) * size.y, glm::vec4(value))};
}

ImageF pattern(glm::ivec2 size, double phase) {
    ImageF image = filled(size, 0.0F);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image.at(x, y) =
                glm::vec4(static_cast<float>(0.5 + 0.4 * std::sin(0.7 * x + phase) * std::cos(0.4 * y)));
    return image;
}

/// Wang 2004, eq. 13, window by window with the 11 x 11 weights written out in two dimensions.
double ssimByDefinition(const ImageF& a, const ImageF& b) {
    double total = 0.0;
    int windows = 0;
    for (int y = 0; y + 11 <= a.size.y; ++y) {
        for (int x = 0; x + 11 <= a.size.x; ++x, ++windows) {
            double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
            for (int j = -5; j <= 5; ++j) {
                for (int i = -5; i <= 5; ++i) {
                    const double w = std::exp(-(i * i + j * j) / 4.5);
                    const auto va = static_cast<double>(a.at(x + 5 + i, y + 5 + j).r);
                    const auto vb = static_cast<double>(b.at(x + 5 + i, y + 5 + j).r);
                    weights += w, ma += w * va, mb += w * vb, aa += w * va * va, bb += w * vb * vb,
                        ab += w * va * vb;
                }
            }
            ma /= weights, mb /= weights, aa /= weights, bb /= weights, ab /= weights;
            total += (2 * ma * mb + 1e-4) * (2 * (ab - ma * mb) + 9e-4) /
                     ((ma * ma + mb * mb + 1e-4) * (aa - ma * ma + bb - mb * mb + 9e-4));
        }
    }
    return total / windows;
}

TEST(Metrics, EqualPicturesHaveNoError) {
    const ImageF image = pattern({17, 13}, 0.0);
    const auto d = difference(image, image);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->maxError, 0.0);
    EXPECT_EQ(d->rmse, 0.0);
    EXPECT_TRUE(std::isinf(d->psnr));
    EXPECT_DOUBLE_EQ(d->ssim, 1.0);
}

TEST(Metrics, OnePixelOneChannelHasTheFiguresOfTheirDefinition) {
    const ImageF a = filled({4, 3}, 0.25F);
    ImageF b = a;
    b.at(2, 1).g = 0.75F;
    const auto d = difference(a, b);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->maxError, 0.5);
    EXPECT_EQ(d->worstPixel, glm::ivec2(2, 1));
    EXPECT_DOUBLE_EQ(d->meanError, 0.5 / 36.0);
    EXPECT_DOUBLE_EQ(d->rmse, std::sqrt(0.25 / 36.0));
    EXPECT_NEAR(d->psnr, 10.0 * std::log10(144.0), 1e-12);
}

TEST(Metrics, AlphaIsNotCompared) {
    const ImageF a = filled({12, 12}, 0.5F);
    ImageF b = a;
    b.at(1, 1).a = 0.0F;
    EXPECT_EQ(difference(a, b)->maxError, 0.0);
}

TEST(Metrics, SsimOfTwoGreysIsTheLuminanceTerm) {
    const auto d = difference(filled({20, 20}, 0.25F), filled({20, 20}, 0.75F));
    EXPECT_NEAR(d->ssim, (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-12);
}

TEST(Metrics, SsimFollowsWangsDefinition) {
    const ImageF a = pattern({23, 19}, 0.0);
    const ImageF b = pattern({23, 19}, 0.9);
    const auto d = difference(a, b);
    // Luma of an equal-channel pixel is the channel up to the rounding of its three weights.
    EXPECT_NEAR(d->ssim, ssimByDefinition(a, b), 1e-9);
    EXPECT_LT(d->ssim, 0.95);
}

TEST(Metrics, SsimOfANegativeIsNegative) {
    const ImageF a = pattern({23, 19}, 0.0);
    ImageF b = a;
    for (glm::vec4& p : b.pixels) p = 1.0F - p;
    EXPECT_LT(difference(a, b)->ssim, -0.5);
}

TEST(Metrics, PicturesSmallerThanTheWindowHaveSsim) {
    EXPECT_NEAR(difference(pattern({3, 2}, 0.0), pattern({3, 2}, 0.0))->ssim, 1.0, 1e-12);
    EXPECT_NEAR(difference(filled({1, 1}, 0.25F), filled({1, 1}, 0.75F))->ssim, 0.3751 / 0.6251, 1e-9);
}

TEST(Metrics, NaNMakesEveryFigureNaN) {
    const ImageF a = filled({12, 12}, 0.5F);
    for (int channel = 0; channel < 4; ++channel) {
        ImageF b = a;
        b.at(3, 7)[channel] = std::numeric_limits<float>::quiet_NaN();
        for (const auto& d : {difference(a, b), difference(b, a), difference(b, b)}) {
            ASSERT_TRUE(d);
            EXPECT_TRUE(std::isnan(d->maxError) && std::isnan(d->meanError) && std::isnan(d->rmse) &&
                        std::isnan(d->psnr) && std::isnan(d->ssim));
            EXPECT_EQ(d->worstPixel, glm::ivec2(3, 7));
        }
    }
}

TEST(Metrics, SizesThatDifferAreNamed) {
    const auto d = difference(filled({4, 3}, 0.0F), filled({5, 3}, 0.0F));
    ASSERT_FALSE(d);
    EXPECT_EQ(d.error().code, ErrorCode::Inconsistent);
    EXPECT_NE(d.error().message.find("4 x 3"), std::string::npos);
    EXPECT_NE(d.error().message.find("5 x 3"), std::string::npos);
}

}  // namespace
}  // namespace pellucid::accuracy
