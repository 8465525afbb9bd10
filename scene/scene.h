// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/camera.h"
#include "scene/light.h"
#include "scene/names.h"
#include "scene/transfer_function.h"
#include "scene/volume.h"

namespace pellucid {

inline constexpr int kSceneVersion = 1;

/// Reconstruction filter of the voxel grid.
enum class Filter {
    Nearest,
    Trilinear,
    TricubicBSpline,
    CatmullRom,
    Lanczos3,
    TrilinearExact,         ///< As Trilinear, in float whatever the texture unit's precision.
    TricubicBSplineDeBoor,  ///< As TricubicBSpline, by recursion; for comparison.
    TricubicBSplineLut      ///< As TricubicBSpline, weights from a table; for comparison.
};

/// Whether the transfer function is applied to reconstructed values or to voxels, whose associated colours
/// are interpolated then. The latter cannot show what the function does between two voxels; for comparison.
enum class Classification { Post, Pre };

/// How a ray becomes a pixel.
enum class Mode {
    Composite,   ///< Emission-absorption, front-to-back over (Max 1995).
    Mip,         ///< Maximum of the value, shown through the window.
    MinIp,       ///< Minimum of the value, shown through the window.
    Average,     ///< Mean of the value over the path inside the volume, shown through the window.
    XRay,        ///< Absorption only: see XRayDisplay.
    Emission,    ///< Emission only: background + integral of extinction * colour.
    FirstHit,    ///< Colour of the first point whose extinction reaches hitOpacity, opaque.
    Isosurface,  ///< Opaque surface at the isovalue, refined root; or the volume's isosurfaces.
    Slice  ///< The plane through the camera's target, perpendicular to the view, shown through the window.
};

/// What an X-ray shows, as grey: transmittance exp(-tau) (bone dark), or opacity 1 - exp(-tau) (bone bright).
enum class XRayDisplay { Transmittance, Opacity };

/// The space in which colours are blended. Display: as shown, the field's convention. Linear: light-linear,
/// sRGB-encoded at the end.
enum class CompositingSpace { Display, Linear };

/// How the volume-rendering integral of a segment is approximated (docs/equations.md, 8 to 15). Modes other
/// than Composite and XRay sum midpoints whatever it says.
enum class Integrator {
    Riemann,            ///< Constant segment, self-attenuation of its emission ignored: the historical form.
    Exponential,        ///< Constant segment, exact: order 2.
    Trapezoid,          ///< From both ends: order 2.
    Simpson,            ///< Ends and middle: order 4 where everything is smooth.
    GaussLegendre,      ///< Two inner points: order 4 where everything is smooth.
    Preintegrated2D,    ///< Table over both end values for one segment length.
    Preintegrated3D,    ///< Table over both end values and the length.
    IntegralFunctions,  ///< From running integrals of the transfer function, no table over pairs.
    Adaptive,           ///< IntegralFunctions with steps chosen to meet toleranceGreyLevels.
    Importance  ///< Preintegrated3D with steps as long as the data around allow (toleranceGreyLevels).
};

/// What must stay below a tolerance: the root mean square over pixels and RGB, or the largest error anywhere.
enum class ErrorNorm { Rmse, Max };

/// Precision in which colour and opacity of a ray are accumulated. The lower ones are for comparison: faint
/// media stall.
enum class Accumulation { Float32, Half, EightBit };

/// Where the gradient of a lit sample comes from: six values around it, or a texture of differences made
/// once.
enum class Gradients {
    Auto,  ///< The texture where it is as exact, many samples of a ray are lit and memory allows.
    OnTheFly,
    Texture
};

/// One of several surfaces of equal value.
struct SurfaceLayer {
    double value = 0.0;     ///< Physical value.
    glm::dvec3 color{1.0};  ///< Display-encoded.
    double opacity = 1.0;   ///< Of the surface, in (0, 1].
    bool operator==(const SurfaceLayer&) const = default;
};
inline constexpr std::size_t kMaxSurfaces = 8;

/// One drawn volume. Unset members follow from the data (completed()).
struct VolumeItem {
    std::string name;
    std::string source;  ///< Path, relative to the scene file; may be empty for volumes given in memory.
    int component = 0;
    Filter filter = Filter::Trilinear;
    Classification classification = Classification::Post;  ///< For Composite, XRay and Emission.
    std::optional<TransferFunction1D> transferFunction;
    std::optional<Window> window;    ///< Physical level and width for Mip, MinIp, Average and Slice.
    std::optional<double> isovalue;  ///< Physical value, for Isosurface.
    /// For Isosurface, in place of the isovalue: each is seen through those in front of it. At most
    /// kMaxSurfaces.
    std::vector<SurfaceLayer> isosurfaces;
    bool operator==(const VolumeItem&) const = default;
};

struct Quality {
    double stepVoxels = 0.5;       ///< Ray step in units of the smallest voxel spacing, > 0.
    std::optional<double> stepMm;  ///< When set, the step in mm instead.
    double earlyTermination =
        1.0 / 1024.0;  ///< A ray stops when at most this much light can still pass; the stated bound
                       ///< of the error in display units. 0: never stop. In [0, 1).
    Integrator integrator = Integrator::Exponential;
    Accumulation accumulation = Accumulation::Float32;
    bool jitter = false;  ///< Ray starts are shifted within a step by blue noise, the same in every picture.
    /// The error asked for, in grey levels (1/255 of what is shown), > 0; 1 when unset. The adaptive
    /// integrator keeps every ray below it, automatic the picture; the importance integrator lets values
    /// deviate by half as many 255ths of the data's range.
    std::optional<double> toleranceGreyLevels;
    ErrorNorm toleranceNorm = ErrorNorm::Rmse;  ///< What automatic measures.
    /// Step, integrator and early termination are chosen when drawn: the cheapest that keep the picture's
    /// error below the tolerance. Those stated here are where a plan made without drawing stands.
    bool automatic = false;
    bool dither = false;
    /// Rays pass over blocks of voxels in which nothing can show. The picture is the same without; the switch
    /// is for comparison.
    bool skipEmpty = true;
    /// Rays are traced at every fourth pixel, and in the tiles where interpolating the others would be wrong
    /// by more than this at every second or every one; grey levels in toleranceNorm, > 0. Unset: a ray a
    /// pixel. Pictures below 64 pixels have a ray a pixel in any case.
    std::optional<double> interpolationGreyLevels;
    Gradients gradients = Gradients::Auto;
    bool operator==(const Quality&) const = default;
};

struct Picture {
    glm::ivec2 size{1024, 768};            ///< Pixels, each 1..16384.
    glm::dvec3 background{0.0, 0.0, 0.0};  ///< Display-encoded RGB in [0, 1].
    bool transparent = false;              ///< RGBA without background.
    bool operator==(const Picture&) const = default;
};

/// What to draw, how, and how exactly. A plain value: the GUI edits one, a script is one, undo is the
/// previous one.
struct Scene {
    std::vector<VolumeItem> volumes;
    std::optional<std::vector<Light>>
        lights;  ///< Empty list: unlit. Unset: a headlight where the mode shades.
    Material material;
    Camera camera;
    Mode mode = Mode::Composite;
    double hitOpacity = 0.05;  ///< FirstHit: opacity per unit length that counts as a hit, in (0, 1].
    XRayDisplay xray = XRayDisplay::Opacity;
    CompositingSpace space = CompositingSpace::Display;
    std::optional<double> unitLengthMm;  ///< Length that extinction refers to; unset: mean voxel spacing.
    double densityScale =
        1.0;  ///< Multiplies all extinction (particle density, Engel et al. section 1.3.2), >= 0.
    Quality quality;
    Picture picture;
    bool operator==(const Scene&) const = default;
};

/// Fills in everything unset from the data: transfer function (preset for the modality, else from the value
/// range), window (the file's first, else from the modality and the range), isovalue, lights, unit length.
/// Pure; idempotent. A scene without items gets one for the first volume. What belongs to a component the
/// volume does not have stays unset. Precondition: one volume for each scene.volumes item (or any number and
/// no item).
[[nodiscard]] Scene completed(const Scene& scene, const std::vector<VolumePtr>& volumes);

/// Everything a JSON schema cannot say, for scenes made in code too: every number finite and within the
/// limits stated above, strings in UTF-8. Errors: InvalidArgument, the message beginning with the JSON
/// pointer.
[[nodiscard]] Result<void> validate(const Scene& scene);

/// Integrators whose steps follow from toleranceGreyLevels.
[[nodiscard]] bool keepsTolerance(Integrator integrator);
/// The error asked for, in grey levels: what is stated, or 1.
[[nodiscard]] double toleranceGreyLevels(const Quality& quality);

/// Ray step in mm for a grid.
[[nodiscard]] double stepMm(const Quality& quality, const Grid& grid);

/// Modes whose colours or extinctions come from the transfer function.
[[nodiscard]] bool usesTransferFunction(Mode mode);
/// The filter whose field this one draws in another way; most have a field of their own.
[[nodiscard]] Filter fieldOf(Filter filter);
/// Filters whose second derivatives stay within the second differences of the voxels.
[[nodiscard]] bool boundsBends(Filter filter);
/// Modes whose segments are integrated as Quality::integrator says.
[[nodiscard]] bool usesIntegrator(Mode mode);
/// Modes that are lit.
[[nodiscard]] bool usesLights(Mode mode);
/// Modes shown through the window.
[[nodiscard]] bool usesWindow(Mode mode);

}  // namespace pellucid
