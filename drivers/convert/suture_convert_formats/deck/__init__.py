"""Decks of CalculiX and Abaqus (.inp): parts, sets, materials, contact, loads and steps, for a mesh or for a mesh with its scene."""
