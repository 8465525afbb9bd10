// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/ray_integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "accuracy/root.h"
#include "scene/image.h"

namespace pellucid::accuracy {
namespace {

/// Three-stage Gauss-Legendre collocation (Hairer, Norsett, Wanner, "Solving Ordinary Differential Equations
/// I", table II.7.4): nodes and weights of the quadrature, and the weights of the integrals from 0 to each
/// node.
constexpr double kRoot15 = 3.872983346207417;
constexpr std::array<double, 3> kNodes{0.5 - kRoot15 / 10.0, 0.5, 0.5 + kRoot15 / 10.0};
constexpr std::array<double, 3> kWeights{5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
constexpr std::array<std::array<double, 3>, 3> kUpToNode{{
    {5.0 / 36.0, 2.0 / 9.0 - kRoot15 / 15.0, 5.0 / 36.0 - kRoot15 / 30.0},
    {5.0 / 36.0 + kRoot15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - kRoot15 / 24.0},
    {5.0 / 36.0 + kRoot15 / 30.0, 2.0 / 9.0 + kRoot15 / 15.0, 5.0 / 36.0},
}};

constexpr double kDeepestPiece =
    0.25;  ///< Optical depth: (1/4)^7 / 7! leaves an order-6 error below 1e-8 a piece.
constexpr double kShadeError =
    3e-7;  ///< Of a piece, in display units; pieces with a jump add up to some 1e-6 a ray.
constexpr double kNothingSeen = 50.0;  ///< Behind this optical depth exp(-50) = 2e-22 of the light passes.
constexpr int kMaxHalvings = 60;       ///< Beyond the 53 bits of a double.

glm::dvec3 displayed(const glm::dvec3& color, CompositingSpace space) {
    if (space == CompositingSpace::Display) return color;
    return {displayFromLinear(color.r), displayFromLinear(color.g), displayFromLinear(color.b)};
}

/// How far the parabola through the colours at the three nodes misses the colours at the two ends.
double bend(const std::array<glm::dvec3, 3>& nodes, const glm::dvec3& from, const glm::dvec3& to) {
    constexpr double kFar = (5.0 - kRoot15) / 6.0;  // Lagrange's polynomials of the nodes, at 0.
    constexpr double kMiddle = -2.0 / 3.0;
    constexpr double kNear = (5.0 + kRoot15) / 6.0;
    const glm::dvec3 missed =
        glm::max(glm::abs(kNear * nodes[0] + kMiddle * nodes[1] + kFar * nodes[2] - from),
                 glm::abs(kFar * nodes[0] + kMiddle * nodes[1] + kNear * nodes[2] - to));
    return std::max({missed.r, missed.g, missed.b});
}

}  // namespace

RayIntegrator::RayIntegrator(const Scene& scene, const Volume& volume, double insetVoxels)
    : m_scene(scene),
      m_field(volume, scene.volumes.front().component, scene.volumes.front().filter),
      m_optics(*scene.volumes.front().transferFunction, scene.space, *scene.unitLengthMm, scene.densityScale),
      m_frame(rayFrame(scene.camera, volume.grid(), scene.picture.size)),
      m_inset(insetVoxels),
      m_centreMm(centreMm(volume.grid())),
      m_indexFromPatient(glm::inverse(glm::dmat3(volume.grid().patientFromIndex))),
      m_gradientFromIndex(glm::transpose(m_indexFromPatient)),
      m_background(scene.picture.background),
      m_lit(usesLights(scene.mode) && !scene.lights->empty()) {
    const bool linear = scene.space == CompositingSpace::Linear;
    if (linear) m_background = linearFromDisplay(m_background);
    if (scene.volumes.front().classification == Classification::Pre && scene.mode != Mode::FirstHit &&
        scene.mode != Mode::Isosurface)
        m_preClassified = preClassified();
    m_surfaces = scene.volumes.front().isosurfaces;
    std::stable_sort(m_surfaces.begin(), m_surfaces.end(),
                     [](const SurfaceLayer& a, const SurfaceLayer& b) { return a.value < b.value; });
    if (linear)
        for (SurfaceLayer& surface : m_surfaces) surface.color = linearFromDisplay(surface.color);
    const ValueRange range = volume.physicalRange(scene.volumes.front().component);
    // The second term: rounding of a filter's weights on a constant field.
    m_vanishingGradient =
        1e-6 * (range.hi - range.lo) + 1e-14 * std::max(std::abs(range.lo), std::abs(range.hi));
}

RayIntegrator::Ray RayIntegrator::rayAt(double u, double v) const {
    Ray ray;
    const glm::dvec3 across = u * m_frame.right + v * m_frame.up;
    ray.originMm = m_frame.eye - m_centreMm;
    if (m_frame.projection == Projection::Orthographic) {
        ray.originMm += across;
        ray.direction = m_frame.forward;
    } else {
        ray.direction = glm::normalize(m_frame.forward + across);
    }
    const double forwardPerMm = glm::dot(ray.direction, m_frame.forward);
    ray.startMm = m_frame.nearMm / forwardPerMm;
    ray.sliceMm = m_frame.targetDistanceMm / forwardPerMm;
    // Relative to the centre, so that a scan far from the origin loses no digits.
    ray.index.origin = m_indexFromPatient * ray.originMm + (glm::dvec3(m_field.size()) - 1.0) / 2.0;
    ray.index.perMm = m_indexFromPatient * ray.direction;
    ray.inside = insideBox(ray.index, m_field.size(), ray.startMm, m_inset);
    return ray;
}

RayIntegrator::PreClassified RayIntegrator::preClassified() const {
    std::array<std::vector<double>, 4> fields;
    for (const double value : m_field.voxels()) {
        const int piece = m_optics.pieceOf(value);
        const double extinction = m_optics.extinctionPerMm(piece, value);
        const glm::dvec3 emission = extinction * m_optics.color(piece, value);
        for (std::size_t channel = 0; channel < 3; ++channel)
            fields[channel].push_back(emission[static_cast<int>(channel)]);
        fields[3].push_back(extinction);
    }
    const auto field = [&](std::size_t i) {
        return Field(m_field.size(), m_scene.volumes.front().filter, std::move(fields[i]));
    };
    return {field(0), field(1), field(2), field(3)};
}

RayIntegrator::LocalOptics RayIntegrator::opticsAt(const Ray& ray, const Piece& piece, double t) const {
    if (!m_preClassified) {
        const double value = valueAt(ray, piece.cell, t);
        return {m_optics.color(piece.optics, value), m_optics.extinctionPerMm(piece.optics, value)};
    }
    const glm::dvec3 index = ray.index.at(t);
    const auto at = [&](const Field& field) { return field.value(piece.cell, index); };
    const double extinction = at(m_preClassified->extinction);
    if (!(extinction > 0.0)) return {};
    return {glm::dvec3(at(m_preClassified->red), at(m_preClassified->green), at(m_preClassified->blue)) /
                extinction,
            extinction};
}

double RayIntegrator::valueAt(const Ray& ray, glm::ivec3 cell, double t) const {
    return m_field.value(cell, ray.index.at(t));
}

glm::dvec3 RayIntegrator::shaded(const Ray& ray, glm::ivec3 cell, double t, glm::dvec3 color) const {
    if (!m_lit) return color;
    const glm::dvec3 perIndex = m_field.centralDifference(cell, ray.index.at(t));
    if (!(glm::length(perIndex) > m_vanishingGradient)) return color;
    const glm::dvec3 gradient = m_gradientFromIndex * perIndex;

    const glm::dvec3 toViewer = -ray.direction;
    glm::dvec3 normal = -glm::normalize(gradient);
    if (glm::dot(normal, toViewer) < 0.0) normal = -normal;
    const Material& material = m_scene.material;
    glm::dvec3 result = material.ambient * color;
    for (const Light& light : *m_scene.lights) {
        glm::dvec3 toLight = -m_frame.forward;
        if (light.kind == LightKind::Directional) toLight = -glm::normalize(light.directionMm);
        if (light.kind == LightKind::Point)
            toLight = glm::normalize(light.positionMm - m_centreMm - ray.originMm - t * ray.direction);
        const glm::dvec3 between = toLight + toViewer;
        const double halfLength = glm::length(between);
        const double cosHalf = halfLength > 0.0 ? std::max(glm::dot(normal, between) / halfLength, 0.0) : 0.0;
        const double cosLight = std::max(glm::dot(normal, toLight), 0.0);
        result +=
            light.intensity * light.color *
            (material.diffuse * cosLight * color + material.specular * std::pow(cosHalf, material.shininess));
    }
    return result;
}

template <class Visit>
bool RayIntegrator::splitAtPoints(const Ray& ray, const Segment& segment, double valueFrom, double valueTo,
                                  const Visit& visit) const {
    const int point = m_optics.pointBetween(valueFrom, valueTo);
    if (point >= 0) {
        const double level = m_optics.pointValue(point);
        const double t = rootBetween(segment.from, segment.to,
                                     [&](double s) { return valueAt(ray, segment.cell, s) - level; });
        if (!splitAtPoints(ray, {segment.cell, segment.from, t}, valueFrom, level, visit)) return false;
        return splitAtPoints(ray, {segment.cell, t, segment.to}, level, valueTo, visit);
    }
    if (!(segment.from < segment.to)) return true;
    const double middle = valueAt(ray, segment.cell, (segment.from + segment.to) / 2.0);
    return visit(Piece{segment.cell, m_optics.pieceOf(middle), segment.from, segment.to});
}

template <class Visit>
void RayIntegrator::walkPieces(const Ray& ray, const Interval& range, double stepMm,
                               const Visit& visit) const {
    walkCells(m_field, ray.index, range, stepMm, [&](const Segment& segment) {
        // Interpolated colours are smooth within a cell.
        if (m_preClassified) return visit(Piece{segment.cell, 0, segment.from, segment.to});
        return splitAtPoints(ray, segment, valueAt(ray, segment.cell, segment.from),
                             valueAt(ray, segment.cell, segment.to), visit);
    });
}

void RayIntegrator::addPiece(const Ray& ray, const Piece& piece, int depth, RayIntegral& sum) const {
    const double length = piece.to - piece.from;
    std::array<LocalOptics, 3> local{};
    std::array<double, 3> extinction{};
    double total = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        local[i] = opticsAt(ray, piece, piece.from + kNodes[i] * length);
        extinction[i] = local[i].extinction;
        total += kWeights[i] * extinction[i] * length;
    }
    if (total <= 0.0 || sum.opticalDepth > kNothingSeen) {
        sum.opticalDepth += total;
        return;
    }
    const auto halve = [&] {
        const double middle = piece.from + length / 2.0;
        addPiece(ray, {piece.cell, piece.optics, piece.from, middle}, depth + 1, sum);
        addPiece(ray, {piece.cell, piece.optics, middle, piece.to}, depth + 1, sum);
    };
    if (total > kDeepestPiece && depth < kMaxHalvings) return halve();

    std::array<glm::dvec3, 3> colors{};
    glm::dvec3 weighted(0.0);
    double weights = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        double depthToNode = 0.0;
        for (std::size_t j = 0; j < 3; ++j) depthToNode += kUpToNode[i][j] * extinction[j] * length;
        const double weight = kWeights[i] * extinction[i] * std::exp(-depthToNode);
        colors[i] = shaded(ray, piece.cell, piece.from + kNodes[i] * length, local[i].color);
        weighted += weight * colors[i];
        weights += weight;
    }
    // A normal that turns to the viewer makes the shade jump; it is closed in on, or the order would drop
    // to 1.
    if (m_lit && depth < kMaxHalvings) {
        const auto shadeAt = [&](double t) {
            return shaded(ray, piece.cell, t, opticsAt(ray, piece, t).color);
        };
        const double shown = total * std::exp(-sum.opticalDepth);
        if (bend(colors, shadeAt(piece.from), shadeAt(piece.to)) * shown > kShadeError) return halve();
    }

    // The mean colour times the exact opacity: a constant colour then comes out exactly, whatever the
    // extinction.
    sum.color += weighted / weights * -std::expm1(-total) * std::exp(-sum.opticalDepth);
    sum.opticalDepth += total;
}

RayIntegral RayIntegrator::integrate(const Ray& ray, const Interval& range, double stepMm) const {
    RayIntegral sum;
    walkPieces(ray, range, stepMm, [&](const Piece& piece) {
        addPiece(ray, piece, 0, sum);
        return true;
    });
    return sum;
}

RayIntegral RayIntegrator::glow(const Ray& ray, double stepMm) const {
    RayIntegral sum;
    if (!ray.inside) return sum;
    walkPieces(ray, *ray.inside, stepMm, [&](const Piece& piece) {
        const double length = piece.to - piece.from;
        for (std::size_t i = 0; i < 3; ++i) {
            const LocalOptics local = opticsAt(ray, piece, piece.from + kNodes[i] * length);
            const double depth = kWeights[i] * length * local.extinction;
            sum.color += depth * local.color;
            sum.opticalDepth += depth;
        }
        return true;
    });
    return sum;
}

/// The largest sign * value on the ray. Precondition: the ray meets the volume.
double RayIntegrator::extremum(const Ray& ray, double stepMm, double sign) const {
    double best = -std::numeric_limits<double>::infinity();
    walkCells(m_field, ray.index, *ray.inside, stepMm, [&](const Segment& segment) {
        const auto at = [&](double t) { return sign * valueAt(ray, segment.cell, t); };
        constexpr int kParts = 4;
        std::array<double, kParts + 1> t{};
        std::array<double, kParts + 1> values{};
        std::size_t highest = 0;
        for (std::size_t i = 0; i <= kParts; ++i) {
            t[i] = segment.from + (segment.to - segment.from) * static_cast<double>(i) / kParts;
            values[i] = at(t[i]);
            if (values[i] > values[highest]) highest = i;
        }
        const double rise =
            *std::max_element(values.begin(), values.end()) - *std::min_element(values.begin(), values.end());
        best = std::max(best, values[highest]);
        if (rise > 0.0 && values[highest] + rise > best)
            best = std::max(best, maximumBetween(t[highest == 0 ? 0 : highest - 1],
                                                 t[std::min<std::size_t>(highest + 1, kParts)], at));
        return true;
    });
    return sign * best;
}

double RayIntegrator::average(const Ray& ray, double stepMm) const {
    double sum = 0.0;
    walkCells(m_field, ray.index, *ray.inside, stepMm, [&](const Segment& segment) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = segment.to - segment.from;
            sum += kWeights[i] * length * valueAt(ray, segment.cell, segment.from + kNodes[i] * length);
        }
        return true;
    });
    return sum / (ray.inside->to - ray.inside->from);
}

std::optional<glm::dvec3> RayIntegrator::firstHit(const Ray& ray, double stepMm) const {
    const double threshold = extinctionFromOpacity(m_scene.hitOpacity) / *m_scene.unitLengthMm;
    std::optional<glm::dvec3> hit;
    if (!ray.inside) return hit;
    walkPieces(ray, *ray.inside, stepMm, [&](const Piece& piece) {
        const auto t = firstReached(piece.from, piece.to, [&](double s) {
            return m_optics.extinctionPerMm(piece.optics, valueAt(ray, piece.cell, s)) - threshold;
        });
        if (t) hit = shaded(ray, piece.cell, *t, m_optics.color(piece.optics, valueAt(ray, piece.cell, *t)));
        return !t;
    });
    return hit;
}

std::optional<glm::dvec3> RayIntegrator::isosurface(const Ray& ray, double stepMm) const {
    const double isovalue = *m_scene.volumes.front().isovalue;
    std::optional<glm::dvec3> hit;
    if (!ray.inside) return hit;
    walkCells(m_field, ray.index, *ray.inside, stepMm, [&](const Segment& segment) {
        const auto t = firstReached(segment.from, segment.to,
                                    [&](double s) { return valueAt(ray, segment.cell, s) - isovalue; });
        if (t) hit = shaded(ray, segment.cell, *t, m_optics.color(m_optics.pieceOf(isovalue), isovalue));
        return !t;
    });
    return hit;
}

glm::dvec4 RayIntegrator::isosurfaces(const Ray& ray, double stepMm) const {
    glm::dvec3 color(0.0);
    double transmittance = 1.0;
    if (!ray.inside) return glm::dvec4(0.0);
    const auto levelOf = [&](double value) {
        return std::count_if(m_surfaces.begin(), m_surfaces.end(),
                             [&](const SurfaceLayer& surface) { return value >= surface.value; });
    };
    const auto valueOf = [&](const Segment& part, double t) { return valueAt(ray, part.cell, t); };
    auto level = levelOf(valueAt(ray, m_field.cellOf(ray.index.at(ray.inside->from)), ray.inside->from));
    const auto visit = [&](const Segment& part) {
        const auto target = levelOf(valueOf(part, part.to));
        double from = part.from;
        while (level != target) {
            const bool rising = level < target;
            const auto& surface = m_surfaces[static_cast<std::size_t>(rising ? level : level - 1)];
            // A value on the isovalue has reached it, from either side.
            const auto side = [&](double s) { return valueOf(part, s) >= surface.value ? 1.0 : -1.0; };
            // Where two surfaces are one, or the value jumps at the part's beginning, nothing is left to
            // search.
            const double t = side(from) == side(part.to) ? from : rootBetween(from, part.to, side);
            color += transmittance * surface.opacity * shaded(ray, part.cell, t, surface.color);
            transmittance *= 1.0 - surface.opacity;
            level += rising ? 1 : -1;
            from = t;
        }
        return transmittance > 0.0;
    };
    walkCells(m_field, ray.index, *ray.inside, stepMm, [&](const Segment& segment) {
        constexpr int kParts = 4;
        const double length = (segment.to - segment.from) / kParts;
        for (int i = 0; i < kParts; ++i) {
            const double from = segment.from + i * length;
            const double to = i + 1 == kParts ? segment.to : from + length;
            if (!visit(Segment{segment.cell, from, to})) return false;
        }
        return true;
    });
    return {color, 1.0 - transmittance};
}

glm::dvec4 RayIntegrator::blended(const glm::dvec3& color, double transmittance, double alpha) const {
    if (!m_scene.picture.transparent)
        return {displayed(color + transmittance * m_background, m_scene.space), alpha};
    // An associated colour is encoded as the colour it is the association of; a glow has none.
    const double association = alpha > 0.0 ? alpha : 1.0;
    return {association * displayed(color / association, m_scene.space), alpha};
}

glm::dvec4 RayIntegrator::opaque(const std::optional<glm::dvec3>& color) const {
    return color ? blended(*color, 0.0, 1.0) : blended(glm::dvec3(0.0), 1.0, 0.0);
}

/// Grey levels are what is shown, so the compositing space does not change them.
glm::dvec4 RayIntegrator::windowed(const std::optional<double>& value) const {
    if (!value) return blended(glm::dvec3(0.0), 1.0, 0.0);
    const Window& window = *m_scene.volumes.front().window;
    const double grey = std::clamp((*value - (window.level - window.width / 2.0)) / window.width, 0.0, 1.0);
    return {glm::dvec3(grey), 1.0};
}

glm::dvec4 RayIntegrator::pixel(double u, double v, double stepMm) const {
    const Ray ray = rayAt(u, v);
    const auto ifInside = [&](auto&& f) { return ray.inside ? std::optional<double>(f()) : std::nullopt; };
    switch (m_scene.mode) {
        case Mode::Composite: {
            const RayIntegral sum = ray.inside ? integrate(ray, *ray.inside, stepMm) : RayIntegral{};
            return blended(sum.color, std::exp(-sum.opticalDepth), -std::expm1(-sum.opticalDepth));
        }
        case Mode::Emission:
            return blended(glow(ray, stepMm).color, 1.0, 0.0);
        case Mode::XRay: {
            const double depth = glow(ray, stepMm).opticalDepth;
            const bool transmitted = m_scene.xray == XRayDisplay::Transmittance;
            return {glm::dvec3(transmitted ? std::exp(-depth) : -std::expm1(-depth)), 1.0};
        }
        case Mode::Mip:
            return windowed(ifInside([&] { return extremum(ray, stepMm, 1.0); }));
        case Mode::MinIp:
            return windowed(ifInside([&] { return extremum(ray, stepMm, -1.0); }));
        case Mode::Average:
            return windowed(ifInside([&] { return average(ray, stepMm); }));
        case Mode::FirstHit:
            return opaque(firstHit(ray, stepMm));
        case Mode::Isosurface:
            if (!m_surfaces.empty()) {
                const glm::dvec4 seen = isosurfaces(ray, stepMm);
                return blended(glm::dvec3(seen), 1.0 - seen.a, seen.a);
            }
            return opaque(isosurface(ray, stepMm));
        case Mode::Slice:
            break;
    }
    if (!ray.inside || ray.sliceMm < ray.inside->from || ray.sliceMm > ray.inside->to)
        return windowed(std::nullopt);
    return windowed(valueAt(ray, m_field.cellOf(ray.index.at(ray.sliceMm)), ray.sliceMm));
}

}  // namespace pellucid::accuracy
