//! ESI and SII: written and read from one device description.
