// light   Ambient: the same radiance from everywhere, the course's I_a
uniform vec3 color = vec3(1.0);  // color: colour of the light (unitless)
uniform float radiance = 1.0;    // [0, 5 ..]: L, the same in every direction (W m^-2 sr^-1)

vec3 environment(vec3 direction) {
    return radiance * color;
}
