"""The subcommands of `skg`, a module each."""
