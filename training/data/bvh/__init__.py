"""Reads BVH files of whole bodies as motions of the 22 joints."""
