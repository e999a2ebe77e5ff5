"""The body and its frame of reference: joints, heading, streams, the floor, foot contact."""
