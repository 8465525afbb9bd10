// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <X11/Xlib.h>
#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointRayCastImage.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <thread>

#include "accuracy/peers/peer.h"

namespace pellucid::accuracy {
namespace {

/// 8- and 16-bit integers as they are stored, everything else as float: what both mappers take. In index
/// order with the grid's spacing; setPlace() puts it where it belongs.
vtkSmartPointer<vtkImageData> imageOf(const Volume& volume, int component) {
    const Grid& grid = volume.grid();
    const glm::dvec3 spacing = spacingMm(grid);
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(grid.size.x, grid.size.y, grid.size.z);
    image->SetSpacing(spacing.x, spacing.y, spacing.z);
    visitVoxels(volume, [&]<class T>(std::span<const T> voxels) {
        using Stored = std::conditional_t<(std::is_integral_v<T> && sizeof(T) <= 2), T, float>;
        constexpr int kType = std::is_same_v<Stored, std::int8_t>     ? VTK_SIGNED_CHAR
                              : std::is_same_v<Stored, std::uint8_t>  ? VTK_UNSIGNED_CHAR
                              : std::is_same_v<Stored, std::int16_t>  ? VTK_SHORT
                              : std::is_same_v<Stored, std::uint16_t> ? VTK_UNSIGNED_SHORT
                                                                      : VTK_FLOAT;
        image->AllocateScalars(kType, 1);
        auto* out = static_cast<Stored*>(image->GetScalarPointer());
        for (std::size_t i = component; i < voxels.size(); i += static_cast<std::size_t>(volume.components()))
            *out++ = static_cast<Stored>(voxels[i]);
    });
    return image;
}

void setFunctions(const Scene& scene, const Volume& volume, vtkVolumeProperty& property) {
    const VolumeItem& item = scene.volumes.front();
    vtkNew<vtkColorTransferFunction> color;
    vtkNew<vtkPiecewiseFunction> opacity;
    if (scene.mode == Mode::Mip) {
        const double lo = volume.mapping().stored(item.window->level - item.window->width / 2.0);
        const double hi = volume.mapping().stored(item.window->level + item.window->width / 2.0);
        color->AddRGBPoint(lo, 0.0, 0.0, 0.0);
        color->AddRGBPoint(hi, 1.0, 1.0, 1.0);
        opacity->AddPoint(lo, 1.0);
        opacity->AddPoint(hi, 1.0);
    } else {
        // Opacity is linear between VTK's points and extinction between ours: enough points make them one.
        const ValueRange range = volume.physicalRange(item.component);
        constexpr int kPoints = 4096;
        for (int i = 0; i < kPoints; ++i) {
            const double value = range.lo + (range.hi - range.lo) * i / (kPoints - 1);
            const OpticalSample sample = evaluate(*item.transferFunction, value);
            const double stored = volume.mapping().stored(value);
            color->AddRGBPoint(stored, sample.color.r, sample.color.g, sample.color.b);
            opacity->AddPoint(stored, opacityFromExtinction(sample.extinction * scene.densityScale));
        }
    }
    property.SetColor(color);
    property.SetScalarOpacity(opacity);
    property.SetScalarOpacityUnitDistance(*scene.unitLengthMm);
    property.SetInterpolationTypeToLinear();
    if (usesLights(scene.mode) && !scene.lights->empty()) {
        property.ShadeOn();
        property.SetAmbient(scene.material.ambient);
        property.SetDiffuse(scene.material.diffuse);
        property.SetSpecular(scene.material.specular);
        property.SetSpecularPower(scene.material.shininess);
    }
}

/// Rotation and translation of the grid; its spacing is the image's.
void setPlace(const Grid& grid, vtkVolume& actor) {
    const glm::dvec3 spacing = spacingMm(grid);
    vtkNew<vtkMatrix4x4> matrix;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            matrix->SetElement(row, column, grid.patientFromIndex[column][row] / spacing[column]);
        matrix->SetElement(row, 3, grid.patientFromIndex[3][row]);
    }
    actor.SetUserMatrix(matrix);
}

void setCamera(const Scene& scene, const Grid& grid, vtkRenderer& renderer) {
    const RayFrame frame = rayFrame(scene.camera, grid, scene.picture.size);
    vtkCamera* camera = renderer.GetActiveCamera();
    const double distance = glm::distance(frame.eye, centreMm(grid));
    const glm::dvec3 target = frame.eye + distance * frame.forward;
    const glm::dvec3 up = glm::normalize(frame.up);
    camera->SetPosition(frame.eye.x, frame.eye.y, frame.eye.z);
    camera->SetFocalPoint(target.x, target.y, target.z);
    camera->SetViewUp(up.x, up.y, up.z);
    if (frame.projection == Projection::Orthographic) {
        camera->ParallelProjectionOn();
        camera->SetParallelScale(glm::length(frame.up));
    } else {
        camera->SetViewAngle(glm::degrees(2.0 * std::atan(glm::length(frame.up))));
    }
    // VTK 9.1 reads a renderer's last aspect before it has set one: a second renderer in the memory of the
    // first keeps an aspect of 1.
    camera->UseExplicitAspectRatioOn();
    camera->SetExplicitAspectRatio(static_cast<double>(scene.picture.size.x) / scene.picture.size.y);
    camera->SetClippingRange(std::max(distance - 2.0 * radiusMm(grid), 0.01 * distance),
                             distance + 2.0 * radiusMm(grid));
}

vtkSmartPointer<vtkVolumeMapper> mapperFor(const Scene& scene, const Volume& volume,
                                           const ReportSetting& setting) {
    const auto common = [&](auto& mapper) {
        mapper.SetAutoAdjustSampleDistances(0);
        mapper.SetLockSampleDistanceToInputSpacing(0);
        mapper.SetImageSampleDistance(1.0F);
        mapper.SetSampleDistance(static_cast<float>(stepMm(scene.quality, volume.grid())));
    };
    vtkSmartPointer<vtkVolumeMapper> result;
    if (setting.renderer == "vtk-gpu") {
        auto mapper = vtkSmartPointer<vtkGPUVolumeRayCastMapper>::New();
        common(*mapper);
        mapper->SetUseJittering(setting.jitter ? 1 : 0);
        result = mapper;
    } else {
        auto mapper = vtkSmartPointer<vtkFixedPointVolumeRayCastMapper>::New();
        common(*mapper);
        mapper->SetInteractiveSampleDistance(static_cast<float>(stepMm(scene.quality, volume.grid())));
        result = mapper;
    }
    result->SetInputDataObject(imageOf(volume, scene.volumes.front().component));
    if (scene.mode == Mode::Mip)
        result->SetBlendModeToMaximumIntensity();
    else
        result->SetBlendModeToComposite();
    return result;
}

ImageF windowImage(vtkUnsignedCharArray& pixels, glm::ivec2 size) {
    ImageF image{size, std::vector<glm::vec4>(static_cast<std::size_t>(size.x) * size.y)};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int channel = 0; channel < 4; ++channel)
                image.at(x, size.y - 1 - y)[channel] = static_cast<float>(pixels.GetTypedComponent(
                                                           static_cast<vtkIdType>(y) * size.x + x, channel)) /
                                                       255.0F;
    return image;
}

/// The rays' own picture, associated RGBA in 15 bits, over the background: on screen it is magnified by half
/// a pixel.
ImageF fixedPointImage(vtkFixedPointVolumeRayCastMapper& mapper, const Scene& scene) {
    const glm::ivec2 size = scene.picture.size;
    const glm::vec4 background(glm::vec3(scene.picture.background), 0.0F);
    ImageF image{size, std::vector<glm::vec4>(static_cast<std::size_t>(size.x) * size.y, background)};
    vtkFixedPointRayCastImage* rays = mapper.GetRayCastImage();
    int inUse[2], memory[2], origin[2];
    rays->GetImageInUseSize(inUse);
    rays->GetImageMemorySize(memory);
    rays->GetImageOrigin(origin);
    const unsigned short* pixels = rays->GetImage();
    for (int y = 0; y < inUse[1]; ++y)
        for (int x = 0; x < inUse[0]; ++x) {
            const glm::ivec2 at(origin[0] + x, size.y - 1 - (origin[1] + y));
            if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
            const unsigned short* rgba = pixels + 4 * (static_cast<std::ptrdiff_t>(y) * memory[0] + x);
            glm::vec4 ray;
            for (int channel = 0; channel < 4; ++channel)
                ray[channel] = static_cast<float>(rgba[channel]) / 32767.0F;
            image.at(at.x, at.y) = ray + (1.0F - ray.a) * background;
        }
    return image;
}

PeerFrames drawFrames(const Scene& scene, const Volume& volume, const ReportSetting& setting,
                      int warmFrames) {
    const glm::ivec2 size = scene.picture.size;
    const vtkSmartPointer<vtkVolumeMapper> mapper = mapperFor(scene, volume, setting);
    vtkNew<vtkVolumeProperty> property;
    setFunctions(scene, volume, *property);
    vtkNew<vtkVolume> actor;
    actor->SetMapper(mapper);
    actor->SetProperty(property);
    setPlace(volume.grid(), *actor);
    vtkNew<vtkRenderer> renderer;
    renderer->AddVolume(actor);
    renderer->SetBackground(scene.picture.background.r, scene.picture.background.g,
                            scene.picture.background.b);
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(size.x, size.y);
    window->SwapBuffersOff();
    window->AddRenderer(renderer);
    setCamera(scene, volume.grid(), *renderer);
    // A light has no ambient part by default, and only the fixed-point mapper asks for it.
    vtkNew<vtkLight> headlight;
    headlight->SetLightTypeToHeadlight();
    headlight->SetAmbientColor(1.0, 1.0, 1.0);
    renderer->AddLight(headlight);

    PeerFrames frames;
    vtkNew<vtkUnsignedCharArray> pixels;
    for (int frame = 0; frame <= warmFrames; ++frame) {
        // VTK draws the fixed-point picture again only when something has changed.
        mapper->Modified();
        const auto start = std::chrono::steady_clock::now();
        window->Render();
        window->GetRGBACharPixelData(0, 0, size.x - 1, size.y - 1, 0, pixels);
        const double ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (frame == 0)
            frames.firstMs = ms;
        else
            frames.warmMs.push_back(ms);
    }
    auto* fixedPoint = vtkFixedPointVolumeRayCastMapper::SafeDownCast(mapper);
    frames.image = fixedPoint != nullptr ? fixedPointImage(*fixedPoint, scene) : windowImage(*pixels, size);
    return frames;
}

}  // namespace

std::optional<std::string> whyNoPeers(const Scene& scene, const Volume& volume) {
    Display* display = XOpenDisplay(nullptr);
    if (display == nullptr)
        return "Peers were left out: VTK draws on an X display only, and there is none (put xvfb-run -a "
               "before the command).";
    XCloseDisplay(display);
    if (glm::any(glm::lessThan(volume.grid().size, glm::ivec3(2))))
        return "Peers were left out: to VTK a volume of one voxel across is empty.";
    if (volume.nonFiniteCount() > 0)
        return "Peers were left out: VTK does not say what it draws where a voxel is no number.";
    if (isSheared(volume.grid())) return "Peers were left out: VTK takes no sheared grid.";
    if (scene.mode != Mode::Composite && scene.mode != Mode::Mip)
        return fmt::format(
            "Peers were left out: they are compared in composite and mip, and this scene is {}.",
            name(scene.mode));
    if (usesLights(scene.mode) &&
        (scene.lights->size() > 1 || (!scene.lights->empty() && scene.lights->front() != Light{})))
        return "Peers were left out: they are compared unlit or with one headlight of intensity 1.";
    if (scene.space != CompositingSpace::Display)
        return "Peers were left out: VTK blends in display space, and this scene in linear light.";
    return std::nullopt;
}

Result<PeerFrames> drawByPeer(const Scene& scene, const Volume& volume, const ReportSetting& setting,
                              int warmFrames) {
    PeerFrames frames;
    // Its GLX context and the renderer's EGL context cannot both be current on one thread.
    std::thread([&] { frames = drawFrames(scene, volume, setting, warmFrames); }).join();
    if (frames.image.pixels.empty())
        return fail(ErrorCode::Gpu, fmt::format("{} drew nothing", setting.renderer));
    return frames;
}

}  // namespace pellucid::accuracy
