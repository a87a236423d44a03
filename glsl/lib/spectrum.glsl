#include "lib/cie_1931.glsl"
#include "lib/exponential.glsl"

const float LUMENS = 683.002;      // of a watt where the eye is most sensitive, K_m (lm/W)
const float EFFICACY = 176.80388;  // of CIE D65, which makes luminance of Lumiar's radiance (lm/W)
const vec3 LUMINANCE = vec3(0.2126729, 0.7151522, 0.0721750);  // Y of linear sRGB, white being D65

// M. Planck, 1901: spectral radiance of a black body [W m^-2 sr^-1 um^-1], as e^-x / (1 - e^-x), which
// overflows nowhere; 4e-6 off at most where it is seen. 2hc^2 and hc/k are those of the SI of 2019.
// wavelength: in vacuum (um); temperature: (0, 1e30] (K)
float planck(float wavelength, float temperature) {
    float x = 14387.768775 / (wavelength * temperature), square = wavelength * wavelength;
    float scale = 1.1910429724e8 / (square * square * wavelength);
    return scale * exponential(-x) / -exponential_minus_one(-x);
}

// The colour-matching functions x, y, z of the CIE 1931 2 degree observer, by a third-order polynomial
// through four values of the table, as CIE 15 has it: 0.0024 off at most in z, 0.0005 in x and y.
// wavelength: any, 0 beyond 355 to 835 nm (um)
vec3 cie_1931(float wavelength) {
    float at = (wavelength - CIE_1931_FIRST) / CIE_1931_STEP;
    if (at < -1.0 || at > 95.0) return vec3(0.0);
    int i = clamp(int(floor(at)), 0, 93);
    float t = at - float(i);
    vec4 weight = vec4(t - 1.0, t + 1.0, t + 1.0, t + 1.0) * vec4(t - 2.0, t - 1.0, t, t);
    weight *= vec4(-t, t - 2.0, 2.0 - t, t - 1.0) / vec4(6.0, 2.0, 2.0, 6.0);
    return weight.x * CIE_1931[max(i - 1, 0)] + weight.y * CIE_1931[i]
        + weight.z * CIE_1931[i + 1] + weight.w * CIE_1931[min(i + 2, 94)];
}

// V, the luminous efficiency of light at a wavelength: y of the observer. wavelength: any (um)
float luminosity(float wavelength) {
    return cie_1931(wavelength).y;
}

// A Gaussian of two halves. nm: where; low, high: what is below and above its middle (1/nm)
float cie_1931_lobe(float nm, float middle, float low, float high) {
    float t = (nm - middle) * (nm < middle ? low : high);
    return exp(-0.5 * t * t);
}

// x, y, z as sums of lobes, C. Wyman, P.-P. Sloan and P. Shirley, "Simple analytic approximations to the CIE
// XYZ color matching functions", JCGT 2(2), 2013, table 1: 0.022 off at most, in z. wavelength: any (um)
vec3 cie_1931_fit(float wavelength) {
    float nm = 1000.0 * wavelength;
    float x = 0.362 * cie_1931_lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * cie_1931_lobe(nm, 599.8, 0.0264, 0.0323);
    x -= 0.065 * cie_1931_lobe(nm, 501.1, 0.0490, 0.0382);
    float y = 0.821 * cie_1931_lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * cie_1931_lobe(nm, 530.9, 0.0613, 0.0322);
    float z = 1.217 * cie_1931_lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * cie_1931_lobe(nm, 459.0, 0.0385, 0.0725);
    return vec3(x, y, z);
}

// Linear sRGB, IEC 61966-2-1, of CIE XYZ: negative outside the gamut, as all of Lumiar's radiance. White is
// D65 of XYZ = (0.95047, 1, 1.08883), to more digits than the standard prints. xyz: any
vec3 srgb_from_xyz(vec3 xyz) {
    const mat3 matrix = mat3(
        3.24045416, -0.96926603, 0.05564343,  // of X
        -1.53713851, 1.87601085, -0.20402591,  // of Y
        -0.49853141, 0.04155602, 1.05722519  // of Z
    );
    return matrix * xyz;
}

// The radiance of a black body [W m^-2 sr^-1], by the midpoints of `samples` intervals from 357.5 to 832.5 nm;
// 95 of them are the table's own wavelengths. How far chromaticity u'v' and luminance are off from 1000 to
// 20000 K at most: 8: 0.016, 1.7 %; 16: 0.0043, 0.25 %; 24: 7e-4, 0.09 %; 32: 2e-4, 0.03 %; 48: 5e-5, 1e-5;
// 95: 2e-6, 3e-6; by the fit: 0.019 at 1000 K, 0.0014 at 2856 K, 2e-4 at 6500 K.
// temperature: (0, 1e30] (K); samples: 1 or more; fit: by cie_1931_fit
vec3 black_body(float temperature, int samples, bool fit) {
    float width = 95.0 * CIE_1931_STEP / float(samples);
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < samples; ++i) {
        float wavelength = CIE_1931_FIRST - 0.5 * CIE_1931_STEP + (float(i) + 0.5) * width;
        xyz += planck(wavelength, temperature) * (fit ? cie_1931_fit(wavelength) : cie_1931(wavelength));
    }
    return srgb_from_xyz(xyz * (width * LUMENS / EFFICACY));
}
