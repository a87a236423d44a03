#include "lib/constants.glsl"

// What one bounce on a rough mirror (F = 1) loses to the bounces that follow, under height-correlated
// Smith shadowing (E. Heitz, JCGT 3(2), 2014), and the lobe by which C. Kulla and A. Conty, SIGGRAPH
// 2017, give it back. tests/benchmarks/fit_energy.py fits the coefficients to a quadrature, from below:
// never more comes back than was lost, up to 1e-4.

// 1 - E(mu): quartic over quartic in z = alpha / (mu + alpha), and a term exact at alpha 1; up to 4e-4
// less than it is.
// mu: cosine, [0, 1]; alpha: [1e-3, 1]
float deficit_ggx(float mu, float alpha) {
    float s = 1.0 / (mu + alpha), y = mu * s, z = alpha * s;
    float p = 0.100384049;
    p = p * z + (13.1101565 * alpha - 3.20414403);
    p = p * z + ((-37.444529 * alpha - 21.7441925) * alpha + 5.53471533);
    p = p * z + (((22.3279378 * alpha + 59.3055359) * alpha + 7.97159611) * alpha + 0.272466248);
    p = p * z + ((((10.0947628 * alpha - 11.6255814) * alpha - 9.31642474) * alpha
        - 0.401734592) * alpha + 0.00343048176);
    float q = -0.590464289;
    q = q * z + (-32.2140592 * alpha + 12.9581371);
    q = q * z + ((26.3002905 * alpha + 18.3403989) * alpha - 0.516776657);
    q = q * z + (((-20.9211672 * alpha + 34.5288358) * alpha - 13.3222088) * alpha + 0.328454188);
    q = q * z + ((((10.5441866 * alpha - 14.103776) * alpha - 1.41200055) * alpha
        + 2.9354913) * alpha + 1.0);
    return max((1.0 - alpha) * y * z * p / q - alpha * mu * log(max(y, 1e-30)), 0.0);
}

// 2 int (1 - E) mu dmu of that fit, rational in sqrt(alpha); 2e-4 of it.
// alpha: [1e-3, 1]
float deficit_average_ggx(float alpha) {
    float t = sqrt(alpha);
    return alpha * ((((((9.98316732 * t - 37.6916529) * t + 48.2804145) * t - 20.8585673) * t
        + 4.31893445) * t + 0.0260724834) * t + 0.00649225412)
        / ((((3.73877938 * t - 1.04867307) * t + 6.64275325) * t - 3.45294341) * t + 1.0);
}

// 1 - E(mu): quartic over quartic in z = alpha / (mu + alpha); up to 7e-4 less than it is.
// mu: cosine, [0, 1]; alpha: [1e-3, 1]
float deficit_beckmann(float mu, float alpha) {
    float s = 1.0 / (mu + alpha), y = mu * s, z = alpha * s;
    float v = alpha * alpha;
    float p = -13.7335936;
    p = p * z + (-5.24774882 * v + 33.7240715);
    p = p * z + ((17.2165281 * v + 15.5154177) * v - 13.1812458);
    p = p * z + (((-5.62617323 * v - 14.1552154) * v - 10.7290563) * v + 2.08766282);
    p = p * z + ((((1.0372574 * v + 3.34905397) * v + 2.73324961) * v + 1.36649319) * v
        - 0.129169655);
    float q = 107.290207;
    q = q * z + (-6.6122413 * v - 103.323935);
    q = q * z + ((5.22727523 * v - 20.1291604) * v + 47.675902);
    q = q * z + (((0.56935111 * v + 1.90806893) * v + 8.08376466) * v - 10.5531637);
    q = q * z + ((((0.388686316 * v - 1.92486025) * v + 1.49864452) * v - 1.72095351) * v + 1.0);
    return max(y * z * z * p / q, 0.0);
}

// 2 int (1 - E) mu dmu of that fit, rational in alpha^2; 1.1e-4 of it.
// alpha: [1e-3, 1]
float deficit_average_beckmann(float alpha) {
    float t = alpha * alpha;
    return t * ((((((-78.2570649 * t + 240.193907) * t - 433.167993) * t + 1195.72663) * t
        - 36.3917156) * t - 1.36097164) * t + 0.464278132)
        / ((((244.216233 * t + 2467.33784) * t - 68.7247956) * t - 3.1857498) * t + 1.0);
}

// The average of either distribution.
float deficit_average(bool ggx, float alpha) {
    return ggx ? deficit_average_ggx(alpha) : deficit_average_beckmann(alpha);
}

// The lobe of the lost light times N.L: tinted by F at every further bounce.
// average: mean Fresnel reflectance
vec3 bounced(bool ggx, float NdotL, float NdotV, float alpha, vec3 average) {
    float lost = deficit_average(ggx, alpha);
    float lost_L = ggx ? deficit_ggx(NdotL, alpha) : deficit_beckmann(NdotL, alpha);
    float lost_V = ggx ? deficit_ggx(NdotV, alpha) : deficit_beckmann(NdotV, alpha);
    vec3 tint = average * average * (1.0 - lost) / (1.0 - average * lost);
    return tint * (INV_PI * NdotL * lost_L * lost_V / max(lost, 1e-7));  // 1e-7: nothing is lost
}
