"""Every array of every public function is damaged in every way: the call answers, or refuses it by InvalidInput."""

import numpy as np
import pytest
from array_calls import arrays_of, calls_of, modules

import chasles

FIRST = {  # by what the first entry is replaced
    "nan": np.nan, "inf": np.inf, "huge": 1e308, "tiny": 5e-324, "none": None, "text": "1", "complex": 1j, "whole": 10**400,
}  # fmt: skip


def with_first(array, entry):
    result = np.array(array, object)
    result.flat[0] = entry
    return result.tolist()


def masked(array):
    hidden = np.zeros(np.shape(array), bool)
    hidden.flat[-1] = True
    return np.ma.array(array, mask=hidden)


WAYS = {name: lambda array, entry=entry: with_first(array, entry) for name, entry in FIRST.items()} | {
    "masked": masked,
    "masked constant": lambda array: with_first(array, np.ma.masked),
    "deeper": lambda array: [array, array],
    "ragged": lambda array: [*np.asarray(array).tolist(), [0, 0]],
    "longer": lambda array: np.concatenate([array, array], axis=-1),
    "shorter": lambda array: np.asarray(array)[..., :-1],
    "empty": lambda array: [],
    "one number": lambda array: 3.0,
    "nothing like it": lambda array: {"a": 1},
    "a word": lambda array: "abc",
    "all infinite": lambda array: np.full(np.shape(array), np.inf),
    "all zero": lambda array: np.zeros(np.shape(array)),
    "dates": lambda array: np.zeros(np.shape(array), "datetime64[s]"),
}
REFUSED = ("none", "text", "complex", "whole", "masked", "masked constant", "ragged", "nothing like it", "a word", "dates")
MODULES = modules()
CASES = [(module, name) for module in MODULES for name in calls_of(module)]


@pytest.mark.parametrize("module, name", CASES, ids=[".".join(case) for case in CASES])
def test_damaged_arrays_are_refused(module, name):
    call, arrays = calls_of(module)[name]()
    call(**arrays)  # without damage
    for parameter, array in arrays.items():
        for way, damage in WAYS.items():
            call, _ = calls_of(module)[name]()
            try:
                call(**arrays | {parameter: damage(array)})
            except chasles.InvalidInput as error:
                assert "\n" not in str(error), (parameter, way, error)
                assert "is masked" in str(error) or not way.startswith("masked"), (parameter, way, error)
            else:
                assert way not in REFUSED, f"{parameter}: {way} is accepted"


@pytest.mark.parametrize("module", MODULES)
def test_no_function_is_forgotten(module):
    given = arrays_of(MODULES[module])
    asked = {(name, parameter) for name, make in calls_of(module).items() for parameter in make()[1]}
    assert given <= asked, sorted(given - asked)
