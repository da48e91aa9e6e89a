"""What the page of a rough contact has besides: how film and solid share load and area."""

from mgehl.output.mixed_words import gap_band_words, load_words, mean_gaps
from mgehl.output.report.page import NO_NUMBER, Section, Text, number, table


def mixed_highlights(mixed):
    """Numbers of a `MixedResult` that most readers come for; none of smooth bodies."""
    if mixed:
        yield "lambda", number(mixed.lambda_ratio, 3)
        whose = ", the grid's" if mixed.error and mixed.error.is_the_grids("contact_load_share") else ""
        yield "load on contact", f"{_percent(mixed, 'contact_load_share')} %{whose}"
        if mixed.mean_gap_nm is not None:
            yield "mean gap", f"{mean_gaps(mixed)[0]} nm"


def mixed_sections(mixed):
    """The section of a `MixedResult`; none of smooth bodies."""
    if mixed:
        caption = "Film and contact of the rough bodies; films within the " + mixed.hertz_region
        blocks = [table(caption, ("quantity", "value", "unit"), [*_rows(mixed), *_gap_rows(mixed)])]
        if mixed.error:
            words = gap_band_words(mixed.error)
            blocks += [Text(f"{words[0].upper()}{words[1:]}."), *_grids(mixed.error)]
        yield Section("mixed", "How film and contact share", tuple(blocks))


def _gap_rows(mixed):
    """What hardly depends on the grid; nothing of an older result."""
    if mixed.mean_gap_nm is None:
        return
    mean, loaded = mean_gaps(mixed)
    yield f"mean gap within the {mixed.hertz_region}, contact included", mean, "nm"
    yield "mean gap by pressure: where the load rests", loaded, "nm"
    near = number(100 * mixed.near_contact_load_share, 4)
    yield "part of the load on films at most a tenth thicker than contact's", near, "%"


def _grids(error):
    """What the grids say that the bands come from, where there are some."""
    if error.grids:
        rows = [
            (
                str(grid.nodes),
                number(grid.mean_nm, 4),
                number(grid.loaded_nm, 4),
                number(grid.max_pressure_GPa, 4),
                number(100 * grid.contact_load_share, 4),
                NO_NUMBER
                if grid.solid_load_fraction is None
                else number(100 * grid.solid_load_fraction, 4),
            )
            for grid in error.grids
        ]
        heads = (
            "nodes along x", "mean gap, nm", "by pressure, nm", "largest pressure, GPa",
            "load on contact, %", "on solids, %",
        )  # fmt: skip
        yield table("The grids that the bands come from", heads, rows)


def _percent(mixed, name):
    """A part of the load in %: with its band as on the terminal, without it with four digits."""
    if mixed.error and getattr(mixed.error, name) is not None:
        return load_words(mixed, name).removesuffix(" %")
    return number(100 * getattr(mixed, name), 4)


def _of_contact(mixed):
    """What of the load on contact solids carry, and what pockets carry; nothing of an older result."""
    if mixed.solid_load_fraction is not None:
        yield "part of the load that solids carry", _percent(mixed, "solid_load_fraction"), "%"
        sealed = number(100 * mixed.sealed_load_fraction, 4)
        yield "part of the load on pockets that contact shuts in", sealed, "%"


def _rows(mixed):
    return [
        ("lambda: smooth film of the formula over Sq", number(mixed.lambda_ratio, 4), ""),
        ("rms of the heights Sq", number(mixed.Sq_nm, 4), "nm"),
        ("part of the load on contact", _percent(mixed, "contact_load_share"), "%"),
        *_of_contact(mixed),
        ("part of the load on the film", number(100 * mixed.film_load_share, 4), "%"),
        ("real contact area", number(1e12 * mixed.contact_area_m2, 4), mixed.area_unit),
        ("real contact area over Hertz's", number(100 * mixed.contact_area_over_hertz, 4), "%"),
        ("patches of contact", str(mixed.patches), ""),
        ("largest patch", number(1e12 * mixed.largest_patch_m2, 4), mixed.area_unit),
        ("mean film", number(mixed.mean_film_nm, 4), "nm"),
        ("minimum film", number(mixed.minimum_film_nm, 4), "nm"),
        ("mean film in valleys deeper than Sq", number(mixed.valley_film_nm, 4), "nm"),
        (
            f"part of the {mixed.hertz_region} where the film is torn",
            number(100 * mixed.torn_share, 4),
            "%",
        ),
    ]
