// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/names.h"

#include <array>

#include "scene/scene.h"

namespace pellucid {

template <>
std::span<const EnumName<Accumulation>> enumNames<Accumulation>() {
    using enum Accumulation;
    static constexpr std::array<EnumName<Accumulation>, 3> kNames{
        {{Float32, "float32"}, {Half, "half"}, {EightBit, "8-bit"}}};
    return kNames;
}

template <>
std::span<const EnumName<AnatomicalView>> enumNames<AnatomicalView>() {
    using enum AnatomicalView;
    static constexpr std::array<EnumName<AnatomicalView>, 6> kNames{{{Anterior, "anterior"},
                                                                     {Posterior, "posterior"},
                                                                     {Left, "left"},
                                                                     {Right, "right"},
                                                                     {Superior, "superior"},
                                                                     {Inferior, "inferior"}}};
    return kNames;
}

template <>
std::span<const EnumName<Classification>> enumNames<Classification>() {
    using enum Classification;
    static constexpr std::array<EnumName<Classification>, 2> kNames{{{Post, "post"}, {Pre, "pre"}}};
    return kNames;
}

template <>
std::span<const EnumName<CompositingSpace>> enumNames<CompositingSpace>() {
    using enum CompositingSpace;
    static constexpr std::array<EnumName<CompositingSpace>, 2> kNames{
        {{Display, "display"}, {Linear, "linear"}}};
    return kNames;
}

template <>
std::span<const EnumName<ErrorNorm>> enumNames<ErrorNorm>() {
    using enum ErrorNorm;
    static constexpr std::array<EnumName<ErrorNorm>, 2> kNames{{{Rmse, "rmse"}, {Max, "max"}}};
    return kNames;
}

template <>
std::span<const EnumName<Filter>> enumNames<Filter>() {
    using enum Filter;
    static constexpr std::array<EnumName<Filter>, 8> kNames{
        {{Nearest, "nearest"},
         {Trilinear, "trilinear"},
         {TricubicBSpline, "tricubic-bspline"},
         {CatmullRom, "catmull-rom"},
         {Lanczos3, "lanczos3"},
         {TrilinearExact, "trilinear-exact"},
         {TricubicBSplineDeBoor, "tricubic-bspline-deboor"},
         {TricubicBSplineLut, "tricubic-bspline-lut"}}};
    return kNames;
}

template <>
std::span<const EnumName<Gradients>> enumNames<Gradients>() {
    using enum Gradients;
    static constexpr std::array<EnumName<Gradients>, 3> kNames{
        {{Auto, "auto"}, {OnTheFly, "on-the-fly"}, {Texture, "texture"}}};
    return kNames;
}

template <>
std::span<const EnumName<Integrator>> enumNames<Integrator>() {
    using enum Integrator;
    static constexpr std::array<EnumName<Integrator>, 10> kNames{{{Riemann, "riemann"},
                                                                  {Exponential, "exponential"},
                                                                  {Trapezoid, "trapezoid"},
                                                                  {Simpson, "simpson"},
                                                                  {GaussLegendre, "gauss-legendre"},
                                                                  {Preintegrated2D, "preintegrated-2d"},
                                                                  {Preintegrated3D, "preintegrated-3d"},
                                                                  {IntegralFunctions, "integral-functions"},
                                                                  {Adaptive, "adaptive"},
                                                                  {Importance, "importance"}}};
    return kNames;
}

template <>
std::span<const EnumName<LightKind>> enumNames<LightKind>() {
    using enum LightKind;
    static constexpr std::array<EnumName<LightKind>, 3> kNames{
        {{Headlight, "headlight"}, {Directional, "directional"}, {Point, "point"}}};
    return kNames;
}

template <>
std::span<const EnumName<Mode>> enumNames<Mode>() {
    using enum Mode;
    static constexpr std::array<EnumName<Mode>, 9> kNames{{{Composite, "composite"},
                                                           {Mip, "mip"},
                                                           {MinIp, "minip"},
                                                           {Average, "average"},
                                                           {XRay, "xray"},
                                                           {Emission, "emission"},
                                                           {FirstHit, "first-hit"},
                                                           {Isosurface, "isosurface"},
                                                           {Slice, "slice"}}};
    return kNames;
}

template <>
std::span<const EnumName<Projection>> enumNames<Projection>() {
    using enum Projection;
    static constexpr std::array<EnumName<Projection>, 2> kNames{
        {{Perspective, "perspective"}, {Orthographic, "orthographic"}}};
    return kNames;
}

template <>
std::span<const EnumName<XRayDisplay>> enumNames<XRayDisplay>() {
    using enum XRayDisplay;
    static constexpr std::array<EnumName<XRayDisplay>, 2> kNames{
        {{Transmittance, "transmittance"}, {Opacity, "opacity"}}};
    return kNames;
}

}  // namespace pellucid
