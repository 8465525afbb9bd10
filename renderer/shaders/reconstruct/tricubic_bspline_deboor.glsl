// The cubic B-spline by de Boor's recursion: linear interpolations of linear interpolations, the kernel itself is never
// evaluated (Engel et al. 2006, section 9.2.6; equation 18). The lowest level is 27 linear fetches. For comparison with
// the direct evaluation.
uniform sampler3D volumeTexture;
uniform vec3 volumeSize;  // voxels

/// The levels above the lowest, along one axis.
float deBoor(vec3 lowest, float u) {
    vec2 level = mix(lowest.xy, lowest.yz, vec2(u + 1.0, u) / 2.0);
    return mix(level.x, level.y, u);
}

float reconstruct(vec3 p) {
    vec3 position = p * volumeSize - 0.5;
    vec3 base = floor(position);
    vec3 u = position - base;
    vec3 place[3];  // voxel base + i - 1, and (u + 2 - i) / 3 of the way to the next
    for (int i = 0; i < 3; ++i)
        place[i] = (base + float(i) - 0.5 + (u + 2.0 - float(i)) / 3.0) / volumeSize;
    vec3 planes;
    for (int k = 0; k < 3; ++k) {
        vec3 rows;
        for (int j = 0; j < 3; ++j) {
            vec3 row;
            for (int i = 0; i < 3; ++i)
                row[i] = textureLod(volumeTexture, vec3(place[i].x, place[j].y, place[k].z), 0.0).r;
            rows[j] = deBoor(row, u.x);
        }
        planes[k] = deBoor(rows, u.y);
    }
    return deBoor(planes, u.z);
}
