"""The milling variant of the reference (milling.md): its statements, its tool, the ISO tape that it punches."""

from skg.ref.mill.interpreter import run

__all__ = ["run"]
