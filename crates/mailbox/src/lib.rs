//! Mailbox services: request bytes in, reply bytes or abort code out.
