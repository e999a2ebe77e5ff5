"""The paper's tables, trained and measured at a scale that one machine can bear."""
