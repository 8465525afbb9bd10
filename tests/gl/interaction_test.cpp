// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/interaction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "renderer/resize.h"

namespace pellucid::renderer {
namespace {

constexpr double kPixels = 1024.0 * 768.0;

/// A device on which a picture takes `perRay` + `perSample` / step times for each ray, in ms of a million.
struct Device {
    double perRay = 0.0;
    double perSample = 0.0;
    double otherMs = 0.0;

    double drawMs(const Passing& passing) const {
        const double rays = kPixels / (passing.reduction * passing.reduction);
        return rays * (perRay + perSample / passing.stepTimes) * 1e-6;
    }
    double frameMs(const Passing& passing) const { return drawMs(passing) + otherMs; }

    /// Draws a picture as the control says; returns how.
    Passing draw(InteractionControl& control) const {
        const Passing passing = control.next(kPixels);
        control.took(passing, kPixels / (passing.reduction * passing.reduction), drawMs(passing), otherMs);
        return passing;
    }
};

/// Where fewer rays cost `rays` for each pixel lost and longer steps `steps` for each step lost.
PassingErrors errorsOf(double rays, double steps) {
    PassingErrors errors;
    for (std::size_t i = 0; i < kReductions.size(); ++i)
        errors.byReduction[i] = rays * (kReductions[i] - 1.0);
    errors.byStep.emplace();
    for (std::size_t i = 0; i < kStepTimes.size(); ++i) (*errors.byStep)[i] = steps * (kStepTimes[i] - 1.0);
    return errors;
}

TEST(InteractionControl, ComesToTheTimeInAFewPicturesOnAnyDevice) {
    // From a GPU that draws the full picture in a frame to a CPU that takes 8 s for it.
    for (const double perSample : {10.0, 100.0, 1000.0, 10000.0}) {
        for (const double perRay : {0.0, 5.0, 50.0}) {
            const Device device{perRay, perSample, 4.0};
            for (const double target : {30.0, 100.0}) {
                InteractionControl control(target);
                for (int i = 0; i < 6; ++i) device.draw(control);
                const Passing settled = control.next(kPixels);
                EXPECT_LE(device.frameMs(settled), 1.1 * target) << perSample << " " << perRay;
                // The levels are at most 4/9 apart in cost, and the least wrong need not be the dearest;
                // nothing idle but where all is drawn.
                if (settled.reduction > 1.0) {
                    EXPECT_GE(device.frameMs(settled), 0.3 * target);
                }
                EXPECT_EQ(control.next(kPixels), settled) << "the sharpness flickers";
            }
        }
    }
}

TEST(InteractionControl, AFastDeviceDrawsTheStillPicture) {
    InteractionControl control(30.0);
    const Device device{1.0, 10.0, 2.0};
    for (int i = 0; i < 4; ++i) device.draw(control);
    EXPECT_EQ(control.next(kPixels), Passing{});
}

TEST(InteractionControl, TakesWhatIsLeastWrongOfWhatFits) {
    const Device device{0.0, 800.0, 4.0};
    for (const auto& errors : {errorsOf(0.01, 0.0001), errorsOf(0.0001, 0.01), errorsOf(0.01, 0.01)}) {
        InteractionControl control(100.0);
        control.learned(errors);
        for (int i = 0; i < 6; ++i) device.draw(control);
        const Passing settled = control.next(kPixels);
        // By brute force, with the control's leave to stay with what is up to a quarter worse.
        double best = 1e9;
        for (const double reduction : kReductions)
            for (const double stepTimes : kStepTimes)
                if (device.frameMs({reduction, stepTimes}) <= 100.0)
                    best = std::min(best, control.error({reduction, stepTimes}).value());
        EXPECT_LE(control.error(settled).value(), best / 0.8);
    }
}

TEST(InteractionControl, AHiccupIsForgotten) {
    InteractionControl control(100.0);
    const Device device{0.0, 500.0, 4.0};
    for (int i = 0; i < 6; ++i) device.draw(control);
    const Passing before = control.next(kPixels);
    // An upload between pictures says nothing about the next one, a slow drawing is believed at once.
    control.took(before, 1.0, 1.0 * device.drawMs(before) / kPixels * before.reduction * before.reduction,
                 2000.0);
    EXPECT_EQ(control.next(kPixels), before);
    control.took(before, kPixels / (before.reduction * before.reduction), 4.0 * device.drawMs(before), 4.0);
    EXPECT_GT(control.next(kPixels).reduction * control.next(kPixels).stepTimes,
              before.reduction * before.stepTimes);
    for (int i = 0; i < 6; ++i) device.draw(control);
    EXPECT_LE(control.next(kPixels).reduction, before.reduction * 1.25);
}

TEST(InteractionControl, AllElseThatAPictureTakesCounts) {
    InteractionControl control(100.0);
    const Device quick{0.0, 500.0, 5.0}, slow{0.0, 500.0, 60.0};
    for (int i = 0; i < 6; ++i) quick.draw(control);
    for (int i = 0; i < 6; ++i) slow.draw(control);
    EXPECT_LE(slow.frameMs(control.next(kPixels)), 110.0);
    // What cannot be met is not a reason to draw nothing.
    const Device hopeless{0.0, 500.0, 400.0};
    for (int i = 0; i < 6; ++i) hopeless.draw(control);
    EXPECT_LT(control.next(kPixels).reduction, kReductions.back());
}

TEST(InteractionControl, StatesAnErrorOnlyOnceItIsKnown) {
    InteractionControl control(100.0);
    EXPECT_FALSE(control.error({2.0, 1.0}));
    PassingErrors errors = errorsOf(0.01, 0.02);
    const auto byStep = errors.byStep;
    errors.byStep.reset();
    control.learned(errors);
    EXPECT_FALSE(control.error({2.0, 2.0}));
    errors.byStep = byStep;
    control.learned(errors);
    EXPECT_DOUBLE_EQ(control.error({2.0, 2.0}).value(), std::hypot(0.01, 0.02));
    EXPECT_EQ(control.error({}), 0.0);
    // A refinement that left out the long steps does not unlearn them.
    errors.byStep.reset();
    control.learned(errors);
    EXPECT_TRUE(control.error({2.0, 2.0}));
}

TEST(InteractionControl, ARefinementBeginsWithWhatIsBetterThanWhatIsShown) {
    InteractionControl control(100.0);
    EXPECT_EQ(control.refinesFrom({}), 4.0);  // Nothing is known: all are drawn, to learn it.
    control.learned(errorsOf(0.01, 0.02));    // Twice the step is as wrong as half the size.
    EXPECT_EQ(control.refinesFrom({12.0, 1.0}), 4.0);
    EXPECT_EQ(control.refinesFrom({4.0, 1.0}), 2.0);
    EXPECT_EQ(control.refinesFrom({2.0, 1.0}), 1.0);
    EXPECT_EQ(control.refinesFrom({1.0, 2.0}), 1.0);
    EXPECT_EQ(control.refinesFrom({}), 1.0);
}

ImageF pictureOf(glm::ivec2 size, const std::function<glm::vec4(glm::vec2)>& at) {
    ImageF image{size, {}};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image.pixels.push_back(at((glm::vec2(x, y) + 0.5f) / glm::vec2(size)));
    return image;
}

TEST(Resize, TheSameSizeAndConstantsStayBitForBit) {
    const auto noise = pictureOf({37, 23}, [](glm::vec2 p) {
        return glm::vec4(std::sin(91.0f * p.x), std::cos(77.0f * p.y), p.x * p.y, 1.0f);
    });
    EXPECT_EQ(resized(noise, noise.size), noise);
    const glm::vec4 color(0.1f, 0.7f, 1.0f / 3.0f, 1.0f);
    const auto constant = pictureOf({40, 30}, [&](glm::vec2) { return color; });
    for (const glm::ivec2 size : {glm::ivec2{41, 31}, {400, 300}, {7, 5}, {1, 1}})
        for (const glm::vec4& pixel : resized(constant, size).pixels) EXPECT_EQ(pixel, color);
}

TEST(Resize, AParabolaIsKeptWhereNothingIsLimited) {
    // Catmull-Rom reproduces polynomials of degree 2, and a monotonous one lies between its neighbours. The
    // two pixels at each border see the repeated one. Rounding of values below 4.
    const auto f = [](glm::vec2 p) { return glm::vec4((1.0f + p.x) * (1.0f + p.x) * (1.0f + p.y), 0, 0, 1); };
    const ImageF large = resized(pictureOf({40, 30}, f), {120, 150}), exact = pictureOf({120, 150}, f);
    for (int y = 10; y < 140; ++y)
        for (int x = 6; x < 114; ++x) EXPECT_NEAR(large.at(x, y).r, exact.at(x, y).r, 4e-6);
}

TEST(Resize, AnEdgeGetsNoHaloAndTheMeanStays) {
    const auto edge = [](glm::vec2 p) { return glm::vec4(p.x + 0.3f * p.y < 0.6f ? 0.2f : 0.8f); };
    const ImageF small = pictureOf({100, 80}, edge), large = resized(small, {333, 211});
    double mean[2] = {0.0, 0.0};
    for (const glm::vec4& pixel : large.pixels) {
        EXPECT_GE(pixel.r, 0.2f);
        EXPECT_LE(pixel.r, 0.8f);
        mean[1] += static_cast<double>(pixel.r) / static_cast<double>(large.pixels.size());
    }
    for (const glm::vec4& pixel : small.pixels)
        mean[0] += static_cast<double>(pixel.r) / static_cast<double>(small.pixels.size());
    EXPECT_NEAR(mean[0], mean[1], 0.2 / 255.0);
}

TEST(Resize, TheErrorOfFewerRaysIsWhatDrawingThemShows) {
    // A picture that can be drawn at any size: rings down to 7 pixels, and a soft edge.
    const auto draw = [](glm::ivec2 size) {
        return pictureOf(size, [](glm::vec2 p) {
            const float r = glm::length((p - 0.5f) * glm::vec2(4.0f / 3.0f, 1.0f));
            return glm::vec4((0.5f + 0.4f * std::cos(400.0f * r * r)) /
                             (1.0f + std::exp(200.0f * (r - 0.4f))));
        });
    };
    const ImageF still = draw({512, 384});
    const auto stated = reductionErrors(still);
    EXPECT_EQ(stated.front(), 0.0);
    for (std::size_t i = 1; i < kReductions.size(); ++i) {
        const ImageF shown = resized(draw(reducedSize(still.size, kReductions[i])), still.size);
        double sum = 0.0;
        for (std::size_t j = 0; j < shown.pixels.size(); ++j) {
            const double apart = static_cast<double>(shown.pixels[j].r - still.pixels[j].r);
            sum += apart * apart / static_cast<double>(shown.pixels.size());
        }
        // Every eighth row of some hundred; and where the small picture has its pixels the still one is
        // interpolated, which for the narrowest rings (7 pixels) is a quarter off.
        EXPECT_NEAR(stated[i] / std::sqrt(sum), 1.0, 0.3) << kReductions[i];
    }
}

}  // namespace
}  // namespace pellucid::renderer
