// What a light sends to a point: the unit direction to the light, in world space, and the irradiance
// on a surface that faces it [W m^-2].
struct Incident {
    vec3 direction;
    vec3 irradiance;
};
