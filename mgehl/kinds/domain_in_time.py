"""The domain of a run in time, where "auto" stands for it: what the motion of all instants asks for."""

from dataclasses import replace

from mgehl.config_value import AUTO
from mgehl.kinds.time import range_of

SQUEEZED = 0.5
"""Part of the largest speed, or load, down to which the other must fall for oil to be squeezed out."""


def _squeezes(config):
    """Whether speed or load change so much until time.end, or surfaces stand still, that oil is squeezed
    out on all sides."""
    if not config.is_in_time or config.moes.M is not None:
        return False
    ranges = (range_of(config, key) for key in ("motion.speed", config.kind.load_key))
    return any(least <= SQUEEZED * most for least, most in ranges)


def reverses(config):
    """Whether the surfaces turn round until time.end."""
    return config.is_in_time and range_of(config, "motion.speed")[0] < 0.0


def on_all_sides(config, ends, is_line):
    """The ends of a domain along each axis, as far on one side as on the other where the motion turns
    round, or where oil is squeezed out between lines: of points what that carries beyond is counted."""
    if reverses(config) or (is_line and _squeezes(config)):
        return {name: (-max(-first, last), max(-first, last)) for name, (first, last) in ends.items()}
    return ends


def with_room_for(start, case, config):
    """The `Config` of a `Case` in time: where `config` has "auto", its domain holds that of the `Solution`
    it goes on from, too. Films that are there may be thicker than those of the speeds to come."""
    ours, theirs, grid = case.contact, start.contact, case.config.grid
    if start.config.contact.kind != config.contact.kind:
        return case.config
    wider = {"x": theirs.x_scale / ours.x_scale, "y": theirs.y_scale / ours.y_scale}
    ends = {}
    for name in "x" if ours.is_line else "xy":
        (first, last), old = (getattr(each, name) for each in (grid, start.config.grid))
        if getattr(config.grid, name) == AUTO:
            ends[name] = min(first, wider[name] * old[0]), max(last, wider[name] * old[1])
    ends = on_all_sides(config, ends, ours.is_line)
    return replace(case.config, grid=replace(grid, **ends))
