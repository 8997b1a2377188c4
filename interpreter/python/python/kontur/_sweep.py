"""One program with all combinations of parameters: on this machine, on a Dask cluster, or on Ray."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import lru_cache
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _kontur
from ._errors import UsageError
from ._table import Table
from ._words import Options, Settings, StrPath, program_words, text_of, words_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

Grid = Mapping[str, str | float | Iterable[str | float]]
"""Keys and their values: ``{"X.getriebe[0].kv": range(1000, 5000, 500), "*.vib_guard.mode": "1..4"}``."""

_Rows = tuple[list[str], list[list[float | str]]]

_CHUNK_S = 1.0
"""Duration of a task: much longer than its distribution takes, much shorter than a loss that would hurt."""


def sweep(
    program: StrPath,
    grid: Grid,
    *,
    client: Any = None,
    output: StrPath | None = None,
    columns: Iterable[str] = (),
    amplitude: Iterable[str] = (),
    retries: int = 2,
    machine: StrPath | None = None,
    settings: Settings | None = None,
    **options: Unpack[Options],
) -> Table:
    """Runs a program with all combinations; the table of ``kontur sweep``, in its order, whichever worker computed what.

    ``grid``: list parameters (or ``V.E.NAME``) with their values, or ranges as on the command line (``"20..60:10"``).
    ``client``: None for the cores of this machine, a ``distributed.Client``, or the module ``ray`` (initialised).
    Workers read program and lists themselves: the paths must lead to the same files there.
    ``output``: a folder for a Parquet data set with a subfolder per value of each key of the grid; it must be empty.
    ``columns``, ``amplitude``: as for ``kontur sweep``.
    ``retries``: how often a failed task is repeated; the loss of a worker is handled by the engine.

    A run that ends with an error has a row with its ID. A key whose values make no difference is named in a warning and
    in the column ``without_effect``. Raises what :func:`run` raises if one cannot be started.
    """
    if not grid:
        raise UsageError("grid: at least one key with its values is expected")
    vary = [f"--vary={key}={_values(values)}" for key, values in grid.items()]
    wanted = words_of({"columns": _list(columns), "amplitude": _list(amplitude)})
    program = os.path.abspath(program)
    machine = None if machine is None else os.path.abspath(machine)
    words = (*vary, *wanted, *program_words(program, machine, settings, options))
    plan = _plan(words)
    if output is not None:
        _must_be_empty(output)
        # missing, it must not cost the rows of hours
        import pyarrow.dataset  # noqa: F401
    try:
        table = _run(words, plan, client, retries)
    except BaseException:
        # one that Ctrl-C has stopped runs no more
        _plan.cache_clear()
        raise
    if output is not None:
        _write(table, plan.keys(), output)
    return table


def _list(names: Iterable[str]) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def _values(values: Any) -> str:
    if isinstance(values, str) or not isinstance(values, Iterable):
        return text_of(values)
    several = [text_of(value) for value in values]
    if any("," in value for value in several):
        raise UsageError("grid: a value must not contain a comma")
    return ",".join(several)


@lru_cache(maxsize=1)
def _plan(words: tuple[str, ...]) -> _kontur.SweepPlan:
    """The plan, which is the same on every machine, built once per worker."""
    return _kontur.SweepPlan(list(words))


def _rows(words: tuple[str, ...], numbers: range) -> _Rows:
    """A task: some runs, one after the other."""
    plan = _plan(words)
    header: list[str] = []
    rows = []
    for number in numbers:
        header, row = plan.row(number)
        rows.append(row)
    return header, rows


def _run(words: tuple[str, ...], plan: _kontur.SweepPlan, client: Any, retries: int) -> Table:
    # the first run is done here: what is wrong with all of them shows at once, and how long one takes
    begun = perf_counter()
    header, first = plan.row(0)
    size = max(1, round(_CHUNK_S / max(perf_counter() - begun, 1e-6)))
    rows: list[list[float | str]] = [first] + [[]] * (len(plan) - 1)
    chunks = [range(at, min(at + size, len(plan))) for at in range(1, len(plan), size)]
    for chunk, (_, done) in _engine(client)(words, chunks, client, retries):
        rows[chunk.start : chunk.stop] = done
    if without := plan.without_effect(rows):
        header.append(_kontur.WITHOUT_EFFECT)
        rows = [[*row, " ".join(without)] for row in rows]
        for key in without:
            warnings.warn(f"{key}: {_kontur.NO_DIFFERENCE}", stacklevel=3)
    return Table({name: _column([row[i] for row in rows]) for i, name in enumerate(header)})


def _column(values: list[float | str]) -> np.ndarray[Any, Any]:
    # a column with a word in it is one of words
    if any(isinstance(value, str) for value in values):
        return np.array([text_of(value) for value in values])
    return np.array(values, dtype=np.float64)


_Done = Iterator[tuple[range, _Rows]]


def _engine(client: Any) -> Callable[[tuple[str, ...], list[range], Any, int], _Done]:
    if client is None:
        return _local
    if getattr(client, "__name__", None) == "ray":
        return _ray
    if hasattr(client, "submit") and hasattr(client, "gather"):
        return _dask
    raise UsageError("client: None, a distributed.Client or the module ray is expected")


def _local(words: tuple[str, ...], chunks: list[range], _: Any, retries: int) -> _Done:
    plan = _plan(words)
    # a run that fails here fails again: nothing is tried twice
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        futures = {pool.submit(_rows, words, chunk): chunk for chunk in chunks}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        except BaseException:
            plan.stop()
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def _dask(words: tuple[str, ...], chunks: list[range], client: Any, retries: int) -> _Done:
    from distributed import as_completed as completed

    futures = client.map(lambda chunk: _rows(words, chunk), chunks, retries=retries, pure=False)
    of = {future.key: chunk for future, chunk in zip(futures, chunks)}
    try:
        for future, result in completed(futures, with_results=True):  # type: ignore[no-untyped-call, unused-ignore]
            yield of[future.key], result
    finally:
        client.cancel(futures)


def _ray(words: tuple[str, ...], chunks: list[range], ray: Any, retries: int) -> _Done:
    task = ray.remote(_rows).options(max_retries=retries, retry_exceptions=True)
    of = {task.remote(words, chunk): chunk for chunk in chunks}
    left = list(of)
    try:
        while left:
            (done,), left = ray.wait(left)
            yield of[done], ray.get(done)
    finally:
        for reference in left:
            ray.cancel(reference)


def _must_be_empty(folder: StrPath) -> None:
    if os.path.exists(folder) and (not os.path.isdir(folder) or os.listdir(folder)):
        raise FileExistsError(f"{os.fspath(folder)}: the folder of a data set has to be empty")


def _write(table: Table, keys: list[str], folder: StrPath) -> None:
    from pyarrow import dataset

    arrow = table.to_arrow()
    by = dataset.partitioning(arrow.select(keys).schema, flavor="hive")
    dataset.write_dataset(
        arrow,
        folder,
        format="parquet",
        partitioning=by,
        # every combination is one
        max_partitions=max(1024, len(table)),
        existing_data_behavior="error",
    )
