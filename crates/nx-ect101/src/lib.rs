//! The NX-ECT101 as a unit model: objects, allocation, refresh, files.
