"""Columns of results, and their conversion to pandas, polars and Arrow."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow


class Words:
    """A column with few different words: for each row the number of its word."""

    def __init__(self, numbers: np.ndarray[Any, Any], words: list[str]) -> None:
        self.numbers, self.words = numbers, words

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray[Any, Any]:
        words: np.ndarray[Any, Any] = np.array(self.words or [""])[self.numbers]
        return words if dtype is None else words.astype(dtype)


def _same(a: np.ndarray[Any, Any], b: np.ndarray[Any, Any]) -> bool:
    masks = np.ma.getmaskarray(a), np.ma.getmaskarray(b)
    if not np.array_equal(*masks):
        return False
    a, b = (np.ma.getdata(column)[~mask] for column, mask in zip((a, b), masks))
    numbers = a.dtype.kind == "f" and b.dtype.kind == "f"
    return np.array_equal(a, b, equal_nan=numbers)


class Table:
    """Columns by name. ``table["duration_s"]`` is a numpy array, ``len(table)`` the number of rows."""

    def __init__(self, columns: dict[str, Any]) -> None:
        self._columns = columns
        self._words: dict[str, np.ndarray[Any, Any]] = {}

    @property
    def columns(self) -> dict[str, np.ndarray[Any, Any]]:
        """All columns as numpy arrays, in the order of the table."""
        return {name: self[name] for name in self._columns}

    def __getitem__(self, name: str) -> np.ndarray[Any, Any]:
        column = self._columns[name]
        if isinstance(column, np.ndarray):
            return column
        if name not in self._words:
            self._words[name] = np.asarray(column)
        return self._words[name]

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        """The names of the columns."""
        return iter(self._columns)

    def __len__(self) -> int:
        for column in self._columns.values():
            return len(column.numbers if isinstance(column, Words) else column)
        return 0

    def __eq__(self, other: object) -> bool:
        """Whether both have the same columns in the same order with the same values, missing ones included."""
        if not isinstance(other, Table):
            return NotImplemented
        names = list(self._columns)
        return names == list(other._columns) and all(
            _same(self[name], other[name]) for name in names
        )

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} rows, {', '.join(self._columns)}>"

    def to_arrow(self) -> pyarrow.Table:
        """The columns as an Arrow table, with the types of the Parquet file that ``kontur run`` writes."""
        import pyarrow

        def array(column: Any) -> Any:
            if isinstance(column, Words):
                numbers = pyarrow.array(column.numbers.astype(np.int32))
                words = pyarrow.array(column.words, pyarrow.string())
                return pyarrow.DictionaryArray.from_arrays(numbers, words)
            if isinstance(column, np.ma.MaskedArray):
                return pyarrow.array(column.data, mask=np.ma.getmaskarray(column))
            return pyarrow.array(column)

        arrays = [array(column) for column in self._columns.values()]
        return pyarrow.table(arrays, names=list(self._columns))

    def to_pandas(self) -> pandas.DataFrame:
        """The columns as a data frame; words are categories, missing block numbers are ``<NA>``."""
        import pandas

        def series(column: Any) -> Any:
            if isinstance(column, Words):
                return pandas.Categorical.from_codes(column.numbers, column.words)
            if isinstance(column, np.ma.MaskedArray):
                missing = np.ma.getmaskarray(column).copy()
                return pandas.arrays.IntegerArray(column.data.copy(), missing)
            return column

        return pandas.DataFrame({name: series(column) for name, column in self._columns.items()})

    def to_polars(self) -> polars.DataFrame:
        """The columns as a polars data frame."""
        import polars

        frame = polars.from_arrow(self.to_arrow())
        assert isinstance(frame, polars.DataFrame)
        return frame
