"""Tables as a terminal shows them."""

from mgehl.output.drawn_table import drawn

ROWS = [
    {"case": "a film", "nodes": "65", "film nm": "12.1 ± 0.4", "why": ""},
    {"case": "contact", "nodes": "1025", "film nm": "", "why": "sets cycle"},
]


def test_columns_stand_under_each_other_and_numbers_on_the_right():
    assert drawn(ROWS, ["case", "nodes", "film nm", "why"], 80) == (
        "case     nodes     film nm  why\n"
        "───────  ─────  ──────────  ──────────\n"
        "a film      65  12.1 ± 0.4\n"
        "contact   1025              sets cycle"
    )


def test_what_has_no_room_follows_below():
    assert drawn(ROWS, ["case", "nodes", "film nm", "why"], 30) == (
        "case     nodes     film nm\n"
        "───────  ─────  ──────────\n"
        "a film      65  12.1 ± 0.4\n"
        "contact   1025\n"
        "\n"
        "case     why\n"
        "───────  ──────────\n"
        "a film\n"
        "contact  sets cycle"
    )


def test_a_column_wider_than_the_terminal_has_a_block_of_its_own():
    rows = [{"a": "x", "b": 50 * "y", "c": "z"}]
    assert len(drawn(rows, ["a", "b", "c"], 20).split("\n\n")) == 2


def test_a_control_character_moves_no_cursor():
    assert "\x1b" not in drawn([{"a": "\x1b[2J"}], ["a"])
