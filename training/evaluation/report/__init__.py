"""Writes an evaluation down: tables, spectra, filmstrips and videos."""
