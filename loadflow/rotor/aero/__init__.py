"""Blade-element momentum: the flow at one section."""
