//! Modules of robots that stand in an otherwise empty world, over a radio that loses nothing.
