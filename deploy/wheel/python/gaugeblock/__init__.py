"""Gaugeblock: the command, and a kit for adapters in Python (`gaugeblock.adapter`)."""
