// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the two VTK-read formats share. Private to io; the only header here that includes VTK.
#pragma once

#include <string>
#include <vector>

#include <vtkCommand.h>
#include <vtkImageData.h>

#include "io/voxel_data.h"

namespace pellucid::io {

/// Collects what a VTK object would print. The first error is the cause; later ones follow from it.
class VtkErrors : public vtkCommand {
public:
    static VtkErrors* New() { return new VtkErrors; }
    void Execute(vtkObject* caller, unsigned long event, void* data) override;
    [[nodiscard]] const std::string& first() const { return m_first; }
    [[nodiscard]] bool any() const { return !m_first.empty(); }

private:
    std::string m_first;
};

/// Nothing of VTK prints; errors reach the observers. Process-wide, as VTK has it.
void silenceVtk();

/// Copies point data (else cell data) of an image to a volume, placed by its origin, spacing, direction and
/// extent. The frame of VTK files is not a patient's: taken as LPS mm, with a warning. Errors: Corrupt (no
/// voxels, wrong count), Unsupported (type, components).
[[nodiscard]] Result<VolumePtr> volumeFromVtk(vtkImageData& image, VolumeParts parts);

}  // namespace pellucid::io
