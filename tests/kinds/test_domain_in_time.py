"""A domain that stands for "auto" in time."""

import os

import pytest

from mgehl.config import load_config
from mgehl.kinds import contact_from, with_domain

LINE = {
    "contact.kind": "line", "contact.load_per_length": "20 N/mm", "contact.radius_x": "10 mm",
    "motion.speed": "1 m/s", "time.end": 1e-3, "grid.nodes": 257,
}  # fmt: skip
POINT = {"motion.speed": "1 m/s", "time.end": 1e-3, "grid.nodes": 65}


@pytest.mark.parametrize(
    "tables, key, rows, on_both",
    [(LINE, "motion.speed", "0 1\n1 0", True), (LINE, "motion.speed", "0 1\n1 0.9", False),
     (LINE, "contact.load_per_length", "0 2e4\n1 4e4", True), (POINT, "motion.speed", "0 1\n1 0", False),
     (POINT, "motion.speed", "0 1\n2e-3 -1", False), (POINT, "motion.speed", "0 1\n1e-3 -1", True)],
)  # fmt: skip
def test_what_is_squeezed_out_between_lines_leaves_on_both_sides(tmp_path, tables, key, rows, on_both):
    """What a point contact's oil carries beyond its domain is counted."""
    (tmp_path / "course.txt").write_text(rows.replace("\n1 ", "\n1e-3 "))
    config = load_config(os.devnull, tables | {key: str(tmp_path / "course.txt")})
    first, last = with_domain(config, contact_from(config)).grid.x
    assert (first == -last) is on_both
