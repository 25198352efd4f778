"""One study of many models."""

from __future__ import annotations

import os
from concurrent.futures import Executor, ThreadPoolExecutor
from typing import Any, Callable, Iterable, Mapping, TypeVar, Union

from . import _native
from .errors import InputError
from .model import Model

__all__ = ["map", "set_threads"]

T = TypeVar("T")


def map(
    models: Iterable[Union[Model, Mapping[str, Any]]],
    study: Union[str, Callable[[Model], T]],
    *,
    base: Model | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    **settings: Any,
) -> list[Any]:
    """A study of each model, on all cores; the results in the order of the models.

    ``models``: models, or dictionaries of changes of ``base``; ``study``: name of a study with its ``settings``, or a
    function of a model. ``executor``: one of ``concurrent.futures`` or of dask, instead of threads of this process; the
    function must then be one that can be pickled. ``workers``: number of threads.

    The first exception ends it.
    """
    tasks = [_model(item, base) for item in models]
    call = _Study(study, settings) if isinstance(study, str) else study
    if isinstance(call, _Study) and not hasattr(Model, call.name):
        raise InputError(f"there is no study {study!r}, such as modal, campbell, frf")
    if settings and not isinstance(study, str):
        raise InputError("settings belong to a study that is given by its name")
    if executor is not None:
        return list(executor.map(call, tasks))
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as own:
        return list(own.map(call, tasks))


class _Study:
    """A study by its name, which can be pickled."""

    def __init__(self, name: str, settings: Mapping[str, Any]) -> None:
        self.name, self.settings = name.replace("-", "_"), dict(settings)

    def __call__(self, model: Model) -> Any:
        return getattr(model, self.name)(**self.settings)


def _model(item: Union[Model, Mapping[str, Any]], base: Model | None) -> Model:
    if isinstance(item, Model):
        return item
    if not isinstance(item, Mapping):
        raise InputError(f"models are models or dictionaries of changes, not {item!r}")
    if base is None:
        raise InputError("changes need the model that they change: base=rig")
    return base.with_changes(item)


def set_threads(threads: int) -> None:
    """Number of threads inside one computation, before the first one; results do not depend on it."""
    if isinstance(threads, bool) or not isinstance(threads, int) or not 1 <= threads <= 65535:
        raise InputError(f"the number of threads is a positive whole number, not {threads!r}")
    _native.set_threads(threads)
