r"""How a result shows itself: one line, a formula or a short table, a picture, and tables for other libraries.

A result says ``rows()`` (its table) and ``headline()`` (its line); ``formulas()`` and ``picture()`` where it has them.
Everything else follows from these.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, ClassVar

from ridgeback.common.errors import InputError
from ridgeback.common.show.columns import OF_SIGNAL, QUANTITIES, Quantity
from ridgeback.common.show.optional import optional
from ridgeback.common.show.picture import Picture, drawn
from ridgeback.common.show.table_text import Row, html_table, latex_table


class Displayed:
    """What every result shows of itself; a dataclass that inherits it is declared with ``repr=False``."""

    INDEX: ClassVar[tuple[str, ...]] = ()
    """Columns of ``rows()`` that number them: the index of a DataFrame, the dimensions of a Dataset."""

    def rows(self) -> Sequence[Row]:
        """The result as a table, one mapping of column name to value per row."""
        raise NotImplementedError

    def headline(self) -> str:
        """The result in one line."""
        raise NotImplementedError

    def formulas(self) -> tuple[str, ...]:
        """Relations in LaTeX that say more than a table; none by default."""
        return ()

    def picture(self) -> Picture:
        """What is drawn of the result."""
        raise InputError(f"{type(self).__name__} has no picture of its own; draw its rows()")

    def own_units(self) -> Mapping[str, str]:
        """Units of columns that are known of this result beyond those of ``QUANTITIES``."""
        return {}

    def index(self) -> tuple[str, ...]:
        """The columns that number the rows."""
        return self.INDEX

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.headline()}>"

    def _repr_html_(self) -> str:
        """What a notebook shows: the line, then the formulas, else the first and last rows."""
        return f"<p>{escape(self.headline())}</p>{html_table(self.rows())}"

    def _repr_latex_(self) -> str | None:
        """The formulas, else the first and last rows, for a notebook that is turned into LaTeX."""
        found = self.formulas()
        if not found:
            return f"$\\displaystyle {latex_table(self.rows())}$"
        return "\n\n".join(f"$\\displaystyle {formula}$" for formula in found)

    def plot(self, ax: Any = None) -> Any:
        """Draw the result.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; new axes by default.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on, with labelled axes and units.
        """
        return drawn(self.picture(), ax)

    def quantities(self) -> dict[str, Quantity]:
        """Unit and meaning of each column of ``rows()``."""
        own = self.own_units()
        columns = list(self.rows()[0]) if self.rows() else []
        return {name: described(name, own.get(name)) for name in columns}

    def to_dataframe(self) -> Any:
        """The table as a pandas DataFrame.

        Returns
        -------
        pandas.DataFrame
            ``rows()`` with the numbering columns as index; ``attrs["units"]`` and ``attrs["meanings"]`` hold what each
            column is measured in and means.

        Raises
        ------
        ImportError
            Without pandas; the message says how to install it.
        """
        frame = optional("pandas", "to_dataframe").DataFrame(list(self.rows()))
        frame.attrs.update(title=self.headline(), **attributes(self.quantities()))
        index = [name for name in self.index() if name in frame.columns]
        return frame.set_index(index) if index else frame

    def to_xarray(self) -> Any:
        """The table as an xarray Dataset.

        Returns
        -------
        xarray.Dataset
            One variable per column over the numbering columns, with attributes ``units`` and ``long_name``.

        Raises
        ------
        ImportError
            Without xarray; the message says how to install it.
        """
        library, rows = optional("xarray", "to_xarray"), list(self.rows())
        axes = grid(rows, self.index())
        data = {
            name: library.Variable(tuple(axes), shaped([row[name] for row in rows], axes), described_as(quantity))
            for name, quantity in self.quantities().items()
            if name not in axes
        }
        coordinates = {
            name: library.Variable((name,), values, described_as(self.quantities().get(name, Quantity("1", name))))
            for name, values in axes.items()
        }
        return library.Dataset(data, coordinates, {"title": self.headline()})


def described(name: str, unit: str | None) -> Quantity:
    """Unit and meaning of a column; ``unit`` in place of the one that the table of quantities has.

    >>> described("amplitude", "mm")
    Quantity(unit='mm', meaning='amplitude')
    """
    known = QUANTITIES.get(name, Quantity("1", name))
    return known if not unit else known._replace(unit=unit)


def signal_units(unit: str) -> dict[str, str]:
    """The columns that are measured in the unit of the signal, when that is known.

    >>> signal_units("mm")["amplitude"], signal_units("")
    ('mm', {})
    """
    return {name: unit for name, quantity in QUANTITIES.items() if quantity.unit == OF_SIGNAL} if unit else {}


def described_as(quantity: Quantity) -> dict[str, str]:
    """The attributes of a variable, by the names of the CF conventions."""
    return {"units": quantity.unit, "long_name": quantity.meaning}


def attributes(quantities: Mapping[str, Quantity]) -> dict[str, dict[str, str]]:
    """Units and meanings by column."""
    return {
        "units": {name: quantity.unit for name, quantity in quantities.items()},
        "meanings": {name: quantity.meaning for name, quantity in quantities.items()},
    }


def grid(rows: Sequence[Row], index: tuple[str, ...]) -> dict[str, list[Any]]:
    """The axes that the rows run over, the last one fastest; one axis ``row`` where they fill no grid.

    >>> grid([{"n": 2, "A": 0.1}, {"n": 2, "A": 0.2}, {"n": 4, "A": 0.1}, {"n": 4, "A": 0.2}], ("n", "A"))
    {'n': [2, 4], 'A': [0.1, 0.2]}
    >>> grid([{"n": 2}, {"n": 2}], ("n",))
    {'row': [0, 1]}
    """
    axes = {name: list(dict.fromkeys(row[name] for row in rows)) for name in index}
    points: list[tuple[Any, ...]] = [()]
    for values in axes.values():
        points = [(*point, value) for point in points for value in values]
    filled = bool(index) and points == [tuple(row[name] for name in index) for row in rows]
    return axes if filled else {"row": list(range(len(rows)))}


def shaped(values: list[Any], axes: Mapping[str, list[Any]]) -> list[Any]:
    """Values in rows, rows in planes: nested as the axes are.

    >>> shaped([1, 2, 3, 4], {"n": [2, 4], "A": [0.1, 0.2]})
    [[1, 2], [3, 4]]
    """
    for axis in reversed(list(axes.values())[1:]):
        values = [values[i : i + len(axis)] for i in range(0, len(values), len(axis))]
    return values
