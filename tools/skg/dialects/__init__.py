"""Machines that read G-code: their dialects in files, and programs written for an offset in the control."""
