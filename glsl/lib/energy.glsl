// What one bounce on a rough mirror (F = 1) loses to the bounces that follow, under height-correlated
// Smith shadowing (E. Heitz, JCGT 3(2), 2014), and the lobe by which C. Kulla and A. Conty, SIGGRAPH
// 2017, give it back. tests/benchmarks/fit_energy.py fits the coefficients to a quadrature.

// 1 - E(mu): quartic over quartic in z = alpha / (mu + alpha), and a term exact at alpha 1; 1.5e-4.
// mu: cosine, [0, 1]; alpha: [1e-3, 1]
float deficit_ggx(float mu, float alpha) {
    float s = 1.0 / (mu + alpha), y = mu * s, z = alpha * s;
    float p = 2.3545903;
    p = p * z + (6.71931549 * alpha - 7.49833928);
    p = p * z + ((-38.1232552 * alpha - 14.6107791) * alpha + 6.01320355);
    p = p * z + (((25.6810973 * alpha + 54.3177642) * alpha + 7.83227031) * alpha + 0.156260043);
    p = p * z + ((((9.14762106 * alpha - 11.5411507) * alpha - 8.92027292) * alpha
        - 0.402593892) * alpha + 0.0107740907);
    float q = -8.21481752;
    q = q * z + (-17.581554 * alpha + 12.9208039);
    q = q * z + ((14.2079083 * alpha + 14.0791922) * alpha - 0.474013208);
    q = q * z + (((-13.9636288 * alpha + 32.7773736) * alpha - 9.66280852) * alpha - 0.250390173);
    q = q * z + ((((7.73889411 * alpha - 10.6134614) * alpha - 4.19162415) * alpha
        + 3.26281844) * alpha + 1.0);
    return max((1.0 - alpha) * y * z * p / q - alpha * mu * log(max(y, 1e-30)), 0.0);
}

// 2 int (1 - E) mu dmu of that fit, rational in sqrt(alpha); 1e-4 of it.
// alpha: [1e-3, 1]
float deficit_average_ggx(float alpha) {
    float t = sqrt(alpha);
    return alpha * ((((((6.27627719 * t - 24.9953177) * t + 33.3764865) * t - 13.6544808) * t
        + 3.81196124) * t - 0.0487221244) * t + 0.0214066098)
        / ((((7.71260327 * t - 7.03553651) * t + 9.77068645) * t - 3.34427514) * t + 1.0);
}

// 1 - E(mu): quartic over quartic in z = alpha / (mu + alpha); 3.6e-4.
// mu: cosine, [0, 1]; alpha: [1e-3, 1]
float deficit_beckmann(float mu, float alpha) {
    float s = 1.0 / (mu + alpha), y = mu * s, z = alpha * s;
    float v = alpha * alpha;
    float p = -10.2845717;
    p = p * z + (-5.72022607 * v + 27.8226668);
    p = p * z + ((16.4947929 * v + 14.6657278) * v - 10.4861629);
    p = p * z + (((-5.91844956 * v - 13.0557882) * v - 9.93099791) * v + 1.55848756);
    p = p * z + ((((1.16763765 * v + 3.22280427) * v + 2.49664373) * v + 1.2529569) * v
        - 0.0887812188);
    float q = 104.988763;
    q = q * z + (-12.9263887 * v - 103.884133);
    q = q * z + ((6.77133899 * v - 11.1119318) * v + 48.3711939);
    q = q * z + (((0.387816325 * v + 0.297866594) * v + 4.76599036) * v - 10.6999655);
    q = q * z + ((((0.391744177 * v - 1.76796167) * v + 1.69539797) * v - 1.27650531) * v + 1.0);
    return max(y * z * z * p / q, 0.0);
}

// 2 int (1 - E) mu dmu of that fit, rational in alpha^2; 1.8e-4 of it.
// alpha: [1e-3, 1]
float deficit_average_beckmann(float alpha) {
    float t = alpha * alpha;
    return t * ((((((((-19390.7151 * t + 38594.3512) * t - 3578.82703) * t - 86367.7479) * t
        + 258539.512) * t - 26380.83) * t + 1521.05437) * t - 43.2987002) * t + 0.472379306)
        / ((((537193.149 * t - 55846.5134) * t + 3227.5135) * t - 91.7670557) * t + 1.0);
}

// The lobe of the lost light times N.L: tinted by F at every further bounce.
// lost_L, lost_V: 1 - E; lost: its average; average: mean Fresnel reflectance
vec3 bounced(float NdotL, float lost_L, float lost_V, float lost, vec3 average) {
    vec3 tint = average * average * (1.0 - lost) / (1.0 - average * lost);
    return tint * (0.318309886 * NdotL * lost_L * lost_V / max(lost, 1e-7));  // 1e-7: nothing is lost
}
