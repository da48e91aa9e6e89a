"""Numbers by which runs are compared along a key: where result.json has them, in curves and in sweep.nc."""

import json
import tomllib
from dataclasses import dataclass
from math import nan
from typing import NamedTuple

from mgehl.kinds.bodies import roughness_of
from mgehl.kinds.choice import value_of
from mgehl.output.files import INPUTS
from mgehl.output.stored import read_texts
from mgehl.output.time_words import of_a_mean


class Quantity(NamedTuple):
    """Where a number is, its unit and meaning, and where the half-width of its band is."""

    path: str
    unit: str
    meaning: str
    band: str = ""


QUANTITIES = {
    name: Quantity(*told) for name, told in {
        "central_film_nm": ("central_film_nm", "nm", "central film", "error.central_nm"),
        "minimum_film_nm": ("minimum_film_nm", "nm", "smallest film", "error.minimum_nm"),
        "mean_gap_nm": ("mixed.mean_gap_nm", "nm", "mean gap within Hertz", "mixed.error.mean_nm"),
        "loaded_gap_nm": ("mixed.loaded_gap_nm", "nm", "mean gap by pressure", "mixed.error.loaded_nm"),
        "load_on_solids": ("mixed.solid_load_fraction", "1", "load on solids",
                           "mixed.error.solid_load_fraction"),
        "load_on_contact": ("mixed.contact_load_share", "1", "load on contact",
                            "mixed.error.contact_load_share"),
        "friction": ("friction.coefficient", "1", "friction", "friction.coefficient_band"),
        "friction_of_film": ("friction.film_coefficient", "1", "friction of the film"),
        "friction_of_solids": ("friction.solid_coefficient", "1", "friction of solids"),
        "friction_of_rolling": ("friction.rolling_coefficient", "1", "rolling friction",
                                "friction.rolling_band"),
        "flash_1_K": ("friction.temperatures.largest_1", "K", "surface of body 1"),
        "flash_2_K": ("friction.temperatures.largest_2", "K", "surface of body 2"),
        "film_K": ("friction.temperatures.film", "K", "film, on average"),
        "bearing_load_N": ("load_N", "N", "load that the pressure carries", "load_band_N"),
        "bearing_drag_N": ("drag_N", "N", "friction on the plate"),
        "bearing_power_W": ("drag_power_W", "W", "power that drags the plate"),
        "bearing_centre_mm": ("pressure_centre_mm", "mm", "X of the centre of pressure"),
        "bearing_pressure_MPa": ("max_pressure_MPa", "MPa", "largest pressure"),
        "approach_um": ("approach_um", "um", "approach of dry bodies, of a line from a distance of a",
                        "dry_error.approach_um"),
        "contact_area": ("contact.area_fraction", "1", "contact over Hertz area",
                         "dry_error.area_fraction"),
        "max_pressure_GPa": ("max_pressure_GPa", "GPa", "largest pressure", "max_pressure_band_GPa"),
        "lambda_ratio": ("mixed.lambda_ratio", "1", "film of smooth bodies over Sq"),
        "convolutions": ("work.convolutions", "1", "fine-grid convolutions"),
    }.items()
}  # fmt: skip


def numbers_and_bands():
    """(Name, unit, meaning, path in result.json) of each quantity and of the half-width of its band."""
    for name, (path, unit, meaning, band) in QUANTITIES.items():
        yield name, unit, meaning, path
        if band:
            yield f"{name}_band", unit, f"half-width of the band about the {meaning}", band


ALSO_AT = {"load_on_contact": "contact.load_fraction"}
"""Where result.json has a number once more."""

BANDS = {each.path: each.band for each in QUANTITIES.values() if each.band}
BANDS |= {path: QUANTITIES[name].band for name, path in ALSO_AT.items()}
"""Where result.json has the half-width of a number's band, by where it has the number."""


def told_at(result, path):
    """What result.json has under nested names; None where that is nothing."""
    for name in path.split("."):
        result = (result or {}).get(name)
    return result


def _put_at(result, path, value):
    """Put a value under nested names."""
    *outer, last = path.split(".")
    for name in outer:
        result[name] = result.get(name) or {}
        result = result[name]
    result[last] = value


NO_MEANS = (
    "moes_film", "mixed.loaded_gap_nm", "mixed.mean_film_nm", "contact.area_fraction",
    "friction.film_coefficient", "friction.solid_coefficient", "friction.rolling_coefficient",
)  # fmt: skip
"""Of the last instant alone: left out where means stand beside them."""

PASSAGE, INSTANT = "a passage", "an instant"
"""What the numbers of a run in time are of."""


def of_what(result):
    """`PASSAGE` or `INSTANT`, of a run in time; else empty."""
    if not result.get("time"):
        return ""
    return PASSAGE if told_at(result, "time.means") else INSTANT


def with_means(result):
    """The same result; of a run in time its means over the last passage are where the numbers of its last
    instant were. A run that has no means keeps those (`of_what`)."""
    means, bands = told_at(result, "time.means") or {}, told_at(result, "time.error.means") or {}
    for path in NO_MEANS if means else ():
        if told_at(result, path) is not None:
            _put_at(result, path, None)
    for name, mean in means.items():
        found = QUANTITIES[name]
        _put_at(result, found.path, mean["value"])
        _put_at(result, found.band, of_a_mean(mean.get("between_passages"), bands.get(name)))
        if name in ALSO_AT:
            _put_at(result, ALSO_AT[name], mean["value"])
    passing, Sq = told_at(result, "time.Sq_nm"), told_at(result, "mixed.Sq_nm")
    if means and passing and Sq:
        film, changes = result["mixed"]["lambda_ratio"] * Sq, told_at(result, "time.whole")
        ratio = None if changes else film / passing  # its film is that of the last speed and load
        result["mixed"] |= {"lambda_ratio": ratio, "Sq_nm": passing}
    return result


@dataclass(frozen=True)
class Told:
    """What a run tells, nested plain values: its configuration and its result, None where it failed."""

    tables: dict
    result: dict | None
    why: str = ""
    """Why it has none."""

    def value(self, key):
        """The value of "section.key", given or derived; None without one."""
        given = value_of(self.tables, key)
        return (self.result or {}).get(INPUTS, {}).get(key) if given is None else given

    @property
    def lambda_ratio(self):
        """Of heights the smooth film over Sq; of roughness by its numbers the film over Rq; else None."""
        rms, film = roughness_of(self.tables), told_at(self.result, "central_film_nm")
        of_heights = told_at(self.result, "mixed.lambda_ratio")
        return 1e-9 * film / rms if of_heights is None and rms and film else of_heights

    def number(self, path):
        """What result.json has under nested names; nan where that is nothing."""
        of_lambda = path == QUANTITIES["lambda_ratio"].path
        found = self.lambda_ratio if of_lambda else told_at(self.result, path)
        return nan if found is None else float(found)

    @property
    def settled(self):
        """Whether the result solves the discrete equations."""
        return bool(self.result) and self.result.get("settled", self.result["converged"])

    @property
    def converged(self):
        """Whether more than that holds."""
        return bool(self.result) and self.result["converged"]


def read_told(directory):
    """The `Told` of a finished run, in time by its means. Raises OutputError."""
    texts = read_texts(directory)
    result = with_means(json.loads(texts["result.json"]))
    return Told(tomllib.loads(texts["configuration.toml"]), result)
