# SPDX-License-Identifier: BSD-3-Clause
"""Keyword options onto the Set methods of a wrapped class, whose defaults they leave alone."""

import difflib
import operator
import re

import numpy as np
from vtkmodules.vtkCommonCore import VTK_DOUBLE_MAX

_OBJECTS = {"Controller", "ParametricFunction"}  # have a Set and a Get method, and are no options


def snake_case(name):
    """snake_case of a CamelCase name."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def option_names(algorithm_class):
    """{snake_case name: CamelCase name} of what the class itself can set and get."""
    own = vars(algorithm_class)
    names = (name[3:] for name in own if name.startswith("Set") and "Get" + name[3:] in own)
    return {snake_case(name): name for name in sorted(names) if name not in _OBJECTS}


def enumeration_methods(algorithm_class, name):
    """{plain lower-case name of a value: method that sets it}, empty for other options."""
    prefix = f"Set{name}To"
    return {
        method[len(prefix):].lower(): method
        for method in vars(algorithm_class)
        if method.startswith(prefix)
    }


def set_options(algorithm, options, function):
    """Sets options by keyword.

    Raises TypeError for an option that does not exist or a value of the wrong type, ValueError for
    a value outside the range that the class takes.
    """
    names = option_names(type(algorithm))
    for option, value in options.items():
        if option not in names:
            near = difflib.get_close_matches(option, names, n=3, cutoff=0.5)
            hint = "near ones: " + ", ".join(near) if near else "options: " + ", ".join(names)
            raise TypeError(f"{function}() has no option '{option}'; {hint}")
        _set_option(algorithm, option, names[option], value)


def _set_option(algorithm, option, name, value):
    methods = enumeration_methods(type(algorithm), name)
    if methods and isinstance(value, str):
        method = methods.get(re.sub(r"[^a-z0-9]", "", value.lower()))
        if method is None:
            known = ", ".join(m[len(f"Set{name}To"):] for m in methods.values())
            raise ValueError(f"{option} = '{value}' is none of {known}")
        getattr(algorithm, method)()
        return
    get = getattr(algorithm, "Get" + name)
    value = _converted(option, value, get())
    getattr(algorithm, "Set" + name)(value)
    taken = get()
    # The class moves a number into its range in silence; here that would hide a slip.
    if not _same(value, taken):
        raise ValueError(f"{option} = {value} is out of range; the nearest that is not is {taken}")


def _converted(option, value, present):
    """`value` as the type of the present one."""
    try:
        if isinstance(value, str) != isinstance(present, str):
            raise TypeError
        if isinstance(present, bool):
            if isinstance(value, (bool, np.bool_)) or value in (0, 1):
                return bool(value)
            raise TypeError
        if isinstance(present, tuple):
            number = operator.index if isinstance(present[0], int) else float
            numbers = tuple(number(v) for v in value)
            if len(numbers) != len(present):
                raise ValueError(
                    f"{option} has {len(numbers)} values; {len(present)} are needed"
                )
            return numbers
        if isinstance(present, int):
            return operator.index(value)
        if isinstance(present, float):
            return float(value)
        return value
    except TypeError:
        kind = "sequence of numbers" if isinstance(present, tuple) else type(present).__name__
        raise TypeError(f"{option} = {value!r} is no {kind}") from None


def _same(value, taken):
    if value == np.inf:
        return taken == VTK_DOUBLE_MAX  # stands for "no limit"
    if isinstance(value, str):
        return value == taken
    return np.array_equal(value, taken, equal_nan=True)
