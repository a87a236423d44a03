"""Write the numbers of the metals: spectra.csv -> eta, k, f0 and f82 in each metal's TOML file.

Run it anywhere: python make.py. It rewrites the lines of [values] that it knows and prints how
far the three wavelengths are from the spectral truth. SOURCES.md says where the data come from.
"""

import csv
import re
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
WAVELENGTHS = np.array([660.0, 538.0, 437.0])  # nm for r, g, b: the result of `best`
ANGLES = np.array([1.0, 1 / 7])  # cosines of 0 and 81.79 degrees: F0 and F82
SLIDE = {  # the course's table of typical Fresnel values, linear; 1.00 stands for a value above 1
    "gold": (1.00, 0.71, 0.29),
    "silver": (0.95, 0.93, 0.88),
    "copper": (0.95, 0.64, 0.54),
    "iron": (0.56, 0.57, 0.58),
    "aluminium": (0.91, 0.92, 0.92),
}


def table(name):
    """Return the rows of a CSV file here as lists of text, without its heading."""
    with open(HERE / name, newline="") as file:
        return list(csv.reader(file))[1:]


def reflectance(eta, k):
    """Return unpolarised Fresnel reflectance, shape (2, n), at ANGLES.

    eta, k: refractive index and extinction, shape (n,), unitless. Fresnel 1823 with the complex
    index eta + ik: r_s and r_p from Snell's law, F = (|r_s|^2 + |r_p|^2) / 2.
    """
    index = np.asarray(eta) + 1j * np.asarray(k)
    cosine = ANGLES[:, None]
    inside = np.sqrt(1 - (1 - cosine**2) / index**2)  # cosine of the refracted angle
    r_s = (cosine - index * inside) / (cosine + index * inside)
    r_p = (index * cosine - inside) / (index * cosine + inside)
    return (abs(r_s) ** 2 + abs(r_p) ** 2) / 2


def best(spectra, truth):
    """Return the nm per channel where the squared error of F0 and F82 is least, shape (3,)."""
    nm = np.arange(400, 721)
    error = [
        (reflectance(*at(spectra[m], nm))[:, :, None] - np.minimum(truth[m], 1)[:, None, :]) ** 2
        for m in spectra
    ]
    return nm[np.sum(error, axis=(0, 1)).argmin(axis=0)]


def at(rows, nm):
    """Return eta and k at wavelengths nm, shape (2, n), linear between the published points."""
    return np.array([np.interp(nm, rows[:, 0], rows[:, column]) for column in (1, 2)])


def line(name, values):
    """Return `name = [r, g, b]` as TOML, to three decimals."""
    return f"{name} = [{', '.join(str(round(float(value), 3)) for value in values)}]"


def main():
    """Rewrite the TOML files and print the check."""
    rows = {}
    for metal, *numbers in table("spectra.csv"):
        rows.setdefault(metal, []).append([float(number) for number in numbers])
    spectra = {metal: np.array(numbers) for metal, numbers in rows.items()}
    nm, *weights = np.array(table("srgb_d65.csv"), float).T
    weights = np.array(weights)  # each row sums to 1: a perfect mirror is (1, 1, 1)
    truth = {metal: reflectance(*at(s, nm)) @ weights.T for metal, s in spectra.items()}
    print("best wavelengths:", *best(spectra, truth), "nm")
    print("metal      spectral F0, F82            three wavelengths minus that")
    errors = []
    for metal, spectrum in spectra.items():
        eta, k = np.round(at(spectrum, WAVELENGTHS), 3)
        made, clipped = reflectance(eta, k), np.minimum(truth[metal], 1)
        mean = reflectance(*(at(spectrum, nm) @ weights.T))
        errors.append((made - clipped, mean - clipped))
        for name, true, error in zip(("F0 ", "F82"), truth[metal], made - clipped, strict=True):
            print(f"{metal:10s} {name} {true.round(3)}   {error.round(3)}")
        f0 = SLIDE.get(metal, clipped[0])
        path = HERE / f"{metal}.toml"
        text = path.read_text(encoding="utf-8")
        for name, values in (("eta", eta), ("k", k), ("f0", f0), ("f82", made[1])):
            text = re.sub(rf"(?m)^{name} = .*$", line(name, values), text)
        path.write_text(text, encoding="utf-8")
    rms = np.sqrt(np.mean(np.square(errors), axis=(0, 2, 3)))
    print(f"rms error: three wavelengths {rms[0]:.4f}, spectral means of eta and k {rms[1]:.4f}")


if __name__ == "__main__":
    main()
