//! ESCs joined by ports and links: the way of a frame.
