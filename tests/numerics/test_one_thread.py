"""Linear algebra of films has one thread, and gives the others back."""

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from loadflow.journal import JournalBearing, Lubricant
from loadflow.journal.film.film import DiscreteFilm
from loadflow.numerics.one_thread import on_one_thread


def threads():
    return {one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"}


def test_a_film_is_solved_on_one_thread_and_the_others_come_back(monkeypatch):
    seen, linearise = [], DiscreteFilm.linearise

    def watched(self, *args, **kwargs):
        seen.append(threads())
        return linearise(self, *args, **kwargs)

    monkeypatch.setattr(DiscreteFilm, "linearise", watched)
    bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    on_one_thread(threads)()  # SciPy's library is there
    with threadpool_limits(2, user_api="blas"):
        assert threads() == {2}
        bearing.equilibrium((1e4, 0.0), 10.0, Lubricant(0.03), grid=(24, 8), tilt=(1e-5, 0.0))
        assert threads() == {2}
    assert seen
    assert all(one == {1} for one in seen)


def test_an_error_gives_the_threads_back():
    def fails():
        assert threads() == {1}
        raise ValueError("no film")

    on_one_thread(threads)()
    with threadpool_limits(2, user_api="blas"):
        with pytest.raises(ValueError, match="no film"):
            on_one_thread(fails)()
        assert threads() == {2}
