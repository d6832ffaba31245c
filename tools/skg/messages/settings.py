"""Settings that messages advise: their names as options, in a job file, and on the page."""

from __future__ import annotations

#: Setting, as its option is called -> the table of a job file that has it, and its label in the catalogues.
SETTINGS: dict[str, tuple[str, str]] = {
    "units": ("read", "label-units"),
    "open": ("read", "label-open"),
    "tolerance": ("read", "label-tolerance"),
    "start-layer": ("read", "label-start-layer"),
    "fit-tolerance": ("read", "label-fit-tolerance"),
    "encoding": ("read", "label-encoding"),
    "layer": ("read", "label-layer"),
    "wire": ("machine", "label-wire"),
    "gap": ("machine", "label-gap"),
    "offset": ("machine", "label-offset"),
    "thickness": ("machine", "label-thickness"),
    "rom": ("machine", "label-rom"),
    "ram": ("machine", "label-ram"),
    "small": ("machine", "label-small"),
    "into": ("machine", "label-into"),
    "side": ("default", "label-side"),
    "passes": ("default", "label-passes"),
    "tab": ("default", "label-tab"),
    "slug-tab": ("default", "label-slug-tab"),
    "tabs": ("default", "label-tabs"),
    "tab-passes": ("default", "label-tab-passes"),
    "overlap": ("default", "label-overlap"),
    "start": ("default", "label-start"),
}
#: Settings that a job file calls otherwise.
KEYS = {"layer": "layers", "start": "starts"}
#: Those of its keys that stand above all tables, and those that are lists.
TOP, LISTS = frozenset({"starts"}), frozenset({"layers"})
