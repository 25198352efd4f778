"""Curves of results as plotly figures."""

from __future__ import annotations

from typing import Any

import numpy as np

from .errors import InputError
from .results import Campbell, Frf, Result, Unbalance
from .runs import RunUp, Spectrograms
from .tree import _needed

__all__: list[str] = []


def figure(result: Result, name: str | None) -> Any:
    """The curves of a result; of a run-up those of the channel ``name``."""
    go = _needed("plotly.graph_objects")
    out = go.Figure()
    if isinstance(result, Campbell):
        _campbell(go, out, result)
    elif isinstance(result, Frf):
        _frf(go, out, result)
    elif isinstance(result, Unbalance):
        for row in result["responses"]:
            label = f"{row['name']} [{row['unit']}]"
            levels = np.abs(result[row["name"]])
            out.add_trace(go.Scatter(x=result["speeds_rpm"], y=levels, name=label, mode="lines"))
        out.update_layout(xaxis_title="speed [rpm]", yaxis_title="amplitude", yaxis_type="log")
    elif isinstance(result, RunUp):
        channel = name or next(iter(result.channels))
        out.add_trace(go.Scatter(x=result.time, y=result[channel], name=channel, mode="lines"))
        out.update_layout(xaxis_title="time [s]", yaxis_title=f"{channel} [{result.channels[channel]}]")
    elif isinstance(result, Spectrograms):
        one = result[name] if name else result[0]
        frequency = np.asarray(one["frequency"])
        out.add_trace(go.Heatmap(x=np.asarray(one["time"]), y=frequency, z=np.asarray(one["amplitude"]).T))
        out.update_layout(xaxis_title="time [s]", yaxis_title="frequency [Hz]")
    else:
        raise InputError(f'there is no plotly figure of {result.study}; plot() gives the SVG')
    return out


def _campbell(go: Any, out: Any, result: Campbell) -> None:
    speeds = result["speeds_rpm"]
    for row in result["branches"]:
        out.add_trace(go.Scatter(x=speeds, y=row["frequency_hz"], name=row["label"], mode="lines"))
    for row in result["orders"]:
        style = {"dash": "dash", "width": 1}
        out.add_trace(
            go.Scatter(x=speeds, y=row["order"] * speeds / 60.0, name=row["label"], mode="lines", line=style)
        )
    out.update_layout(xaxis_title="speed [rpm]", yaxis_title="frequency [Hz]")


def _frf(go: Any, out: Any, result: Frf) -> None:
    for response in result["responses"]:
        for excitation in result["excitations"]:
            values = np.abs(result[response, excitation])
            if values.any():
                name = f"{response} / {excitation}"
                out.add_trace(go.Scatter(x=result["frequency_hz"], y=values, name=name, mode="lines"))
    out.update_layout(xaxis_title="frequency [Hz]", yaxis_title=str(result["quantity"]), yaxis_type="log")
