// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "bench/vtk_peer.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShortArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>

namespace pellucid::bench {
namespace {

/// 16 bits and unmapped values, as VTK likes its data best; the functions are mapped instead.
vtkNew<vtkImageData> imageOf(const Volume& volume) {
    vtkNew<vtkImageData> image;
    const Grid& grid = volume.grid();
    const glm::dvec3 spacing = spacingMm(grid);
    image->SetDimensions(grid.size.x, grid.size.y, grid.size.z);
    image->SetSpacing(spacing.x, spacing.y, spacing.z);
    image->SetOrigin(grid.patientFromIndex[3].x, grid.patientFromIndex[3].y, grid.patientFromIndex[3].z);
    image->AllocateScalars(volume.type() == VoxelType::Int16 ? VTK_SHORT : VTK_UNSIGNED_SHORT, 1);
    std::copy(volume.bytes().begin(), volume.bytes().end(),
              static_cast<std::byte*>(image->GetScalarPointer()));
    return image;
}

void setFunctions(const Scene& scene, const Volume& volume, vtkVolumeProperty& property) {
    vtkNew<vtkColorTransferFunction> color;
    vtkNew<vtkPiecewiseFunction> opacity;
    if (scene.mode == Mode::Mip) {
        const Window& window = *scene.volumes.front().window;
        const double lo = volume.mapping().stored(window.level - window.width / 2.0);
        const double hi = volume.mapping().stored(window.level + window.width / 2.0);
        color->AddRGBPoint(lo, 0.0, 0.0, 0.0);
        color->AddRGBPoint(hi, 1.0, 1.0, 1.0);
        opacity->AddPoint(lo, 1.0);
        opacity->AddPoint(hi, 1.0);
    } else {
        // Opacity is linear between VTK's points and extinction between ours: enough points make them one.
        const TransferFunction1D& function = *scene.volumes.front().transferFunction;
        const ValueRange range = volume.physicalRange();
        constexpr int kPoints = 4096;
        for (int i = 0; i < kPoints; ++i) {
            const double value = range.lo + (range.hi - range.lo) * i / (kPoints - 1);
            const OpticalSample sample = evaluate(function, value);
            const double stored = volume.mapping().stored(value);
            color->AddRGBPoint(stored, sample.color.r, sample.color.g, sample.color.b);
            opacity->AddPoint(stored, opacityFromExtinction(sample.extinction * scene.densityScale));
        }
    }
    property.SetColor(color);
    property.SetScalarOpacity(opacity);
    property.SetScalarOpacityUnitDistance(*scene.unitLengthMm);
    property.SetInterpolationTypeToLinear();
}

void setCamera(const Scene& scene, const Grid& grid, vtkRenderer& renderer) {
    const CameraPose& pose = *scene.camera.pose;
    vtkCamera* camera = renderer.GetActiveCamera();
    camera->SetPosition(pose.eye.x, pose.eye.y, pose.eye.z);
    camera->SetFocalPoint(pose.target.x, pose.target.y, pose.target.z);
    camera->SetViewUp(pose.up.x, pose.up.y, pose.up.z);
    if (scene.camera.projection == Projection::Orthographic) {
        camera->ParallelProjectionOn();
        camera->SetParallelScale(pose.heightMm / 2.0);
    } else {
        camera->SetViewAngle(scene.camera.fovDeg);
    }
    const double distance = glm::distance(pose.eye, centreMm(grid));
    camera->SetClippingRange(std::max(distance - 2.0 * radiusMm(grid), 0.01 * distance),
                             distance + 2.0 * radiusMm(grid));
}

}  // namespace

struct VtkPeer::State {
    glm::ivec2 size{0};
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkUnsignedCharArray> pixels;
};

VtkPeer::VtkPeer(const Scene& scene, const Volume& volume) : m_state(std::make_unique<State>()) {
    State& s = *m_state;
    s.size = scene.picture.size;
    vtkNew<vtkGPUVolumeRayCastMapper> mapper;
    mapper->SetInputData(imageOf(volume));
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetLockSampleDistanceToInputSpacing(0);
    mapper->SetUseJittering(0);
    mapper->SetImageSampleDistance(1.0F);
    mapper->SetSampleDistance(static_cast<float>(stepMm(scene.quality, volume.grid())));
    if (scene.mode == Mode::Mip)
        mapper->SetBlendModeToMaximumIntensity();
    else
        mapper->SetBlendModeToComposite();

    vtkNew<vtkVolumeProperty> property;
    setFunctions(scene, volume, *property);
    if (usesLights(scene.mode) && !scene.lights->empty()) {
        property->ShadeOn();
        property->SetAmbient(scene.material.ambient);
        property->SetDiffuse(scene.material.diffuse);
        property->SetSpecular(scene.material.specular);
        property->SetSpecularPower(scene.material.shininess);
    }
    vtkNew<vtkVolume> actor;
    actor->SetMapper(mapper);
    actor->SetProperty(property);

    s.renderer->AddVolume(actor);
    const glm::dvec3 background = scene.picture.background;
    s.renderer->SetBackground(background.r, background.g, background.b);
    s.window->SetOffScreenRendering(1);
    s.window->SetMultiSamples(0);
    s.window->SetSize(s.size.x, s.size.y);
    s.window->SwapBuffersOff();
    s.window->AddRenderer(s.renderer);
    setCamera(scene, volume.grid(), *s.renderer);
}

VtkPeer::~VtkPeer() = default;

void VtkPeer::draw() {
    State& s = *m_state;
    s.window->Render();
    s.window->GetRGBACharPixelData(0, 0, s.size.x - 1, s.size.y - 1, 0, s.pixels);
}

ImageF VtkPeer::image() const {
    const State& s = *m_state;
    ImageF image{s.size, std::vector<glm::vec4>(static_cast<std::size_t>(s.size.x) * s.size.y)};
    for (int y = 0; y < s.size.y; ++y)
        for (int x = 0; x < s.size.x; ++x)
            for (int channel = 0; channel < 4; ++channel)
                image.at(x, s.size.y - 1 - y)[channel] =
                    static_cast<float>(
                        s.pixels->GetTypedComponent(static_cast<vtkIdType>(y) * s.size.x + x, channel)) /
                    255.0F;
    return image;
}

}  // namespace pellucid::bench
