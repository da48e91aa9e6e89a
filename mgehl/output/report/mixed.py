"""What the page of a rough contact has besides: how film and solid share load and area."""

from mgehl.output.report.page import Section, number, table


def mixed_highlights(mixed):
    """Numbers of a `MixedResult` that most readers come for; none of smooth bodies."""
    if mixed:
        yield "lambda", number(mixed.lambda_ratio, 3)
        yield "load on contact", f"{number(100 * mixed.contact_load_share, 4)} %"


def mixed_sections(mixed):
    """The section of a `MixedResult`; none of smooth bodies."""
    if mixed:
        caption = "Film and contact of the rough bodies; films within the " + mixed.hertz_region
        rows = table(caption, ("quantity", "value", "unit"), _rows(mixed))
        yield Section("mixed", "How film and contact share", (rows,))


def _rows(mixed):
    return [
        ("lambda: smooth film of the formula over Sq", number(mixed.lambda_ratio, 4), ""),
        ("rms of the heights Sq", number(mixed.Sq_nm, 4), "nm"),
        ("part of the load on contact", number(100 * mixed.contact_load_share, 4), "%"),
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
