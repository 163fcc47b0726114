"""The discrete film: cells, gap, flow balance and its linearisation, grooves, elastic shells."""
