"""Write illuminants.csv here and the table of glsl/lib/cie_1931.glsl from colour-science 0.4.7.

Run it where that is installed: pip install colour-science==0.4.7; python make.py. SOURCES.md says
where its numbers come from.
"""

import csv
from pathlib import Path

from colour.colorimetry.datasets.cmfs import DATA_CMFS_STANDARD_OBSERVER
from colour.colorimetry.datasets.illuminants import sds, sds_d_illuminant_series

HERE = Path(__file__).parent
TABLE = HERE.parents[1] / "glsl" / "lib" / "cie_1931.glsl"
STEP = 5  # nm
SECOND = 1.4388e-2 / 1.4380e-2  # D65 is named for 6500 K with the second radiation constant of 1931
DAYLIGHT = {"D50": 5000, "D55": 5500, "D65": 6500, "D75": 7500}  # K
LAMPS = {"F2": "FL2", "F7": "FL7", "F11": "FL11", "LED-B1": "LED-B1", "LED-B3": "LED-B3"}


def daylight(temperature):
    """Return {nm: power} of CIE daylight, 300 to 830 nm (CIE 15:2018, sec. 4.1.2).

    temperature: correlated, K, [4000, 25000]. The weights of S1 and S2 have three decimals there.
    """
    t = 1e3 / temperature
    if temperature <= 7000:
        x = 0.244063 + 0.09911 * t + 2.9678 * t**2 - 4.6070 * t**3
    else:
        x = 0.237040 + 0.24748 * t + 1.9018 * t**2 - 2.0064 * t**3
    y = -3.0 * x**2 + 2.870 * x - 0.275
    below = 0.0241 + 0.2562 * x - 0.7341 * y
    first = round((-1.3515 - 1.7703 * x + 5.9114 * y) / below, 3)
    second = round((0.0300 - 31.4424 * x + 30.0717 * y) / below, 3)
    s0, s1, s2 = sds_d_illuminant_series.DATA_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES.values()
    return {nm: round(s0[nm] + first * s1[nm] + second * s2[nm], 5) for nm in s0}


def illuminants():
    """Return {name: {nm: relative power}}."""
    published = sds.DATA_ILLUMINANTS_CIE
    found = {name: daylight(kelvin * SECOND) for name, kelvin in DAYLIGHT.items()}
    for name in DAYLIGHT:
        assert all(abs(found[name][nm] - power) < 1e-3 for nm, power in published[name].items())
    found["E"] = dict.fromkeys(range(360, 831, STEP), 100.0)
    return found | {name: published[theirs] for name, theirs in LAMPS.items()}


def main():
    """Write both files."""
    every = illuminants()
    with open(HERE / "illuminants.csv", "w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["wavelength_nm", *every])
        for nm in range(300, 831, STEP):
            powers = (table.get(nm) for table in every.values())
            rows.writerow([nm, *("" if p is None else f"{p:g}" if p == 100 else p for p in powers)])
    observer = DATA_CMFS_STANDARD_OBSERVER["CIE 1931 2 Degree Standard Observer"]
    lines = [f"    vec3({', '.join(map(repr, observer[nm]))})" for nm in range(360, 831, STEP)]
    head, bracket, _ = TABLE.read_text().partition("](\n")
    TABLE.write_text(head + bracket + ",\n".join(lines) + "\n);\n")


if __name__ == "__main__":
    main()
