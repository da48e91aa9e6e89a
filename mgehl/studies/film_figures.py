"""Pictures of studies schemes and methods."""

from mgehl.output.pictures.style import COLOURS, MARKS, subplots


def schemes(nodes, films):
    """Central and minimum film against the spacing, a line for each scheme."""
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
    return figure


def histories(cases):
    """True residual against convolutions, by both methods."""
    figure, panels = subplots(1, len(cases), size=(4.2 * len(cases), 3.9), squeeze=False)
    for panel, (name, methods) in zip(panels[0], cases.items(), strict=True):
        for (method, rows), colour in zip(methods.items(), COLOURS, strict=False):
            finest = [row for row in rows if row["grid"] == rows[-1]["grid"]]
            work = [max(row["convolutions"], 1.0) for row in finest]
            panel.plot(work, [row["residual"] for row in finest], color=colour, label=method)
        panel.set(xscale="log", yscale="log", xlabel="fine-grid convolutions", title=name)
    panels[0, 0].set_ylabel("true residual (rms)")
    panels[0, 0].legend(frameon=False)
    return figure
