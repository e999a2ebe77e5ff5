"""Reads BVH files of whole bodies as the 22 joints."""
