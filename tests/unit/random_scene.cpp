// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/random_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pellucid::test {

namespace {

class Maker {
public:
    explicit Maker(std::mt19937_64& random) : m_random(random) {}

    bool coin() { return m_random() & 1u; }
    int integer(int lo, int hi) { return std::uniform_int_distribution<>(lo, hi)(m_random); }

    /// Any finite double.
    double finite() {
        static const double kSpecial[] = {0.0,
                                          -0.0,
                                          0.1,
                                          1.0 / 3.0,
                                          std::numeric_limits<double>::denorm_min(),
                                          -std::numeric_limits<double>::denorm_min(),
                                          std::numeric_limits<double>::min(),
                                          std::nextafter(std::numeric_limits<double>::min(), 0.0),
                                          std::numeric_limits<double>::max(),
                                          std::numeric_limits<double>::lowest(),
                                          9007199254740993.0,
                                          1e22,
                                          1e23,
                                          5e-324,
                                          -1024.0};
        switch (integer(0, 3)) {
            case 0:
                return kSpecial[static_cast<std::size_t>(
                    integer(0, static_cast<int>(std::size(kSpecial)) - 1))];
            case 1:
                return std::uniform_real_distribution<>(-2000.0, 2000.0)(m_random);
            case 2:
                return integer(-2000, 2000);
            default:
                break;
        }
        for (;;) {
            const auto value = std::bit_cast<double>(m_random());
            if (std::isfinite(value)) return value;
        }
    }
    double notNegative() {
        for (;;) {
            const double value = finite();
            if (value >= 0.0) return value;  // -0.0 passes.
        }
    }
    double positive() {
        for (;;) {
            const double value = std::abs(finite());
            if (value > 0.0) return value;
        }
    }
    /// As large as what is computed in floats may be.
    double notNegativeFloat() {
        for (;;) {
            const double value = notNegative();
            if (value <= 1e30) return value;
        }
    }
    double positiveFloat() {
        for (;;) {
            const double value = positive();
            if (value <= 1e30) return value;
        }
    }
    /// In [0, 1], often a whole byte.
    double unit() {
        if (coin()) return integer(0, 255) / 255.0;
        for (;;) {
            const double value = finite();
            if (value >= 0.0 && value <= 1.0) return value;
            if (coin()) return std::uniform_real_distribution<>(0.0, 1.0)(m_random);
        }
    }
    glm::dvec3 color() { return {unit(), unit(), unit()}; }
    glm::dvec3 vector() { return {finite(), finite(), finite()}; }

    std::string text() {
        static const char* const kParts[] = {"head",
                                             "\"",
                                             "\\",
                                             "/",
                                             "~",
                                             "\n",
                                             "\t",
                                             "\x01",
                                             " ",
                                             "\xC3\xA9",
                                             "\xE2\x82\xAC",
                                             "\xF0\x9F\xA7\xA0",
                                             "\x7F",
                                             "{",
                                             "0"};
        std::string result;
        for (int i = integer(0, 6); i > 0; --i)
            result += kParts[static_cast<std::size_t>(integer(0, static_cast<int>(std::size(kParts)) - 1))];
        return result;
    }
    template <class E>
    E anyOf() {
        const auto names = enumNames<E>();
        return names[static_cast<std::size_t>(integer(0, static_cast<int>(names.size()) - 1))].value;
    }

    TransferFunction1D function() {
        TransferFunction1D result;
        result.name = text();
        result.unit = text();
        result.points.resize(static_cast<std::size_t>(integer(1, 6)));
        std::vector<double> values;
        for (std::size_t i = 0; i < result.points.size(); ++i)
            values.push_back(i > 0 && coin() ? values[0] : finite());
        std::sort(values.begin(), values.end());
        for (std::size_t i = 0; i < values.size(); ++i)
            result.points[i] = {values[i], color(), notNegativeFloat()};
        return result;
    }
    VolumeItem item() {
        VolumeItem result;
        result.name = text();
        result.source = text();
        result.component = integer(0, 3);
        result.filter = anyOf<Filter>();
        if (coin()) result.transferFunction = function();
        if (coin()) result.window = Window{finite(), positive()};
        if (coin()) result.isovalue = finite();
        result.classification = anyOf<Classification>();
        for (int i = coin() ? integer(0, 3) : 0; i > 0; --i)
            result.isosurfaces.push_back(
                {finite(), color(), std::max(unit(), std::numeric_limits<double>::denorm_min())});
        return result;
    }
    Light light() {
        Light result;
        result.kind = anyOf<LightKind>();
        if (coin()) result.color = {notNegativeFloat(), notNegativeFloat(), notNegativeFloat()};
        if (coin()) result.color = color();
        if (coin()) result.intensity = notNegativeFloat();
        if (coin()) result.positionMm = vector();
        if (coin()) result.directionMm = vector();
        if (result.directionMm == glm::dvec3(0.0)) result.directionMm.z = -1.0;
        return result;
    }
    Camera camera() {
        Camera result;
        result.projection = anyOf<Projection>();
        if (coin()) result.fovDeg = std::clamp(positive(), 5e-324, std::nextafter(180.0, 0.0));
        result.view = anyOf<AnatomicalView>();
        if (coin()) result.zoom = positive();
        if (coin()) result.nearMm = notNegative();
        while (coin()) {
            result.pose = CameraPose{vector(), vector(), coin() ? vector() : glm::dvec3(0, 0, 1), positive()};
            if (validate(result)) break;
            result.pose.reset();
        }
        return result;
    }

private:
    std::mt19937_64& m_random;
};

}  // namespace

Scene randomScene(std::mt19937_64& random) {
    Maker make(random);
    Scene scene;
    for (int i = make.integer(0, 3); i > 0; --i) scene.volumes.push_back(make.item());
    if (make.coin()) scene.lights.emplace();
    for (int i = make.integer(0, 3); scene.lights && i > 0; --i) scene.lights->push_back(make.light());
    if (make.coin())
        scene.material = {make.notNegativeFloat(), make.notNegativeFloat(), make.notNegativeFloat(),
                          std::min(make.positive(), 1e4)};
    if (make.coin()) scene.camera = make.camera();
    scene.mode = make.anyOf<Mode>();
    if (make.coin()) scene.hitOpacity = std::max(make.unit(), 1e-9);
    scene.xray = make.anyOf<XRayDisplay>();
    scene.space = make.anyOf<CompositingSpace>();
    if (make.coin()) scene.unitLengthMm = std::max(make.positiveFloat(), 1e-30);
    if (make.coin()) scene.densityScale = make.notNegativeFloat();
    if (make.coin()) scene.quality.stepVoxels = make.positiveFloat();
    if (make.coin()) scene.quality.stepMm = make.positiveFloat();
    if (make.coin()) scene.quality.earlyTermination = std::min(make.unit(), std::nextafter(1.0, 0.0));
    scene.quality.integrator = make.anyOf<Integrator>();
    scene.quality.accumulation = make.anyOf<Accumulation>();
    scene.quality.jitter = make.coin();
    if (make.coin()) scene.quality.toleranceGreyLevels = make.positive();
    scene.quality.toleranceNorm = make.anyOf<ErrorNorm>();
    scene.quality.automatic = make.coin();
    scene.quality.dither = make.coin();
    scene.quality.skipEmpty = make.coin();
    if (make.coin()) scene.quality.interpolationGreyLevels = make.positive();
    scene.quality.gradients = make.anyOf<Gradients>();
    if (make.coin()) scene.picture.size = {make.integer(1, 16384), make.integer(1, 16384)};
    if (make.coin()) scene.picture.background = make.color();
    scene.picture.transparent = make.coin();
    return scene;
}

}  // namespace pellucid::test
