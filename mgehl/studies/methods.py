"""Newton with multigrid compared with the paper's relaxation, and the interface conditions with the unified
equations."""

from mgehl.output.pictures.style import COLOURS, subplots
from mgehl.studies.columns import broken, told
from mgehl.studies.study import PAPER, merged, papers_grid

TOLERANCE = 1e-6
"""True residual that both methods are asked for."""

FROM_CONTACT = {"solver": {"start": "contact"}}

CASES = {
    "1 m/s, 65 nodes": {"motion": {"speed": 1.0}, "grid": papers_grid(65)},
    "1 m/s, 129 nodes": {"motion": {"speed": 1.0}, "grid": papers_grid(129)},
    "0.005 mm/s, 257 nodes": {"motion": {"speed": 5e-6}, "grid": papers_grid(257), **FROM_CONTACT},
}
SWEEPS = {"1 m/s, 65 nodes": 60000, "1 m/s, 129 nodes": 300000, "0.005 mm/s, 257 nodes": 20000}
"""At the most; a sweep is one convolution."""

MODEL_CASES = {
    "1 m/s, 129 nodes": CASES["1 m/s, 129 nodes"],
    "20 mm/s, 257 nodes": {"motion": {"speed": 0.02}, "grid": papers_grid(257)},
    "0.1 mm/s, 257 nodes": {"motion": {"speed": 1e-4}, "grid": papers_grid(257), **FROM_CONTACT},
}


def run(study):
    """Solve all; write tables `methods` and `models` and the picture `histories`."""
    study.expected = 2 * len(CASES) + 2 * len(MODEL_CASES)
    rows, histories = [], {}
    for name, case in CASES.items():
        pair = {method: _solve(study, name, case, method) for method in ("newton-mg", "relaxation")}
        rows += _method_rows(name, pair)
        histories[name] = {method: solution.rows for method, solution in pair.items()}
    study.write_table("methods", rows)
    study.write_table("models", list(_model_rows(study)))
    study.draw("histories", figure, histories)


def _solve(study, name, case, method):
    how = {"solver": {"method": method, "tolerance": TOLERANCE}, "relaxation": {"max_sweeps": SWEEPS[name]}}
    # Whether the relaxation gets there is what the study asks.
    by_newton = method == "newton-mg"
    return study.solve(f"{method}, {name}", merged(PAPER, case, how), by_newton)


def _method_rows(name, pair):
    """A row for each method; the ratio is of convolutions, the relaxation's to Newton's."""
    least = pair["newton-mg"].result.work.convolutions
    for method, solution in pair.items():
        result, last = solution.result, solution.rows[-1]
        errors = {"e^p": "e_p", "e^p lubr.": "e_p_lubr", "e^p solid": "e_p_solid"}
        yield {
            "case": name,
            "method": method,
            **told(
                result, "converged, residual, load error, central nm:.5f, minimum nm:.5f, contact nodes"
            ),
            **{head: f"{last[each]:.1e}" if each in last else "" for head, each in errors.items()},
            "steps or sweeps": str(result.work.steps),
            **told(result, "convolutions"),
            "ratio": f"{result.work.convolutions / least:.0f}",
            **told(result, "wall s"),
        }


def _model_rows(study):
    """The interface conditions and the unified equations on the same cases."""
    cases = {
        f"{model}, {name}": merged(PAPER, case, {"discretization": {"contact_model": model}})
        for name, case in MODEL_CASES.items()
        for model in ("lcic", "unified")
    }
    for title, solution in study.solved(cases, must_converge=False):
        model, _, name = title.partition(", ")
        result = solution.result
        yield {
            "case": name,
            "contact model": model,
            "equations solved to": f"{result.residual:.1e}",
            **told(result, "central nm, minimum nm, contact nodes"),
            "nodes that overlap": str(result.overlap.nodes),
            "largest overlap nm": f"{result.overlap.largest_nm:.3f}",
            "Eq. 2 violations": broken(result.other_inequality),
            "verdict": result.reason,
        }


def figure(cases):
    """True residual against convolutions, by both methods."""
    figure, panels = subplots(1, len(cases), size=(4.2 * len(cases), 3.9), squeeze=False)
    for panel, (name, methods) in zip(panels[0], cases.items(), strict=True):
        for (method, rows), colour in zip(methods.items(), COLOURS, strict=False):
            finest = [row for row in rows if row["grid"] == rows[-1]["grid"]]
            work = [max(row["convolutions"], 1.0) for row in finest]
            panel.plot(work, [row["residual"] for row in finest], color=colour, label=method)
        panel.set(xscale="log", yscale="log", xlabel="fine-grid convolutions", title=name)
    panels[0, 0].set_ylabel("true residual (rms)")
    panels[0, 0].legend()
    return figure
