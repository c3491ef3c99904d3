"""LabVIEW's files: LVM with and without times, TDMS with its properties."""

from __future__ import annotations

import io

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.readers import columns_of_file

U = np.cos(0.4 * np.arange(60))
HEADER = """LabVIEW Measurement\t
Separator\tTab
X_Columns\t{columns}
***End_of_Header***\t
\t
Channels\t1\t
Date\t2020/01/01\t
X0\t0.0\t
Delta_X\t0.02\t
***End_of_Header***\t
X_Value\tVoltage\tComment
"""


def lvm(*, timed: bool) -> bytes:
    rows = [f"{0.02 * i if timed else ''}\t{u:.6f}\t" for i, u in enumerate(U.tolist())]
    return (HEADER.format(columns="One" if timed else "No") + "\n".join(rows)).encode()


@pytest.mark.parametrize("timed", [True, False])
def test_an_lvm_file_has_no_empty_column_and_a_rate(timed: bool) -> None:
    found = columns_of_file(lvm(timed=timed), ".lvm", "run.lvm")
    assert found.names == (("X_Value", "Voltage") if timed else ("Voltage",))
    assert found.rate == (None if timed else pytest.approx(50.0))
    assert np.allclose(found.values(len(found.names) - 1), U, atol=1e-6)


@pytest.mark.parametrize("separator", ["\t", ";"])
def test_a_step_with_a_decimal_comma_and_the_units_of_the_channels_are_read(separator: str) -> None:
    text = HEADER.format(columns="No").replace("Separator\tTab", "Separator\tTab\nDecimal_Separator\t,")
    text = text.replace("X0\t0.0\t", "Y_Unit_Label\tmm\t\nX0\t0,0\t").replace("0.02", "0,02")
    text += "\n".join(f"\t{u:.6f}\t".replace(".", ",") for u in U.tolist())
    found = columns_of_file(text.replace("\t", separator).encode(), ".lvm", "run.lvm")
    assert found.names == ("Voltage [mm]",)
    assert found.rate == pytest.approx(50.0)
    assert np.allclose(found.values(0), U, atol=1e-6)


def test_the_first_of_several_segments_is_read_and_said() -> None:
    second = HEADER.split("***End_of_Header***\t\n\t\n")[1]
    text = lvm(timed=True).decode() + "\n\t\n" + second + "0\t9.0\t\n0.02\t9.5\t\n"
    found = columns_of_file(text.encode(), ".lvm", "run.lvm")
    assert found.sizes == (60, 60)
    assert "first of 2 segments" in found.note


def test_a_tdms_file_states_step_and_unit() -> None:
    nptdms = pytest.importorskip("nptdms")
    stream = io.BytesIO()
    with nptdms.TdmsWriter(stream) as writer:
        writer.write_segment(
            [nptdms.ChannelObject("rig", "u", U, properties={"wf_increment": 0.02, "unit_string": "mm"})]
        )
    found = columns_of_file(stream.getvalue(), ".tdms", "run.tdms")
    assert found.names == ("u [mm]",)
    assert found.rate == pytest.approx(50.0)
    assert np.array_equal(found.values(0), U)


def test_what_is_no_tdms_file_is_refused_in_a_line() -> None:
    pytest.importorskip("nptdms")
    with pytest.raises(InputError, match=r"run\.tdms is not a readable TDMS file"):
        columns_of_file(b"none of it", ".tdms", "run.tdms")
