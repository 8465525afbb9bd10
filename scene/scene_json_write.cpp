// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/scene_json.h"
#include "scene/scene_json_parts.h"

namespace pellucid {

namespace {

using Json = nlohmann::ordered_json;

bool sameBits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool sameBits(glm::dvec3 a, glm::dvec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}

/// Writes the members of one object. Defaults are left out by comparing bits: -0.0 is not the default 0.0.
class ObjectWriter {
public:
    explicit ObjectWriter(bool full) : m_full(full) {}

    void number(const char* member, double value, double ordinary) {
        if (m_full || !sameBits(value, ordinary)) m_json[member] = value;
    }
    void number(const char* member, const std::optional<double>& value) {
        if (value) m_json[member] = *value;
    }
    void vector(const char* member, glm::dvec3 value, glm::dvec3 ordinary) {
        if (m_full || !sameBits(value, ordinary)) put(member, Json{value.x, value.y, value.z});
    }
    /// "#rrggbb" where that reads back bit for bit.
    void color(const char* member, glm::dvec3 value, glm::dvec3 ordinary) {
        if (m_full)
            put(member, Json{value.x, value.y, value.z});
        else if (!sameBits(value, ordinary))
            putColor(member, value);
    }
    void putColor(const char* member, glm::dvec3 value) {
        std::string hex = "#";
        for (int c = 0; c < 3; ++c) {
            // An integer, so that -0.0 does not pass for black.
            const int byte =
                value[c] >= 0.0 && value[c] <= 1.0 ? static_cast<int>(std::lround(value[c] * 255.0)) : -1;
            if (byte < 0 || !sameBits(byte / 255.0, value[c])) {
                put(member, Json{value.x, value.y, value.z});
                return;
            }
            hex += fmt::format("{:02x}", byte);
        }
        put(member, hex);
    }
    template <class T>
    void plain(const char* member, const T& value, const T& ordinary) {
        if (m_full || value != ordinary) m_json[member] = value;
    }
    template <class E>
    void named(const char* member, E value, E ordinary) {
        if (m_full || value != ordinary) m_json[member] = name(value);
    }
    void put(const char* member, Json value) { m_json[member] = std::move(value); }
    /// A part all of whose members are at their defaults is left out itself.
    void part(const char* member, Json value) {
        if (!value.empty()) m_json[member] = std::move(value);
    }
    [[nodiscard]] bool full() const { return m_full; }
    [[nodiscard]] Json take() { return std::move(m_json); }

private:
    bool m_full;
    Json m_json = Json::object();
};

Json write(const TransferPoint& point, bool full) {
    ObjectWriter writer(full);
    writer.put("value", point.value);
    if (full)
        writer.color("color", point.color, {});
    else
        writer.putColor("color", point.color);
    writer.put("extinction", point.extinction);
    return writer.take();
}

Json write(const TransferFunction1D& function, bool full) {
    ObjectWriter writer(full);
    writer.plain("name", function.name, {});
    writer.plain("unit", function.unit, {});
    Json points = Json::array();
    for (const TransferPoint& point : function.points) points.push_back(write(point, full));
    writer.put("points", std::move(points));
    return writer.take();
}

Json write(const SurfaceLayer& surface, bool full) {
    ObjectWriter writer(full);
    const SurfaceLayer ordinary;
    writer.put("value", surface.value);
    writer.color("color", surface.color, ordinary.color);
    writer.number("opacity", surface.opacity, ordinary.opacity);
    return writer.take();
}

Json write(const VolumeItem& item, bool full) {
    ObjectWriter writer(full);
    const VolumeItem ordinary;
    writer.plain("name", item.name, ordinary.name);
    writer.plain("source", item.source, ordinary.source);
    writer.plain("component", item.component, ordinary.component);
    writer.named("filter", item.filter, ordinary.filter);
    writer.named("classification", item.classification, ordinary.classification);
    if (item.transferFunction) writer.put("transferFunction", write(*item.transferFunction, full));
    if (item.window) writer.put("window", Json{{"level", item.window->level}, {"width", item.window->width}});
    writer.number("isovalue", item.isovalue);
    if (full || !item.isosurfaces.empty()) {
        Json surfaces = Json::array();
        for (const SurfaceLayer& surface : item.isosurfaces) surfaces.push_back(write(surface, full));
        writer.put("isosurfaces", std::move(surfaces));
    }
    return writer.take();
}

Json write(const Light& light, bool full) {
    ObjectWriter writer(full);
    const Light ordinary;
    writer.put("kind", name(light.kind));
    writer.color("color", light.color, ordinary.color);
    writer.number("intensity", light.intensity, ordinary.intensity);
    writer.vector("directionMm", light.directionMm, ordinary.directionMm);
    writer.vector("positionMm", light.positionMm, ordinary.positionMm);
    return writer.take();
}

Json write(const Material& material, bool full) {
    ObjectWriter writer(full);
    const Material ordinary;
    writer.number("ambient", material.ambient, ordinary.ambient);
    writer.number("diffuse", material.diffuse, ordinary.diffuse);
    writer.number("specular", material.specular, ordinary.specular);
    writer.number("shininess", material.shininess, ordinary.shininess);
    return writer.take();
}

Json write(const CameraPose& pose, bool full) {
    ObjectWriter writer(full);
    const CameraPose ordinary;
    writer.put("eye", Json{pose.eye.x, pose.eye.y, pose.eye.z});
    writer.put("target", Json{pose.target.x, pose.target.y, pose.target.z});
    writer.vector("up", pose.up, ordinary.up);
    writer.number("heightMm", pose.heightMm, ordinary.heightMm);
    return writer.take();
}

Json write(const Camera& camera, bool full) {
    ObjectWriter writer(full);
    const Camera ordinary;
    writer.named("projection", camera.projection, ordinary.projection);
    writer.number("fovDeg", camera.fovDeg, ordinary.fovDeg);
    writer.named("view", camera.view, ordinary.view);
    writer.number("zoom", camera.zoom, ordinary.zoom);
    writer.number("nearMm", camera.nearMm, ordinary.nearMm);
    if (camera.pose) writer.put("pose", write(*camera.pose, full));
    return writer.take();
}

Json write(const Quality& quality, bool full) {
    ObjectWriter writer(full);
    const Quality ordinary;
    writer.number("stepVoxels", quality.stepVoxels, ordinary.stepVoxels);
    writer.number("stepMm", quality.stepMm);
    writer.number("earlyTermination", quality.earlyTermination, ordinary.earlyTermination);
    writer.named("integrator", quality.integrator, ordinary.integrator);
    writer.named("accumulation", quality.accumulation, ordinary.accumulation);
    writer.plain("jitter", quality.jitter, ordinary.jitter);
    writer.number("toleranceGreyLevels", quality.toleranceGreyLevels);
    writer.named("toleranceNorm", quality.toleranceNorm, ordinary.toleranceNorm);
    // Its default depends on the other members, so it is written wherever it could be in doubt.
    writer.plain("automatic", quality.automatic,
                 quality.automatic || quality.toleranceGreyLevels ? !quality.automatic : ordinary.automatic);
    writer.plain("dither", quality.dither, ordinary.dither);
    writer.plain("skipEmpty", quality.skipEmpty, ordinary.skipEmpty);
    writer.number("interpolationGreyLevels", quality.interpolationGreyLevels);
    writer.named("gradients", quality.gradients, ordinary.gradients);
    return writer.take();
}

Json write(const Picture& picture, bool full) {
    ObjectWriter writer(full);
    const Picture ordinary;
    if (full || picture.size != ordinary.size) writer.put("size", Json{picture.size.x, picture.size.y});
    writer.color("background", picture.background, ordinary.background);
    writer.plain("transparent", picture.transparent, ordinary.transparent);
    return writer.take();
}

template <class T>
Json writeAll(const std::vector<T>& values, bool full) {
    Json list = Json::array();
    for (const T& value : values) list.push_back(write(value, full));
    return list;
}

Json write(const Scene& scene, bool full) {
    ObjectWriter writer(full);
    const Scene ordinary;
    writer.put("pellucid", kSceneVersion);
    if (full || !scene.volumes.empty()) writer.put("volumes", writeAll(scene.volumes, full));
    if (scene.lights) writer.put("lights", writeAll(*scene.lights, full));
    writer.part("material", write(scene.material, full));
    writer.part("camera", write(scene.camera, full));
    writer.named("mode", scene.mode, ordinary.mode);
    writer.number("hitOpacity", scene.hitOpacity, ordinary.hitOpacity);
    writer.named("xray", scene.xray, ordinary.xray);
    writer.named("space", scene.space, ordinary.space);
    writer.number("unitLengthMm", scene.unitLengthMm);
    writer.number("densityScale", scene.densityScale, ordinary.densityScale);
    writer.part("quality", write(scene.quality, full));
    writer.part("picture", write(scene.picture, full));
    return writer.take();
}

std::string leafText(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

constexpr std::size_t kLineBytes = 120;

/// On one line, or as much of it as shows that it does not fit.
std::string oneLine(const Json& json) {
    if (!json.is_structured() || json.empty()) return leafText(json);
    std::string text = json.is_object() ? "{ " : "[";
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        if (!first) text += ", ";
        first = false;
        if (json.is_object()) text += leafText(key) + ": ";
        text += oneLine(value);
        if (text.size() > kLineBytes) return text;
    }
    return text + (json.is_object() ? " }" : "]");
}

/// A person reads this: what fits stays on one line, so that colours, points and vectors do.
void print(const Json& json, std::size_t indent, std::string& text) {
    const std::string line = oneLine(json);
    if (line.size() + indent <= kLineBytes || !json.is_structured()) {
        text += line;
        return;
    }
    text += json.is_object() ? "{\n" : "[\n";
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        if (!first) text += ",\n";
        first = false;
        text.append(indent + 2, ' ');
        if (json.is_object()) text += leafText(key) + ": ";
        print(value, indent + 2, text);
    }
    text += "\n";
    text.append(indent, ' ');
    text += json.is_object() ? "}" : "]";
}

}  // namespace

Json toJson(const Scene& scene) {
    return write(scene, false);
}

Json toFullJson(const Scene& scene) {
    return write(scene, true);
}

std::string sceneText(const Scene& scene) {
    const Json json = toJson(scene);
    std::string text = "{";
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        text += first ? "\n  " : ",\n  ";
        first = false;
        text += leafText(key) + ": ";
        print(value, 2, text);
    }
    return text + "\n}\n";
}

}  // namespace pellucid
