"""Of a run in time, input that is allowed, and yet unusual."""

import numpy as np

from mgehl.kinds import time
from mgehl.kinds.heat import solids_from

LARGEST_TURN = 180.0
"""Degrees from one value of a course to the next that may be meant."""

SMEARED = 0.25
"""Part of a cell below which shorter steps may do harm: a film under a load and a speed that swing is 7 %
off on 65 nodes with a sixth of a cell in a step, 2 % with two thirds."""

LONGER = 20.0
"""Times the run from which on a table of time is longer than is meant: its times are in another unit."""

FASTEST = 200.0
"""m/s that machines have."""


def implausible_in_time(config, contact, goes_on):
    """Lines that name it, of a run that `goes_on` from another or not."""
    if solids_from(config) is not None:
        yield "heat: a run in time tells no temperatures; a steady run of an instant does"
    yield from () if goes_on else _parts_from_rest(config)
    yield from _odd_steps(config, contact)
    yield from _leaps(config)
    yield from _long_tables(config)
    yield from _fast(config)


def _parts_from_rest(config):
    """A start from rest: of surfaces that stay there, or of bodies without layers."""
    if time.stands_still(config):
        yield (
            "motion.speed is 0 throughout: without --start-from RUN, whose film is squeezed, the run "
            "begins with the dry contact in a bath of oil"
        )
        return
    if config.contact.boundary_film or not time.begins_at_rest(config):
        return
    yield (
        "contact.boundary_film is not given: bodies at rest part on films as thin as rounding; until they "
        "have parted, load on contact and friction mean nothing; 2 nm is usual"
    )


def _odd_steps(config, contact):
    """Of a run in time whose surfaces go more cells in a step, or less of one, than suits its scheme."""
    if not config.time.step:
        return
    fastest = max(map(abs, time.range_of(config, "motion.speed")))
    mesh = config.kind.mesh(config, contact)
    way = fastest * config.time.step * np.array(contact.motion)
    scene = time.scene_of(config, contact)
    cells, most = scene.fastest(way, mesh), scene.most_asked
    mean, in_inlet = scene.most_cells(way, mesh), min(scene.most_in_inlet(t, mesh) for t in scene.extremes)
    if cells > most or mean > in_inlet:
        yield (
            f"time.step = {config.time.step:.4g} s: surfaces would go up to {cells:.3g} cells in a step; "
            f"steps are cut to {most:g}, and to {in_inlet:.2g} of the mean surface, for the inlet is short"
        )
    if 0.0 < cells < SMEARED:
        yield (
            f"time.step = {config.time.step:.4g} s: surfaces go {cells:.2g} of a cell in a step at most; "
            f"below {SMEARED:g} what is carried along is smeared: the bands tell how much"
        )


def _leaps(config):
    """Of a direction that changes with time, where it turns nearly all the way back, as after 360."""
    if not isinstance(config.motion.angle, str):
        return
    found = time.course("motion.angle", config.motion.angle)
    turns = np.abs(np.diff([found.value(t) for t in found.times(config.time.end)])).max()
    if turns > LARGEST_TURN:
        yield (
            f"motion.angle = {config.motion.angle!r}: turns by {turns:.4g} degrees from one value to the "
            "next; beyond 360 it goes on: 358, 362"
        )


def _long_tables(config):
    """Tables of which the run sees but the beginning."""
    for key in time.ONLY_IN_TIME:
        value = config.value(key)
        if not time.is_table(key, value):
            continue
        last = time.course(key, value).last
        if last > LONGER * config.time.end:
            yield (
                f"{key} = {value!r}: goes on to {last:.4g} s, and the run ends at {config.time.end:.4g} s: "
                "look at the unit of its times; without a heading they are in s"
            )


def _fast(config):
    """A speed that changes and becomes too large."""
    if isinstance(config.motion.speed, str):
        fastest = max(map(abs, time.range_of(config, "motion.speed")))
        if fastest > FASTEST:
            yield (
                f"motion.speed = {config.motion.speed!r}: up to {fastest:.4g} m/s: machines have 0 to "
                f"{FASTEST:g}; without a heading a table's speeds are in m/s"
            )
