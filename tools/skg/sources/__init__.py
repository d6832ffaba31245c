"""Tapes from any file: 3B, G-code, programs."""
