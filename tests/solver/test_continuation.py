import mgehl


def test_a_stage_on_the_way_is_no_answer_of_its_own():
    """A geometric mean whose first stage may make no step: judged by its own equations, and said."""
    settings = {"grid.nodes": 65, "motion.speed": 1.2, "solver.start": "film", "solver.max_steps": 0}
    solution = mgehl.solve(mgehl.load(None, settings | {"discretization.face_mobility": "geometric"}))
    result = solution.result
    assert not result.settled and not result.converged
    assert "a stage on the way (logarithmic mean" in result.reason and "was not found: " in result.reason
    assert solution.contact.speed == 1.2


def test_less_oil_passes_by_the_geometric_mean():
    """It takes a thicker film, by half on this grid, whose inlet has not two cells."""
    film = {"grid.nodes": 65, "grid.x": [-1.9, 1.3], "grid.y": [-1.5, 1.5], "motion.speed": 1.0}
    film |= {"discretization.couette": "1B", "solver.start": "film", "solver.error": False}
    means = ({"discretization.face_mobility": mean} for mean in ("geometric", "arithmetic"))
    geometric, arithmetic = (mgehl.solve(mgehl.load(None, film | mean)).result for mean in means)
    assert geometric.converged and geometric.central_film_nm > 1.3 * arithmetic.central_film_nm
