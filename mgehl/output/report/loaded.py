"""Sections that the page of a point or line contact has besides those of every run."""

from math import isfinite

from mgehl.output.digits import with_band
from mgehl.output.mixed_words import mixed_note
from mgehl.output.report.doubt import mark_of, marked
from mgehl.output.report.mixed import mixed_highlights, mixed_sections
from mgehl.output.report.page import NO_NUMBER, Section, Text, number, table
from mgehl.output.report.verification import checks_table, contact_tables
from mgehl.output.words import band_words, largest_pressure_words

FORMULAS = {
    "hamrock_dowson": "Hamrock and Dowson",
    "nijenbanning_venner_moes": "Nijenbanning, Venner and Moes",
    "dowson_higginson": "of the Dowson-Higginson type",
    "chittenden": "Chittenden and others",
    "grubin": "Ertel and Grubin",
}
PICTURES = {}
"""Titles of pictures that are not those of `pictures.figures`."""

PEAKS = "Contact is on the peaks, where there is some"


def highlights(solution):
    """The numbers that most readers come for."""
    result = solution.result
    bare = "" if result.error.central_nm is not None else ", no band"
    return (
        *mixed_highlights(result.mixed),
        *((f"{which} film", f"{shown} nm{bare}") for which, shown in _own_films(result).items()),
        ("largest pressure", _largest_pressure(result)),
        ("contact / Hertz area", number(result.contact.area_fraction, 4)),
        ("cells in the inlet", f"{number(result.resolution.inlet_cells, 3)}"),
    )


def answer_sections(solution):
    """Films, checks, contact and groups."""
    result = solution.result
    return (
        Section("films", "Films", (_films(result), _bands(result.error), *_grids(result.error))),
        Section("checks", "Can it be trusted", (checks_table(solution),)),
        Section("contact", "Contact and Eq. 2", tuple(contact_tables(result))),
        *mixed_sections(result.mixed),
        Section("groups", "The contact in numbers", (_dimensions(solution), _groups(solution))),
    )


def alternatives(result):
    """What a reader who does not see a picture is told besides its title, by kind of picture."""
    largest = f"{number(result.max_pressure_GPa, 4)} GPa"
    return {
        "lines": f"The largest pressure is {largest}.",
        "film": "The film is {central} nm in the centre and {minimum} nm at its thinnest.".format(
            **_own_films(result)
        ),
        "pressure": f"Its maximum is {largest}.",
        "status": f"{result.contact.nodes} nodes are solid, {result.cavitated_nodes} are cavitated.",
        "surface": f"{': '.join(filter(None, (PEAKS, mixed_note(result.mixed))))}.",
        "history": f"The last residual is {number(result.residual, 2)}.",
    }


def _largest_pressure(result):
    """With its band as on the terminal, without it with four digits."""
    if result.mixed and result.mixed.error and result.mixed.error.max_pressure_GPa is not None:
        return largest_pressure_words(result)
    return f"{number(result.max_pressure_GPa, 4)} GPa"


def _films(result):
    own = {"central": result.central_film_nm, "minimum": result.minimum_film_nm}
    formulas = {}
    for name, nm in result.formulas.items():
        name = name.removesuffix("_nm")
        which = "minimum" if name.endswith("_minimum") else "central"
        formulas.setdefault(name.removesuffix(f"_{which}"), {})[which] = nm
    shown = _own_films(result)
    computed = marked("computed", mark_of(result))
    rows = [(computed, shown["central"], "", shown["minimum"], "")]
    rows += [_formula_row(name, films, own, result.converged) for name, films in formulas.items()]
    heads = ("film", "central, nm", "computed / formula", "minimum, nm", "computed / formula")
    return table("Computed films beside those of formulas for a full film", heads, rows)


def _bands(error):
    """How the bands about the films came about, or why there are none."""
    words = band_words(error)
    return Text(f"{words[0].upper()}{words[1:]}.")


def _grids(error):
    """Films of the grids that the bands come from, where there are some."""
    if not error.grids:
        return
    heads = ("nodes along x", "central, nm", "minimum, nm", "nodes in contact")
    rows = [
        (str(grid.nodes), film(grid.central_nm), film(grid.minimum_nm), str(grid.contact_nodes))
        for grid in error.grids
    ]
    yield table(
        "Films of the grids that the bands come from, each compared at the same places", heads, rows
    )


def _own_films(result):
    """The computed films with their bands."""
    error = result.error
    return {
        "central": film(result.central_film_nm, error.central_nm),
        "minimum": film(result.minimum_film_nm, error.minimum_nm),
    }


def _formula_row(name, films, own, converged):
    """Films of a formula; what did not converge is not compared with them."""
    cells = [FORMULAS.get(name, name.replace("_", " "))]
    for which in ("central", "minimum"):
        known = which in films
        ratio = _ratio(own[which], films[which]) if known and converged else ""
        cells += [film(films[which]) if known else "", ratio]
    return cells


def film(nm, half_width=None):
    """A film in nm as on the terminal: with its band; without, four digits after the point."""
    if nm is not None and half_width is not None:
        return with_band(nm, half_width)
    plain = nm is not None and abs(nm) < 1e7
    return _fixed(nm, 4) if plain else number(nm, 4)


def _ratio(computed, formula):
    return _fixed(computed / formula, 3) if computed is not None and formula else NO_NUMBER


def _fixed(value, decimals):
    return f"{round(value, decimals) + 0.0:.{decimals}f}" if isfinite(value) else NO_NUMBER


def _dimensions(solution):
    contact, mesh, line = solution.contact, solution.mesh, solution.mesh.is_line
    # A law of the user's own, on which the inlet of layered bodies depends, is not run again.
    hertz, cells = contact.hertz, solution.result.resolution.inlet_cells
    rows = [
        ("load", *solution.config.kind.load(contact)),
        ("entrainment speed", number(1e3 * contact.speed), "mm/s"),
        (
            "Hertz half-width a" if line else "Hertz semi-axis a, along x",
            number(1e6 * hertz.a),
            "µm",
        ),
        ("largest Hertz pressure p_h", number(1e-9 * hertz.p_h), "GPa"),
        ("unit of the gap, a²/R_x", number(1e6 * contact.film_scale), "µm"),
        ("length of the inlet zone", number(1e6 * cells * contact.cell_along_motion(mesh) * hertz.a), "µm"),
        ("cells of the grid in it", number(cells, 3), ""),
        ("spacing of the grid along x", number(1e6 * mesh.dX * hertz.a), "µm"),
    ]
    if not line:
        rows.insert(3, ("Hertz semi-axis b, along y", number(1e6 * hertz.b), "µm"))
        rows.insert(5, ("Hertz approach", number(1e6 * hertz.approach), "µm"))
        rows.insert(2, ("direction of the motion, from +x towards +y", number(contact.angle), "°"))
    return table("Scales of the dry contact and of the grid", ("quantity", "value", "unit"), rows)


def _groups(solution):
    result, line = solution.result, solution.mesh.is_line
    # Along the motion, which may not be x.
    radius = "R_x" if solution.contact.motion == (1.0, 0.0) else "R"
    load, power = (f"load/(E′{radius})", "-1/2") if line else (f"load/(E′{radius}²)", "-3/4")
    meanings = {
        "U": f"η₀u/(E′{radius})",
        "W": load,
        "G": "αE′",
        "M": f"W(2U)^({power}), of Moes",
        "L": "G(2U)^(1/4), of Moes",
    }
    rows = [(name, number(getattr(result.groups, name)), text) for name, text in meanings.items()]
    film, mark = f"film as (h/{radius})(2U)^(-1/2)", mark_of(result)
    rows += [
        ("H central", number(result.moes_film.central), marked(f"computed central {film}", mark)),
        ("H minimum", number(result.moes_film.minimum), marked(f"computed minimum {film}", mark)),
    ]
    what = (
        "Dimensionless groups" if radius == "R_x" else "Dimensionless groups, R the radius along the motion"
    )
    return table(what, ("quantity", "value", "meaning"), rows)


def work_section(solution):
    """What the run took."""
    result = solution.result
    rows = [
        ("convolutions, in those of the finest grid", number(result.work.convolutions)),
        ("Newton steps or sweeps on all grids", number(result.work.steps)),
        ("wall time, s", number(result.wall_s, 4)),
        ("ranks", str(result.ranks)),
    ]
    return Section("work", "Work and time", (table("What the run took", ("quantity", "value"), rows),))
