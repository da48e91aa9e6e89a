"""Rough balls drawn at random, from full film to boundary lubrication: how many are solved, by what work.

Roughness, load and speed are drawn by their logarithms, Hurst's exponent evenly; each case has a surface of
its own. Each case is solved for itself: no case starts from another.
"""

import time
from dataclasses import asdict, dataclass

import numpy as np

from mgehl.config import config_from_tables
from mgehl.run import solve
from mgehl.studies.cache import key_of
from mgehl.studies.rough_ball import BALL, HURST, RMS, DrawnBall, by_logarithm
from mgehl.studies.study import merged, statistic, verdict

NODES, CASES, SEED = 257, 120, 7

LOAD, SPEED = (20.0, 800.0), (1e-5, 1.0)
"""From, to: N, m/s."""

CASE = merged(
    BALL, {"surface": {"shortest_wavelength": 30e-6}, "solver": {"start": "film", "error": False}}
)
"""What all cases have in common: the usual scheme, no boundary film."""


class Drawn(DrawnBall):
    """A ball without layers."""

    def tables(self, nodes):
        """Its configuration."""
        own = {
            "contact": {"load": self.load},
            "surface": {"rms": self.rms, "hurst": self.hurst, "seed": self.number},
            "motion": {"speed": self.speed},
            "grid": {"nodes": nodes},
        }
        return merged(CASE, own)


@dataclass(frozen=True)
class Found:
    """What came of a case; the processors' seconds are those of the run that solved it."""

    converged: bool
    settled: bool
    doubt: str
    reason: str
    film_ratio: float
    """lambda: the central film of a formula over Sq."""
    contact_load_share: float
    contact_nodes: int
    nodes_in_wave: float
    overlap: float
    """Largest overlap outside of contact over Sq."""
    convolutions: float
    steps: int
    cpu: float

    @classmethod
    def of(cls, result, cpu):
        """Of a `Result`."""
        mixed, work = result.mixed, result.work
        return cls(
            result.converged, result.settled, "" if result.converged else result.doubt, result.reason,
            mixed.lambda_ratio, mixed.contact_load_share, result.contact.nodes,
            result.resolution.surface_nodes, result.overlap.largest_nm / mixed.Sq_nm,
            work.convolutions, work.steps, cpu,
        )  # fmt: skip

    @classmethod
    def from_point(cls, plain, _arrays):
        """Of a finished point of a study."""
        return cls(**plain)

    def shared(self):
        """All of it is known to every rank."""
        return self


def run(study):
    """Solve all; write the tables `mixed` and `mixed-summary`."""
    (nodes,) = study.nodes or (NODES,)
    drawn = draw(study.wanted or CASES, SEED if study.seed is None else study.seed)
    study.cases = len(drawn)
    found = [_solve(study, case, nodes) for case in drawn]
    study.write_table("mixed", [row(*pair) for pair in zip(drawn, found, strict=True)])
    study.write_table("mixed-summary", summary(found))


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    chance, drawn = np.random.default_rng(seed), []
    for number in range(1, cases + 1):
        rms, load, speed = (by_logarithm(chance, *ends) for ends in (RMS, LOAD, SPEED))
        drawn.append(Drawn(number, rms, load, speed, float(chance.uniform(*HURST))))
    return drawn


def _solve(study, case, nodes):
    """The case, from the study's points or solved. A point keeps numbers and no field."""
    config = config_from_tables(case.tables(nodes))
    key = key_of(["mixed", config.as_toml_tables()])
    found = study.cache.load(key, Found.from_point)
    if found is None:
        started = time.process_time()
        result = solve(config, study.comm).result
        found = Found.of(result, study.comm.allreduce(time.process_time() - started))
        study.cache.store(key, lambda: (asdict(found), {}))
    study.failures += not found.converged
    study.tell(f"{case.number:3d}: {case.title}", found)
    return found


def row(case, found):
    """Text of one case."""
    return {
        "case": str(case.number),
        "rms nm": f"{1e9 * case.rms:.1f}",
        "load N": f"{case.load:.1f}",
        "speed mm/s": f"{1e3 * case.speed:.4g}",
        "Hurst": f"{case.hurst:.3f}",
        "lambda": f"{found.film_ratio:.3g}",
        "nodes in the shortest wave": f"{found.nodes_in_wave:.1f}",
        "load on contact": f"{found.contact_load_share:.4f}",
        "contact nodes": str(found.contact_nodes),
        "overlap/Sq": f"{found.overlap:.1e}",
        "convolutions": f"{found.convolutions:.1f}",
        "steps": str(found.steps),
        "CPU s": f"{found.cpu:.1f}",
        "verdict": verdict(found),
    }


def summary(found):
    """Rows of the summary of all cases."""
    good = [each for each in found if each.converged]
    doubted = sum(each.settled for each in found) - len(good)
    numbers = {
        "cases": str(len(found)),
        "converged": f"{len(good)} ({100 * len(good) / len(found):.1f} %)",
        "settled, and in doubt": str(doubted),
        "not settled": str(len(found) - len(good) - doubted),
        "convolutions, mean": statistic(np.mean, _each("convolutions", found)),
        "convolutions, median": statistic(np.median, _each("convolutions", found)),
        "convolutions of the converged, mean": statistic(np.mean, _each("convolutions", good)),
        "CPU s, mean": statistic(np.mean, _each("cpu", found)),
        "largest overlap/Sq of the converged": statistic(np.max, _each("overlap", good), "{:.1e}"),
    }
    return [{"what": what, "value": value} for what, value in numbers.items()]


def _each(name, found):
    return [getattr(each, name) for each in found]
