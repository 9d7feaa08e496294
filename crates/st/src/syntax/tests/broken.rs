//! What is told of broken sources.
