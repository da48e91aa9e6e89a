import numpy as np

from mgehl.output.pictures.comparison import compare_lines


def line_of(axes, label):
    (line,) = [line for line in axes.get_lines() if line.get_label() == label]
    return line


def test_lines_of_all_runs_in_GPa_and_nm(make_solution, drawn, check_texts):
    runs = [make_solution(nodes=33), make_solution(nodes=65)]
    figure = drawn(compare_lines, runs, ["coarse", "fine"])
    along, across, films_along, films_across = figure.axes
    for label, run in (("coarse", runs[0]), ("fine", runs[1])):
        i, j = run.mesh.centre
        GPa, nm = 1e-9 * run.pressure, 1e9 * run.film
        for axes, position, values in (
            (along, run.mesh.X, GPa[j]), (across, run.mesh.Y, GPa[:, i]),
            (films_along, run.mesh.X, nm[j]), (films_across, run.mesh.Y, nm[:, i]),
        ):  # fmt: skip
            np.testing.assert_allclose(line_of(axes, label).get_xydata().T, [position, values])
    check_texts(
        figure, "coarse", "fine", "Hertz", "pressure, GPa", "film thickness, nm", "X = x/a, a = 0.4108 mm",
        "centre lines, 0.005 mm/s, 800 N, 2 runs",
    )  # fmt: skip
