"""kontur: a headless simulator of the ISG / TwinCAT 3 CNC kernel.

An NC program goes in, the setpoints that a control would send to its axes come out, cycle by cycle::

    import kontur

    run = kontur.run("part.nc", machine="machines/mill", settings={"X.getriebe[0].kv": 5000})
    run["X_set_mm"], run.units["X_set_mm"], run.summary["duration_s"]
    run.to_pandas()

Options have the names of the command line's (``kontur run --help``): ``--max-time 5`` is ``max_time=5``, a switch is
``True``, an option that may be given several times is a list.
"""

from importlib.metadata import version

from ._answers import Tuning, check, explain, response, tune
from ._errors import Error, InputsError, ListsError, ProgramError, UsageError
from ._messages import Diagnostic
from ._result import Run
from ._run import DEFAULT_SIGNALS, Simulation, run, start
from ._sweep import sweep
from ._table import Table

__version__ = version("kontur")

__all__ = [
    "DEFAULT_SIGNALS",
    "Diagnostic",
    "Error",
    "InputsError",
    "ListsError",
    "ProgramError",
    "Run",
    "Simulation",
    "Table",
    "Tuning",
    "UsageError",
    "check",
    "explain",
    "response",
    "run",
    "start",
    "sweep",
    "tune",
]
