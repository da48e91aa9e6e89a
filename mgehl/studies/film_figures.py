"""Pictures of the studies of films and methods."""

from mgehl.output.pictures.style import COLOURS, MARKS, applied, save, subplots

PERCENT = (0.1, 0.2, 0.5, 1, 2, 5, 10)
"""Numbers that are marked on a logarithmic axis."""


def schemes(path, nodes, films):
    """Central and minimum film against the spacing, a line for each scheme."""
    with applied():
        figure, panels = subplots(1, 2, size=(10.5, 4.2))
        for panel, which, title in zip(panels, (0, 1), ("central film", "minimum film"), strict=True):
            for (scheme, values), colour, mark in zip(films.items(), COLOURS, MARKS, strict=False):
                heights = [value[which] for value in values]
                spacing = [1.0 / (n - 1) for n in nodes]
                panel.plot(spacing, heights, mark + "-", color=colour, markersize=4, label=scheme)
            panel.set(xlabel="spacing over length of the domain", ylabel="film, nm", title=title)
            panel.set_xlim(left=0.0)
        panels[1].legend(frameon=False)
        figure.suptitle("Point contact at 1 m/s by every differential scheme")
        save(figure, path)


def line(path, rows):
    """Central and minimum film over the formulas' against speed, a line for each pressure."""
    with applied():
        figure, panels = subplots(1, 2, size=(10.5, 4.2))
        pressures = list(dict.fromkeys(row["p_h GPa"] for row in rows))
        for panel, film in zip(panels, ("central", "minimum"), strict=True):
            for pressure, colour, mark in zip(pressures, COLOURS, MARKS, strict=False):
                own = [row for row in rows if row["p_h GPa"] == pressure and row["converged"] == "yes"]
                speeds = [float(row["speed mm/s"]) for row in own]
                ratio = [float(row[f"{film} nm"]) / float(row[f"{film} formula nm"]) for row in own]
                panel.plot(speeds, ratio, mark + "-", color=colour, markersize=4, label=f"{pressure} GPa")
            panel.axhline(1.0, color="0.8", linewidth=0.8, zorder=0)
            panel.set(xscale="log", xlabel="speed, mm/s", ylabel="film over formula", title=f"{film} film")
        panels[1].legend(frameon=False)
        figure.suptitle("Line contact over formulas of the Dowson-Higginson type")
        save(figure, path)


def inlet(path, rows):
    """Central film and the pressure ratio beside the interface against the cells in the inlet."""
    with applied():
        figure, (films, ratios) = subplots(1, 2, size=(10.5, 4.6))
        for speed, colour in zip(dict.fromkeys(row["speed mm/s"] for row in rows), COLOURS, strict=False):
            own = [row for row in rows if row["speed mm/s"] == speed]
            for start, mark in (("film", "o"), ("contact", "x")):
                label = f"{speed} mm/s, from {start}"
                films.plot(*_points(own, f"central nm from {start}"), mark, color=colour, label=label)
                ratios.plot(*_points(own, f"p_f/p_d from {start}"), mark, color=colour, label=label)
        films.set(xscale="log", xlabel="cells in the inlet", ylabel="central film, nm (0: contact)")
        ratios.axhline(1.0, color="0.6", linewidth=0.8, zorder=0)
        ratios.set(xscale="log", yscale="log", xlabel="cells in the inlet", xlim=films.get_xlim())
        ratios.set_ylabel("p$_f$/p$_d$ beside the interface")
        for axes in (films, ratios):
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2, frameon=False)
        figure.suptitle("Line contact, 2.26 GPa: what the grid decides")
        save(figure, path)


def _points(rows, column):
    """Cells and numbers of the rows that have a number there."""
    numbers = [row for row in rows if row[column]]
    return _cells(numbers), [float(row[column]) for row in numbers]


def angles(path, circle, ellipse):
    """A circle's distance from its film at 0 degrees against the spacing; an ellipse's films against the
    angle."""
    with applied():
        figure, (off, films) = subplots(1, 2, size=(10.5, 4.6))
        turned = [row for row in circle if row["angle"] != "0"]
        kinds = dict.fromkeys((row["couette"], row["angle"]) for row in turned)
        for (couette, angle), colour, mark in zip(kinds, COLOURS, MARKS, strict=False):
            own = [row for row in turned if (row["couette"], row["angle"]) == (couette, angle)]
            spacing = [1.0 / (int(row["nodes"]) - 1) for row in own]
            percent = [abs(float(row["in %"])) for row in own]
            off.loglog(
                spacing, percent, mark + "-", color=colour, markersize=4, label=f"{couette}, {angle}°"
            )
        spacing = {1.0 / (int(row["nodes"]) - 1): row["nodes"] for row in turned}
        off.set_xticks(list(spacing), labels=list(spacing.values()))
        off.minorticks_off()
        off.set_yticks(PERCENT, labels=[f"{each:g}" for each in PERCENT])
        off.set(xlabel="nodes along a side", ylabel="off the film of 0°, %")
        off.set_title("circular contact, central film")
        for film, colour in zip(("central", "minimum"), COLOURS, strict=False):
            for source, style in (("", "o-"), (" Chittenden", "--"), (" Hamrock-Dowson", ":")):
                heights = [float(row[f"{film}{source} nm"]) for row in ellipse]
                label = f"{film},{source}" if source else f"{film}, computed"
                degrees = [float(row["angle"]) for row in ellipse]
                films.plot(degrees, heights, style, color=colour, markersize=4, label=label)
        films.set(xlabel="angle of the motion to x, degrees", ylabel="film, nm", ylim=(0.0, None))
        films.set_title("ellipse of 4 to 1, long along y")
        for axes in (off, films):
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, frameon=False)
        save(figure, path)


def histories(path, cases):
    """True residual against convolutions, by both methods."""
    with applied():
        figure, panels = subplots(1, len(cases), size=(4.2 * len(cases), 3.9), squeeze=False)
        for panel, (name, methods) in zip(panels[0], cases.items(), strict=True):
            for (method, rows), colour in zip(methods.items(), COLOURS, strict=False):
                finest = [row for row in rows if row["grid"] == rows[-1]["grid"]]
                work = [max(row["convolutions"], 1.0) for row in finest]
                panel.plot(work, [row["residual"] for row in finest], color=colour, label=method)
            panel.set(xscale="log", yscale="log", xlabel="fine-grid convolutions", title=name)
        panels[0, 0].set_ylabel("true residual (rms)")
        panels[0, 0].legend(frameon=False)
        save(figure, path)


def _cells(rows):
    return [float(row["inlet cells"]) for row in rows]
