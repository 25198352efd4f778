"""One study of many models."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Iterable, Mapping, TypeVar, Union

from . import _native
from .errors import InputError
from .model import Model

if TYPE_CHECKING:
    from concurrent.futures import Executor

__all__ = ["map", "set_threads"]

T = TypeVar("T")

#: Studies by their names.
STUDIES = ("static", "modal", "campbell", "critical", "critical_map", "torsional", "frf", "unbalance", "run_up")


def map(
    models: Iterable[Union[Model, Mapping[str, Any]]],
    study: Union[str, Callable[[Model], T]],
    *,
    base: Model | None = None,
    executor: Executor | Any = None,
    workers: int | None = None,
    **settings: Any,
) -> list[Any]:
    """A study of each model, on all cores; the results in the order of the models.

    ``models``: models, or dictionaries of changes of ``base``; ``study``: name of a study with its ``settings``, or a
    function of a model. ``executor``: an executor of ``concurrent.futures`` or a client of ``dask.distributed``, instead of
    threads of this process; the function must then be one that can be pickled. ``workers``: number of threads.

    The first exception ends it. A client computes anew what a worker that was lost had.
    """
    if workers is not None and (isinstance(workers, bool) or not isinstance(workers, int) or workers < 1):
        raise InputError(f"the number of workers is a positive whole number, not {workers!r}")
    if isinstance(models, (str, Model, Mapping)) or not hasattr(models, "__iter__"):
        raise InputError(f"models are a list of models or of dictionaries of changes, not {models!r}")
    if base is not None and not isinstance(base, Model):
        raise InputError(f"base is the model that changes apply to, not {base!r}")
    if not isinstance(study, str) and not callable(study):
        raise InputError(f"a study is a name such as modal, or a function of a model, not {study!r}")
    tasks = [_model(item, base) for item in models]
    call = _Study(study, settings) if isinstance(study, str) else study
    if isinstance(call, _Study) and call.name not in STUDIES:
        raise InputError(f"there is no study {study!r}; there are: {', '.join(STUDIES)}")
    if settings and not isinstance(study, str):
        raise InputError("settings belong to a study that is given by its name")
    client: Any = executor
    if executor is not None and hasattr(client, "gather"):
        # A client of dask: its map gives futures. Without `pure` equal tasks are computed each time.
        found: list[Any] = client.gather(client.map(call, tasks, pure=False))
        return found
    if executor is not None and not hasattr(executor, "submit"):
        raise InputError(f"an executor of concurrent.futures or a client of dask.distributed, not {executor!r}")
    if executor is not None:
        return list(executor.map(call, tasks))
    from concurrent.futures import ThreadPoolExecutor

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
