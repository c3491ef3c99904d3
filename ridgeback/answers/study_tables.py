"""The cells of a study as Parquet, NetCDF and Zarr: libraries that not everybody has, asked for by name."""

from __future__ import annotations

import io
import shutil
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ridgeback.common.errors import InputError
from ridgeback.common.show.optional import MissingLibraryError, optional
from ridgeback.console.output import STDOUT, write_bytes

if TYPE_CHECKING:
    from ridgeback.compare.studies.result import StudyResult

AT_ONCE = 50_000
"""Cells in a group of rows."""
FORMATS = ("parquet", "netcdf", "zarr")


def check_table(style: str, output: str) -> None:
    """Refuse a form whose library is missing, and a folder on the screen, before the work."""
    if output == STDOUT:
        raise click.UsageError(f"--format {style} is no text; name a file with -o")
    if style == "zarr" and Path(output).exists():
        raise click.UsageError(f"{output} exists already; a Zarr store is a new folder, nothing is replaced")
    for library in NEEDED[style]:
        needed(library, style)


NEEDED: Mapping[str, tuple[str, ...]] = {
    "parquet": ("pyarrow",),
    "netcdf": ("xarray", "h5netcdf"),
    "zarr": ("xarray", "zarr"),
}


def needed(library: str, style: str) -> Any:
    """A library, or one line on how to get it."""
    try:
        return optional(library, f"--format {style}")
    except MissingLibraryError as error:
        raise InputError(f'{error}, or all of them: pip install "ridgeback[studies]"') from None


def write_table(found: StudyResult, style: str, output: str) -> None:
    """Write the cells in a form, whole or not at all."""
    WRITERS[style](found, output)


def _parquet(found: StudyResult, output: str) -> None:
    from ridgeback.answers.study_text import batches
    from ridgeback.compare.studies.tidy import columns_of

    arrow, parquet = needed("pyarrow", "parquet"), needed("pyarrow.parquet", "parquet")
    fields = [
        arrow.field(
            column.name,
            arrow.string() if column.kind == "text" else arrow.float64(),
            metadata={"units": column.unit, "long_name": column.meaning},
        )
        for column in columns_of(found.plan)
    ]
    about = {name: str(value) for name, value in found.about().items()}
    schema = arrow.schema(fields, metadata=about)
    stream = io.BytesIO()
    with parquet.ParquetWriter(stream, schema) as writer:
        for rows in batches(found.rows(), AT_ONCE):
            writer.write_table(arrow.Table.from_pylist(rows, schema=schema))
    write_bytes(output, stream.getvalue())


def _netcdf(found: StudyResult, output: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "cells.nc"
        found.to_xarray().to_netcdf(place, engine="h5netcdf")
        write_bytes(output, place.read_bytes())


def _zarr(found: StudyResult, output: str) -> None:
    target = Path(output).resolve()
    made = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
    try:
        found.to_xarray().to_zarr(made / "cells", mode="w", zarr_format=2)
        (made / "cells").rename(target)
    finally:
        shutil.rmtree(made, ignore_errors=True)


WRITERS: Mapping[str, Callable[[StudyResult, str], None]] = {"parquet": _parquet, "netcdf": _netcdf, "zarr": _zarr}
