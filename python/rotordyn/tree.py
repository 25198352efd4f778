"""Results as named quantities: groups, tables and their NumPy arrays."""

from __future__ import annotations

from typing import Any, Iterator, Sequence, Union

import numpy as np
import numpy.typing as npt

__all__ = ["Group", "Table"]

Array = npt.NDArray[Any]
#: A field as the native part gives it: names in JSON and HDF5, kind, unit, factor to the JSON number, value.
Field = tuple[Union[str, None], Union[str, None], str, str, float, Any]


class _Quantity:
    """A value with the unit of its name."""

    __slots__ = ("axes", "unit", "value")

    def __init__(self, value: Any, unit: str, axes: Sequence[tuple[int, str]] = ()) -> None:
        self.value, self.unit, self.axes = value, unit, list(axes)


def _unit(name: str, unit: str) -> str:
    return "rpm" if unit == "rad/s" and name.endswith("_rpm") else unit


class Group:
    """Named quantities, as attributes or by ``group["name"]``.

    The names are those of the command's ``--json``, with the unit as suffix where it is not SI (``speed_rpm``,
    ``frequency_hz``), and those of the results file ``results.h5`` (``zeta``, ``omega``), which is in SI. ``unit(name)``
    is the unit of a name, ``dir(group)`` and ``keys()`` list the names, ``repr(group)`` shows names, shapes and units.
    """

    def __init__(self, fields: Sequence[Field]) -> None:
        self._found: dict[str, _Quantity] = {}
        self._primary: list[str] = []
        self._add(fields)

    def _add(self, fields: Sequence[Field]) -> None:
        # Names of the results file come second: a JSON name of another quantity is not replaced.
        second: list[tuple[str, _Quantity]] = []
        for json, hdf5, kind, unit, factor, value in fields:
            quantity, scaled = self._quantities(kind, unit, factor, value)
            first = json if json is not None else hdf5
            if first == "" and kind == "group":
                self._add(value)
                continue
            if first == "" and kind == "array":
                # In JSON `re` and `im` of the surrounding object.
                first = "values"
            if first:
                given = scaled if json is not None else quantity
                given.unit = _unit(first, unit)
                if first not in self._found:
                    self._primary.append(first)
                    self._found[first] = given
            if hdf5 and hdf5 != first:
                second.append((hdf5, quantity))
        for name, quantity in second:
            self._found.setdefault(name, quantity)

    def _quantities(self, kind: str, unit: str, factor: float, value: Any) -> tuple[_Quantity, _Quantity]:
        if kind == "array":
            data, axes = value
            plain = _Quantity(data, unit, axes)
            return plain, _Quantity(data * factor, unit, axes) if factor != 1.0 else _Quantity(data, unit, axes)
        if kind == "number":
            return _Quantity(value, unit), _Quantity(value * factor, unit)
        made = _made(kind, value)
        return _Quantity(made, unit), _Quantity(made, unit)

    def keys(self) -> list[str]:
        """Names of the quantities, without the second names of the results file."""
        return list(self._primary)

    def unit(self, name: str) -> str:
        """Unit of a quantity; "1" for numbers without, "" for texts and groups."""
        return self._of(name).unit

    def _of(self, name: str) -> _Quantity:
        found = self._found.get(name) if isinstance(name, str) else None
        if found is None:
            raise KeyError(_unknown(name, list(self._found)))
        return found

    def __getitem__(self, name: str) -> Any:
        return self._of(name).value

    def __contains__(self, name: object) -> bool:
        return name in self._found

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._of(name).value
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(name for name in self._found if name.isidentifier())})

    def __repr__(self) -> str:
        return _described(type(self).__name__, self)

    def to_dict(self) -> dict[str, Any]:
        """The quantities by their names, groups as dictionaries."""
        return {name: _plain(self._found[name].value) for name in self._primary}


class Table(Group):
    """Rows of the same columns: a column is ``table.name``, an array with the row as first dimension.

    ``table[k]`` is a row as a group, ``len(table)`` the number of rows; a table also iterates over its rows. A column may
    be a list of tables, one for each row.
    """

    def __init__(self, rows: int, axis: str | None, fields: Sequence[Field], first: int = 0) -> None:
        self._rows, self._axis = rows, axis
        self._fields = fields
        self._first = first
        super().__init__(fields)

    def _quantities(self, kind: str, unit: str, factor: float, value: Any) -> tuple[_Quantity, _Quantity]:
        here = slice(self._first, self._first + self._rows)
        if kind == "array":
            data, axes = value
            data = data[here]
            return super()._quantities(kind, unit, factor, (data, axes))
        if kind == "group":
            made: Any = Table(self._rows, None, value, self._first)
            return _Quantity(made, unit), _Quantity(made, unit)
        if kind == "table":
            counts, axis, columns = value
            starts = np.concatenate([[0], np.cumsum(counts)]).astype(int)
            tables = [_rows_of(int(counts[k]), axis, columns, int(starts[k])) for k in range(here.start, here.stop)]
            return _Quantity(tables, unit), _Quantity(tables, unit)
        return super()._quantities(kind, unit, factor, value)

    def __len__(self) -> int:
        return self._rows

    def __iter__(self) -> Iterator[Group]:
        return (self.row(k) for k in range(self._rows))

    def __getitem__(self, name: Any) -> Any:
        if isinstance(name, (int, np.integer)):
            return self.row(int(name))
        return super().__getitem__(name)

    def row(self, k: int) -> Group:
        """A row as a group; negative numbers count from the end."""
        at = k + self._rows if k < 0 else k
        if not 0 <= at < self._rows:
            raise IndexError(f"row {k} of a table of {self._rows} rows")
        row = Group([])
        for name, found in self._found.items():
            value = found.value.row(at) if isinstance(found.value, Table) else found.value[at]
            row._found[name] = _Quantity(value.item() if isinstance(value, np.generic) else value, found.unit)
        row._primary = list(self._primary)
        return row

    def to_pandas(self) -> Any:
        """The columns with one value a row as a pandas DataFrame; needs pandas."""
        pandas = _needed("pandas")
        columns = {}
        for name in self._primary:
            value = self._found[name].value
            if isinstance(value, np.ndarray) and value.ndim == 1:
                columns[name] = value
            elif isinstance(value, np.ndarray) and value.ndim == 2 and value.shape[1] <= 6:
                columns.update({f"{name}_{k + 1}": value[:, k] for k in range(value.shape[1])})
        return pandas.DataFrame(columns)


def _rows_of(rows: int, axis: str | None, fields: Sequence[Field], first: int) -> Any:
    """A table within a row; a list of values if its only column has no name."""
    if len(fields) == 1 and not fields[0][0] and fields[0][2] == "array":
        return fields[0][5][0][first : first + rows]
    return Table(rows, axis, fields, first)


def _made(kind: str, value: Any) -> Any:
    if kind == "group":
        return of_fields(value)
    if kind == "groups":
        return {name: of_fields(fields) for name, fields in value}
    if kind == "table":
        rows, axis, columns = value
        return Group(_first_row(columns)) if rows == -1 else Table(rows, axis, columns)
    return value


def _first_row(columns: Sequence[Field]) -> list[Field]:
    """The columns of a single record as values."""
    out: list[Field] = []
    for json, hdf5, kind, unit, factor, value in columns:
        if kind == "array":
            data, axes = value
            one = data[0]
            if isinstance(one, np.ndarray):
                out.append((json, hdf5, "array", unit, factor, (one, axes)))
            else:
                one = one.item() if isinstance(one, np.generic) else one
                out.append((json, hdf5, "number" if isinstance(one, float) else "value", unit, factor, one))
        elif kind == "group":
            out.append((json, hdf5, "group", unit, factor, _first_row(value)))
        elif kind == "table":
            counts, axis, fields = value
            out.append((json, hdf5, "table", unit, factor, (int(counts[0]), axis, fields)))
        else:
            out.append((json, hdf5, kind, unit, factor, value))
    return out


def of_fields(fields: Sequence[Field]) -> Any:
    """The group of a list of fields; of a table without a name, that table."""
    if len(fields) == 1 and fields[0][0] == "" and fields[0][2] == "table":
        return _made("table", fields[0][5])
    return Group(fields)


def _unknown(name: object, known: Sequence[str]) -> str:
    import difflib

    near = difflib.get_close_matches(str(name), known, 1)
    hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(known)}"
    return f"there is no {name!r}; {hint}"


def _needed(module: str, package: str = "") -> Any:
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = package or module
        raise ImportError(f"this needs the package {package}: pip install {package}") from error


def _plain(value: Any) -> Any:
    if isinstance(value, Group):
        return value.to_dict()
    if isinstance(value, dict):
        return {name: _plain(inner) for name, inner in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value


def _described(title: str, group: Group) -> str:
    rows = f" of {len(group)} rows" if isinstance(group, Table) else ""
    lines = [f"<{title}{rows}>"]
    for name in group.keys():
        quantity = group._found[name]
        value, unit = quantity.value, f" [{quantity.unit}]" if quantity.unit not in ("", "1") else ""
        if isinstance(value, np.ndarray):
            what = f"array {value.shape}"
        elif isinstance(value, Table):
            what = f"table of {len(value)} rows: {', '.join(value.keys())}"
        elif isinstance(value, Group):
            what = f"group: {', '.join(value.keys())}"
        elif isinstance(value, (list, dict)):
            what = f"{len(value)} items"
        else:
            what = repr(value)
        lines.append(f"  {name}: {what}{unit}")
    return "\n".join(lines)
