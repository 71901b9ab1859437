"""Answers: records with fields, tables with columns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Dict, Iterator, List, Mapping, Type

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    import xarray as xr


class Error(Exception):
    """What could not be computed, and why, in the line of the program."""


class InputError(Error, ValueError):
    """Wrong input: what is wrong with it, and what is allowed."""


class IncompleteWarning(UserWarning):
    """An answer that is incomplete, or rests on a condition that fails."""


class Record:
    """Named values: ``record.name``, ``record["name"]``, ``dict(record)``."""

    def __init__(self, fields: Mapping[str, Any]) -> None:
        self._fields = fields

    def keys(self) -> List[str]:
        return list(self._fields)

    def __getitem__(self, name: str) -> Any:
        return self._fields[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._fields:
            raise AttributeError(f"{type(self).__name__} has no {name}; it has {', '.join(self.keys())}")
        return self[name]

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self.keys()]

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={_short(self[name])}" for name in self.keys())
        return f"{type(self).__name__}({fields})"


class Table:
    """Rows in columns: ``table.name`` is an array over all rows, ``table[3]`` a record, ``table[table.stable]`` a table.

    A number that does not exist is NaN. Columns that belong together are a table within it.
    """

    def __init__(self, columns: Mapping[str, Any]) -> None:
        self._columns = columns

    def keys(self) -> List[str]:
        return list(self._columns)

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def __iter__(self) -> Iterator[Record]:
        return (self[index] for index in range(len(self)))

    def __getitem__(self, which: Any) -> Any:
        if isinstance(which, str):
            return self._columns[which]
        part = {name: column[which] for name, column in self._columns.items()}
        return Record(part) if hasattr(which, "__index__") else type(self)(part)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._columns:
            raise AttributeError(f"no column {name}; there are {', '.join(self.keys())}")
        return self._columns[name]

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self.keys()]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self)} rows: {', '.join(self.keys())})"

    def flat(self) -> Dict[str, "np.ndarray"]:
        """All columns, those of tables within it too, the two ends of an interval as ``name_lower`` and ``name_upper``."""
        flat: Dict[str, Any] = {}
        for name, column in self._columns.items():
            if isinstance(column, Table):
                inner = column.flat()
                flat.update({(f"{name}_{own}" if own in self._columns else own): it for own, it in inner.items()})
            elif column.ndim == 2:
                ends = ("lower", "upper") if column.shape[1] == 2 else range(column.shape[1])
                flat.update({f"{name}_{end}": column[:, index] for index, end in enumerate(ends)})
            else:
                flat[name] = column
        return flat

    def to_dataframe(self) -> "pd.DataFrame":
        """As a pandas DataFrame, a row for each row."""
        import pandas

        return pandas.DataFrame(self.flat())

    def to_xarray(self) -> "xr.Dataset":
        """As an xarray Dataset along the dimension ``row``."""
        import xarray

        return xarray.Dataset({name: ("row", column) for name, column in self.flat().items()})


class Answer(Record):
    """An answer. ``provenance`` says what computed it, and the command line that does so again; ``cost`` the effort.

    It has the fields of the program's JSON document, lists of rows as tables.
    """

    parameters: Record
    cost: Record
    provenance: Record
    _kinds: ClassVar[Dict[str, Type[Table]]] = {}

    def __init__(self, found: Any) -> None:
        self._found = found

    @property
    def _fields(self) -> Mapping[str, Any]:  # type: ignore[override]
        # Made when somebody looks at it.
        made = self.__dict__.get("_made")
        if made is None:
            made = self._made = dict(self._found.document()._fields)
            for name in self._kinds.keys() & made.keys():
                kind, found = self._kinds[name], made[name]
                # A list without rows does not say of what.
                columns = found._columns if isinstance(found, Table) else dict.fromkeys(kind.__annotations__, found)
                made[name] = kind(columns)
        return made

    def __reduce__(self) -> Any:
        return _read, (type(self), self._fields)


def _read(kind: Type[Answer], fields: Dict[str, Any]) -> Answer:
    answer = kind(None)
    answer._made = fields
    return answer


def _short(value: Any) -> str:
    shape = getattr(value, "shape", None)
    return repr(value) if shape is None or value.size <= 4 else f"<array {shape}>"
